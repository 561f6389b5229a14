// SPDX-License-Identifier: Apache-2.0
/// \file
/// A batch of cells set up for one tile, and the cells in it that reach behind the eye, which are set up one by one.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include <projection/cpu/cpu_tile.h>

namespace tetralux::projection {

/// What is kept in double of cells a face of which is so steep to the view, or so close to others, that floats would
/// misjudge how far rays run in them (cpu_steep_cell.h).
struct SteepCells {
    static constexpr std::size_t capacity = 8;
    float is[capacity];  ///< not 0: of this cell the rest is set
    double plane[4][3][capacity], offsetX[capacity], offsetY[capacity];
    double scalar[capacity], scalarPerX[capacity], scalarPerY[capacity], scalarPerInverseDepth[capacity];
};

/// Cells of a tile, set up: the record of projection/cells/cell_interval.glsl with the tile's first pixel as origin of
/// the offsets.
struct CellBatch {
    static constexpr std::size_t capacity = 8;
    template <class T>
    using Lanes = T[capacity];

    alignas(64) Lanes<float> plane[4][3];
    Lanes<std::uint32_t> frontMask;  ///< Σ 2^k over the faces that bound inverseDepth from above
    Lanes<float> offsetX, offsetY;   ///< dx, dy of the tile's first pixel
    Lanes<float> restX, restY;       ///< and what of them float leaves, which counts near the cell
    Lanes<float> scalar, scalarPerX, scalarPerY, scalarPerInverseDepth, scalarLow, scalarHigh;
    Lanes<float> scale;
    Lanes<float> inverseDepthNear, inverseDepthFar;  ///< of the cell's nearest (or the eye's) and deepest corner
    /// Inverse depth along rays that is the same for all cells: inverse depth + rayPerInverseDepth·inverseDepth;
    /// `rayInverseDepthChecked` is less by the tolerance of the order check.
    Lanes<float> rayPerInverseDepth, rayInverseDepth, rayInverseDepthChecked;
    Lanes<float> normal[3], gradient;  ///< unit, as (right, down, forward); scene scalars per scene length
    Lanes<float> eyeWeight[4];      ///< barycentric coordinates of the eye (orthographic: their rates per inverseDepth)
    Lanes<std::int32_t> corner[4];  ///< rows of attributes, in the order of the planes: point numbers
    SteepCells steep;
    alignas(64) std::int32_t begin[capacity][2], end[capacity][2];  ///< pixels (x, y) within the tile
};

/// Pixel coordinates are floats: what rounding may take from a rectangle is added to it.
inline float pixelPadding(int width, int height) {
    return 2.4e-7f * static_cast<float>(std::max(width, height));
}

/// Two floats as gathered from CameraPoint.
inline std::uint64_t packedPair(int x, int y) {
    return std::bit_cast<std::uint64_t>(std::array<float, 2>{static_cast<float>(x), static_cast<float>(y)});
}

/// Sets lane j anew if a corner of the cell lies behind the eye. `points` ascend; `odd`: that order turns the cell
/// inside out.
void setUpCellAtEye(const TileFrame& frame, int tileX, int tileY, const std::int32_t (&points)[4], mesh::CellIndex cell,
                    bool odd, std::size_t j, CellBatch& batch);

/// Puts rows of attributes that are particular to cells (shading::VertexLight::corners) in the place of the points'
/// own.
void takeRowsOfCells(const TileFrame& frame, std::span<const TileEntry> entries, std::size_t cells, CellBatch& batch);

/// The pixels that the part of a cell in front of the eye may cover; false when there are none.
bool rectangleAtEye(const TileFrame& frame, const std::array<CameraPoint, 4>& corners, PixelRect& rect);

}  // namespace tetralux::projection
