// SPDX-License-Identifier: Apache-2.0
/// \file
/// The points of Lagrange and Bézier cells in the sequence of VTK's file formats since version 2.1.
#pragma once

#include <array>
#include <vector>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {

/// Place of a point on the lattice of the parametric cell: r, s and t in steps of 1/order.
using LatticePlace = std::array<int, 3>;

/// The points of a tetrahedron, hexahedron or wedge of an order ≥ 1 in all directions: corners, then those within
/// edges, within faces, within the cell. Empty for other shapes.
std::vector<LatticePlace> lagrangePoints(Shape shape, int order);

}  // namespace tetralux::mesh
