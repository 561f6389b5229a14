// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <mesh/cell_soup.h>

namespace tetralux::mesh {

/// Adds the (nx − 1)(ny − 1)(nz − 1) cells of a grid of points, x fastest, to a soup without cells: voxels, or
/// hexahedra, which number their points differently. Points are not added. \throws std::runtime_error without a source
/// if the grid has no volume or more points than 32 bits can number.
void addGridCells(CellSoup& soup, const std::array<std::size_t, 3>& points, std::uint8_t type);

/// Voxels of unit size with points from (0, 0, 0) on. \throws std::runtime_error naming `source` as `addGridCells`
/// does.
CellSoup gridSoup(const std::array<std::size_t, 3>& points, const std::string& source);

}  // namespace tetralux::mesh
