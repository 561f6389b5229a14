// SPDX-License-Identifier: Apache-2.0
/// \file
/// Tile lists: which cells each tile meets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <projection/core/frame_control.h>
#include <projection/cpu/cpu_cull.h>

namespace tetralux::projection {

/// Visible cells in chunks, each a run within one array, so that chunks are filled by any thread and read in order.
struct VisibleCellChunk {
    std::size_t begin, count;
};

class TileBins {
public:
    /// Begins a frame; counts of all chunks and tiles become 0.
    void reset(std::size_t chunks, int tilesX, int tilesY);
    std::uint32_t* counts(std::size_t chunk) { return places_.data() + chunk * tiles_; }

    /// Lists every visible cell in each tile of its rectangle, as many as were counted, in the order of the chunks: the
    /// same for any number of threads. Keys become whole numbers that ascend from `nearest` down to `farthest`; with
    /// `places` those of the cells are taken instead.
    void fill(const VisibleCell* visibleCells, const std::vector<VisibleCellChunk>& chunks, double nearest,
              double farthest, const std::uint32_t* places, const FrameControl* control);

    /// Sorts each tile's list by key; equal keys keep their order.
    void sort(const FrameControl* control);

    std::size_t tileCount() const { return tiles_; }
    std::size_t entryCount() const { return entries_.size(); }
    std::span<const TileEntry> tile(std::size_t tile) const {
        return {entries_.data() + start_[tile], entries_.data() + start_[tile + 1]};
    }

private:
    std::size_t tiles_ = 0, tilesX_ = 0;
    std::vector<TileEntry> entries_;
    std::vector<std::uint64_t> start_;  ///< of each tile's list, and the end
    std::vector<std::uint32_t>
        places_;  ///< per chunk and tile: how many, then where within the tile's list its next entry goes
};

/// Sorts by key, stable, in place; `scratch` keeps its memory. Meant for lists that fit a core's own cache.
void sortEntries(std::span<TileEntry> entries, std::vector<TileEntry>& scratch);

}  // namespace tetralux::projection
