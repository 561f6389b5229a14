// SPDX-License-Identifier: Apache-2.0
/// \file
/// What bounds the errors of a cell: its shape, its scalars and their extinction.
#pragma once

#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>

namespace tetralux::projection {

/// The range of a cell's scalars, field units.
struct CellScalars {
    double low, high;
    double width() const { return high - low; }
};
CellScalars scalarsOf(const mesh::ScalarMesh& mesh, mesh::CellIndex cell);

/// Mesh units. The altitude is 0 where there is no volume.
struct CellShape {
    double longestEdge, leastAltitude;
};
CellShape shapeOf(const mesh::ScalarMesh& mesh, mesh::CellIndex cell);

/// Extinction among the scalars of a cell.
struct Extinctions {
    double least, most;
};
Extinctions extinctionsOf(const preint::TransferFunction& function, const CellScalars& scalars);

}  // namespace tetralux::projection
