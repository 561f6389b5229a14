// SPDX-License-Identifier: Apache-2.0
/// \file
/// Second stage of a frame: the cells that can be seen, their tiles and their place in the order.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec4.hpp>

#include <projection/cpu/cpu_tile.h>
#include <projection/order/order_keys.h>

namespace tetralux::projection {

/// A cell that may cover pixels, and the tiles of its rectangle.
struct [[gnu::packed]] VisibleCell {  // 20 bytes instead of 24: one for every cell that is seen
    double key;                       ///< larger is nearer
    mesh::CellIndex cell;
    std::uint16_t x0, y0, x1, y1;  ///< tiles, both ends included
};

struct CullCounts {
    std::uint64_t outsideView = 0, noPixelCentre = 0;
    double nearest = -std::numeric_limits<double>::infinity(), farthest = -nearest;  ///< largest and smallest key
};

/// Where the keys of a frame come from: the value at `eye` of a linear function per cell; without, all keys are 0.
struct KeySource {
    const glm::dvec4* planes = nullptr;
    glm::dvec4 eye{0};

    double keyOf(mesh::CellIndex cell) const { return planes ? orderKey(planes[cell], eye) : 0.0; }
};

/// What cullCells reads and where it writes.
struct CullTask {
    const mesh::CellIndex* visible;  ///< the cells that the transfer function shows; nullptr: all, but for
    const std::uint64_t* shown;      ///< one bit per cell, 1 where it shows; nullptr: all do
    std::size_t begin, end;          ///< of `visible`, or of all cells; with `shown` begin is a multiple of 64
    KeySource keys;
    VisibleCell* visibleCells;  ///< room for end − begin
    int tilesX;
    std::uint32_t* tileCounts;  ///< one more for each tile that a visible cell meets
};

/// Cells that can be seen, in order; their number.
std::size_t cullCells(const TileFrame& frame, const CullTask& task, CullCounts& counts);

}  // namespace tetralux::projection
