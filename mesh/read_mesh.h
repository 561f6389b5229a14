// SPDX-License-Identifier: Apache-2.0
/// \file
/// From a file, or the name of a generated field, to a checked mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <mesh/mesh_report.h>
#include <mesh/tet_mesh.h>

namespace tetralux::mesh {

struct ReadOptions {
    std::optional<double> time;  ///< for series: the step nearest to it; the first step when not given
    /// Pieces along each edge of a quadratic or Lagrange cell; 0 for as many as its order.
    int subdivision = 0;
    /// Points within this distance (mesh units) of another become one, whatever their values. Without it only points
    /// that agree exactly in place and values do.
    std::optional<double> mergeTolerance;
    bool smoothCells = false;  ///< cell fields become point fields: the mean of the cells around each point
};

struct ReadResult {
    TetMesh mesh;
    MeshReport report;
    std::vector<double> times;  ///< of all steps, if the source is a series; the mesh is that of one
};

/// Reads `source`: a file of any registered format or a generated field such as "bucky:32".
/// \throws std::runtime_error naming the source, what is wrong and what would mend it.
ReadResult readMesh(const std::string& source, const ReadOptions& options = {});

/// Larger magnitudes stand for no value, as NaN does: the integrals need products with lengths and differences.
inline constexpr double largestScalar = 1e280;

struct ScalarSelection {
    ScalarMesh mesh;
    std::string fieldName;             ///< the field taken, with component: "Velocity (magnitude)"
    std::uint64_t nonFiniteCells = 0;  ///< cells left out because a scalar of theirs is NaN, infinite or beyond 1e280
};

/// Takes one scalar of `mesh`: `name` alone (vectors by magnitude), "name:0" or "name:x" (a component), or ""
/// for the first point field, else the first cell field (numbers of points or cells do not count), else the coordinate
/// along which the mesh is longest. "x", "y" and "z" are the coordinates unless a field is called so. Consumes the mesh
/// so that nothing is copied. Cells with a non-finite scalar are left out and counted in `report`. \throws
/// std::runtime_error listing the fields there are when the name is wrong or no cell is left.
ScalarSelection selectScalar(TetMesh&& mesh, const std::string& name, MeshReport& report);

}  // namespace tetralux::mesh
