// SPDX-License-Identifier: Apache-2.0
/// \file
/// Shape functions of the quadratic cells that are not Lagrange cells: those of the serendipity family, which lack
/// points within faces or the cell, and those with a point more there than the lattice has. O. Zienkiewicz, R. Taylor:
/// The Finite Element Method, 5th ed. 2000, vol. 1, chapter 8.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetralux::mesh {

/// A cell's functions, and where its points lie. r, s and t run from 0 to 1; in a pyramid r and s do over each layer.
struct QuadraticCell {
    std::uint8_t type;
    std::size_t pointCount;
    std::vector<double> (*functions)(const std::array<double, 3>& place);  ///< one for each point
    std::vector<std::array<double, 3>> (*points)();
};

/// nullptr if cells of that type and number of points are Lagrange or Bézier cells, or none at all.
const QuadraticCell* quadraticCell(std::uint8_t type, std::size_t pointCount);

}  // namespace tetralux::mesh
