// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {

using LatticePoint = std::array<int, 3>;

/// The points of a complete element of Gmsh's of any order, in Gmsh's sequence ("Node ordering" in its reference
/// manual): corners, the insides of edges, of faces and of the element, each of the last two again as an element of
/// lower order. Places count steps of 1 / `order` along the shape's parameters; those of a pyramid lean over its first
/// corner, so that its layer k has i and j from 0 to `order` − k.
std::vector<LatticePoint> gmshLattice(Shape shape, int order);

/// The order of the complete element with `points` points; 0 if there is none up to 10.
int orderOfElement(Shape shape, std::size_t points);

}  // namespace tetralux::mesh
