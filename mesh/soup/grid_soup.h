// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Adds the (nx − 1)(ny − 1)(nz − 1) cells of a grid of points, x fastest, to a soup without cells: voxels, or
/// hexahedra, which number their points differently. Points are not added. \throws std::runtime_error without a source
/// if the grid has no volume or more points than 32 bits can number.
void addGridCells(CellSoup& soup, const std::array<std::size_t, 3>& points, std::uint8_t type);

/// Where the points of a grid lie: point (i, j, k) at origin + i·steps[0] + j·steps[1] + k·steps[2], in mesh units.
struct GridFrame {
    glm::dvec3 origin{0.0, 0.0, 0.0};
    std::array<glm::dvec3, 3> steps{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};

    /// Whether cells numbered along i, j and k have their inside out.
    bool mirrors() const;
};

/// Puts the points of a grid of voxels in their places; where the frame mirrors, the voxels are numbered the other way
/// round, for they are no worse than others.
void placeGrid(CellSoup& soup, const std::array<std::size_t, 3>& points, const GridFrame& frame);

/// Numbers voxels the other way round.
void mirrorVoxels(CellSoup& soup);

/// Voxels of unit size with points from (0, 0, 0) on. \throws std::runtime_error naming `source` as `addGridCells`
/// does.
CellSoup gridSoup(const std::array<std::size_t, 3>& points, const std::string& source);

}  // namespace tetralux::mesh
