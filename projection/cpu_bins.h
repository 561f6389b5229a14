// SPDX-License-Identifier: Apache-2.0
/// \file
/// Tile lists: which cells each tile meets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <projection/cpu_cull.h>

namespace tetralux::projection {

/// Survivors in chunks, each a run within one array, so that chunks are filled by any thread and read in order.
struct SurvivorChunk {
    std::size_t begin, count;
};

class TileBins {
public:
    /// Lists every survivor in each tile of its rectangle, in the order of the chunks: the same for any number of threads.
    /// Keys become whole numbers that ascend from `nearest` down to `farthest`.
    void fill(const std::vector<Survivor>& survivors, const std::vector<SurvivorChunk>& chunks, int tilesX, int tilesY, double nearest,
              double farthest);

    /// Sorts each tile's list by key; equal keys keep their order.
    void sort();

    std::size_t tileCount() const { return start_.size() - 1; }
    std::span<const TileEntry> tile(std::size_t tile) const {
        return {entries_.data() + start_[tile], entries_.data() + start_[tile + 1]};
    }

private:
    std::vector<TileEntry> entries_;
    std::vector<std::uint64_t> start_;    ///< of each tile's list, and the end
    std::vector<std::uint64_t> places_;   ///< per chunk and tile: where its next entry goes
};

/// Sorts by key, stable, in place; `scratch` keeps its memory. Meant for lists that fit a core's own cache.
void sortEntries(std::span<TileEntry> entries, std::vector<TileEntry>& scratch);

}  // namespace tetralux::projection
