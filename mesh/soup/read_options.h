// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a reader is asked for, and what becomes of what it read.
#pragma once

#include <optional>
#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/tet/mesh_report.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

struct ReadOptions {
    std::optional<double> time;  ///< for series: the step nearest to it; the first step when not given
    /// Pieces along each edge of a quadratic or Lagrange cell; 0 for as many as its order.
    int subdivision = 0;
    /// Points within this distance (mesh units) of another become one, whatever their values. Without it only points
    /// that agree exactly in place and values do.
    std::optional<double> mergeTolerance;
    /// Third-party readers run in a forked child process, so that a damaged file can neither end this one nor take all
    /// its memory. Not for a process whose other threads hold locks.
    bool isolated = false;
    bool smoothCells = false;  ///< cell fields become point fields: the mean of the cells around each point
};

/// What a command line asks for, which has no threads yet when it reads.
inline ReadOptions isolatedReading() {
    ReadOptions options;
    options.isolated = true;
    return options;
}

struct ReadResult {
    TetMesh mesh;
    MeshReport report;
    std::vector<double> times;          ///< of all steps, if the source is a series; the mesh is that of one
    std::vector<BlockName> blockNames;  ///< what numbers in cell fields of the mesh are called
};

}  // namespace tetralux::mesh
