// SPDX-License-Identifier: Apache-2.0
/// \file
/// A parametric cell cut into smaller linear cells on a regular lattice.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {

/// Weights of the corners (4 to 8, VTK's order) of a linear cell at a parametric place.
std::vector<double> cornerWeights(Shape shape, const std::array<double, 3>& place);

struct ReferenceLattice {
    /// VTK's parametric coordinates of every lattice point, each in [0, 1].
    std::vector<std::array<double, 3>> points;
    /// Of each such point: on which corner, edge or face it lies, and where on it, whatever cell looks at it.
    std::vector<std::vector<double>> cornerWeights;
    struct SubCell {
        std::uint8_t type;  ///< tetrahedron, hexahedron, wedge or pyramid
        std::array<int, 8> points;
        int pointCount;
    };
    std::vector<SubCell> cells;
};

/// `segments` ≥ 1 pieces along each edge. Tetrahedra become segments³ tetrahedra (Freudenthal 1942), hexahedra and
/// wedges as many of their kind, pyramids pyramids of both directions and tetrahedra between them. On every face the
/// pieces form the lattice of the face alone, so that neighbours fit.
ReferenceLattice referenceLattice(Shape shape, int segments);

}  // namespace tetralux::mesh
