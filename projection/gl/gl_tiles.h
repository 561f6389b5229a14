// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: pictures drawn by compute shaders alone, for GPUs whose rasterizers are few.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <projection/core/camera.h>
#include <projection/gl/gl_cell_buffer.h>
#include <projection/gl/gl_radix_sort.h>

namespace tetralux::projection {

/// Pixels along a tile's side: one lane of a group each.
inline constexpr int glTileSize = 16;

/// What a frame's tiles have seen, of all chunks.
struct GlTileCounts {
    std::uint64_t fragments = 0;     ///< cell–pixel segments
    std::uint64_t entries = 0;       ///< of tiles' lists
    std::uint64_t entriesSaved = 0;  ///< never looked at, since their tile was finished
    std::uint64_t retired = 0;       ///< tiles all of whose pixels are finished
};

/// Bins the cells of a chunk into tiles of the image and draws each tile by one group of lanes:
///
///     count the tiles of each cell ─► prefix sums ─► (tile, cell) in the cells' order ─► sort by tile, stable
///     ─► where each tile begins ─► a group per tile walks its list, pixels in registers
///
/// Chunks come nearest first; a pixel goes on where the last chunk left it. (Tiles as in 3D Gaussian splatting: Kerbl
/// et al. 2023, Section 6, but for an order of cells that is right in every pixel.)
class GlTiles {
public:
    /// For chunks of up to so many cells. `capacity`: pairs of tile and cell there is room for at first.
    /// \throws std::runtime_error when the driver refuses a shader.
    GlTiles(const GlFunctions& gl, GlCellLayout layout, std::size_t chunkCells, std::size_t capacity);

    /// A frame into a texture of its size (RGBA32F), cleared.
    void begin(const CameraFrame& frame, GLuint texture);

    /// `plan`: of the frame; `vertices`: the chunk's cells; `useProgram` makes a program of tiles (GlCellProgram)
    /// current.
    void draw(GLuint plan, GLuint vertices, std::size_t chunkBegin, const std::function<void()>& useProgram);

    /// Whether a chunk of the frame had more pairs than there was room for: then the picture is of no use, there is
    /// more room now, and the frame is to be drawn again. Waits for the frame.
    /// \throws std::runtime_error when there cannot be room for them.
    bool overflowed();

    GlTileCounts counts() const;
    std::size_t capacity() const { return capacity_; }

private:
    void makeRoom(std::size_t pairs);
    void bin(const GlKernel& kernel, GLuint plan, GLuint vertices, std::size_t chunkBegin, GLuint last) const;

    const GlFunctions& gl_;
    GlCellLayout layout_;
    std::size_t chunkCells_, groups_, capacity_ = 0;
    int width_ = 0, height_ = 0, columns_ = 0, rows_ = 0;
    GLuint texture_ = 0;
    GlKernel count_, emit_, planning_, ranging_;
    GlRadixSort sort_;
    GlStorage cellPairs_, groupPairs_, demand_, plan_;
    std::optional<GlStorage> pairs_, scratch_, ranges_, states_;
};

}  // namespace tetralux::projection
