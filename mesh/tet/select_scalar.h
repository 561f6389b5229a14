// SPDX-License-Identifier: Apache-2.0
/// \file
/// From a mesh with all its fields to the one scalar that is drawn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mesh/tet/mesh_report.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Larger magnitudes stand for no value, as NaN does: the integrals need products with lengths and differences.
inline constexpr double largestScalar = 1e280;

struct ScalarSelection {
    ScalarMesh mesh;
    std::string fieldName;             ///< the field taken, with component: "Velocity (magnitude)"
    std::uint64_t nonFiniteCells = 0;  ///< cells left out because a scalar of theirs is NaN, infinite or beyond 1e280
};

struct ChosenScalar {
    std::string fieldName;  ///< with component: "Velocity (magnitude)"
    Association association = Association::Point;
    std::vector<double> values;  ///< one per point or cell
};

/// A copy of one scalar, by the names that selectScalar takes. \throws std::runtime_error listing the fields there are.
ChosenScalar scalarOf(const TetMesh& mesh, const std::string& name);

/// Takes one scalar of `mesh`: `name` alone (vectors by magnitude), "name:0", "name:x" or "name:xy" (a component, by
/// the file's own name for it too), or "" for the first point field, else the first cell field (numbers of points or
/// cells do not count, nor a field without a value on any cell), else the coordinate along which the mesh is longest.
/// Of a field on points and one on cells with the same name the first is meant; "name@cells" is the other. "x", "y" and
/// "z" are the coordinates unless a field is called so. Consumes the mesh so that nothing is copied. Cells with a
/// non-finite scalar are left out and counted in `report`. \throws std::runtime_error listing the fields there are when
/// the name is wrong or no cell is left.
ScalarSelection selectScalar(TetMesh&& mesh, const std::string& name, MeshReport& report);

/// Leaves out the cells of `mesh` with a non-finite scalar, counted in `report`, and finds the range and the bounds of
/// the others. \returns how many were left out; where that is all of them range and bounds are not set.
std::uint64_t finishScalars(ScalarMesh& mesh, MeshReport& report);

}  // namespace tetralux::mesh
