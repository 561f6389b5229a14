// SPDX-License-Identifier: Apache-2.0
/// \file
/// First stages of a frame: points before the camera, the cells that can be seen, their tiles and their place in the order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <projection/cpu_tile.h>

namespace tetralux::projection {

/// A cell that may cover pixels, and the tiles of its rectangle.
struct Survivor {
    double key;  ///< larger is nearer
    mesh::CellIndex cell;
    std::uint16_t x0, y0, x1, y1;  ///< tiles, both ends included
};

struct CullCounts {
    std::uint64_t outsideView = 0, noPixelCentre = 0;
};

/// Points of the mesh before a camera. `points` keeps its memory.
void projectPoints(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame, std::vector<CpuPoint>& points);

/// Cells that can be seen go to `survivors` in order, without key; their number.
/// `visible`: the cells that the transfer function shows, of which those from `begin` to `end` are asked for; nullptr: all cells.
std::size_t cullCells(const TileFrame& frame, const mesh::CellIndex* visible, std::size_t begin, std::size_t end,
                      Survivor* survivors, CullCounts& counts);

}  // namespace tetralux::projection
