// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_bins.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <projection/order/power_order.h>

namespace tetralux::projection {

void TileBins::reset(std::size_t chunks, int tilesX, int tilesY) {
    tilesX_ = static_cast<std::size_t>(tilesX);
    tiles_ = tilesX_ * static_cast<std::size_t>(tilesY);
    places_.resize(chunks * tiles_);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) { std::fill_n(counts(c), tiles_, 0u); });
}

void TileBins::fill(const VisibleCell* visibleCells, const std::vector<VisibleCellChunk>& chunks, double nearest,
                    double farthest, const std::uint32_t* cellPlaces, const FrameControl* control) {
    start_.resize(tiles_ + 1);
    tbb::parallel_for(std::size_t{0}, tiles_, [&](std::size_t tile) {
        checkStop(control);
        std::uint32_t sum = 0;
        for (std::size_t c = 0; c < chunks.size(); ++c) sum += std::exchange(places_[c * tiles_ + tile], sum);
        start_[tile + 1] = sum;
    });
    start_[0] = 0;
    for (std::size_t tile = 0; tile < tiles_; ++tile) start_[tile + 1] += start_[tile];
    if (entries_.capacity() < start_[tiles_]) {  // growing by doubling, as resize does, would copy and waste
        entries_ = {};
        entries_.reserve(start_[tiles_] + start_[tiles_] / 16);
    }
    entries_.resize(start_[tiles_]);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        checkStop(control);
        std::uint32_t* places = counts(c);
        for (std::size_t i = chunks[c].begin; i < chunks[c].begin + chunks[c].count; ++i) {
            const VisibleCell& visibleCell = visibleCells[i];
            const TileEntry entry{
                cellPlaces ? cellPlaces[visibleCell.cell] : orderedKey(visibleCell.key, nearest, farthest),
                visibleCell.cell};
            for (std::size_t y = visibleCell.y0; y <= visibleCell.y1; ++y)
                for (std::size_t tile = y * tilesX_ + visibleCell.x0; tile <= y * tilesX_ + visibleCell.x1; ++tile)
                    entries_[start_[tile] + places[tile]++] = entry;
        }
    });
}

void TileBins::sort(const FrameControl* control) {
    tbb::enumerable_thread_specific<std::vector<TileEntry>> scratch;
    tbb::parallel_for(std::size_t{0}, tileCount(), [&](std::size_t tile) {
        checkStop(control);
        sortEntries({entries_.data() + start_[tile], entries_.data() + start_[tile + 1]}, scratch.local());
    });
}

void sortEntries(std::span<TileEntry> entries, std::vector<TileEntry>& scratch) {
    if (entries.size() < 64) {
        std::stable_sort(entries.begin(), entries.end(),
                         [](const TileEntry& a, const TileEntry& b) { return a.key < b.key; });
        return;
    }
    constexpr unsigned digitBits = 11, passes = 3;
    constexpr std::uint32_t digits = 1u << digitBits;
    std::uint32_t low = 0xffffffffu, high = 0;
    for (const TileEntry& entry : entries) {
        low = std::min(low, entry.key);
        high = std::max(high, entry.key);
    }
    std::array<std::array<std::uint32_t, digits>, passes> place{};
    for (const TileEntry& entry : entries) {
        const std::uint32_t key = entry.key - low;
        for (unsigned pass = 0; pass < passes; ++pass) ++place[pass][key >> (pass * digitBits) & (digits - 1)];
    }
    scratch.resize(entries.size());
    TileEntry *from = entries.data(), *to = scratch.data();
    const unsigned bits = static_cast<unsigned>(std::bit_width(high - low));
    for (unsigned pass = 0; pass * digitBits < bits; ++pass) {
        std::uint32_t sum = 0;
        for (std::uint32_t& count : place[pass]) sum += std::exchange(count, sum);
        for (std::size_t i = 0; i < entries.size(); ++i)
            to[place[pass][(from[i].key - low) >> (pass * digitBits) & (digits - 1)]++] = from[i];
        std::swap(from, to);
    }
    if (from != entries.data()) std::copy_n(from, entries.size(), entries.data());
}

}  // namespace tetralux::projection
