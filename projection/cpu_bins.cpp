// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu_bins.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <projection/power_order.h>

namespace tetralux::projection {

void TileBins::fill(const std::vector<Survivor>& survivors, const std::vector<SurvivorChunk>& chunks, int tilesX, int tilesY,
                    double nearest, double farthest) {
    const std::size_t tiles = static_cast<std::size_t>(tilesX) * static_cast<std::size_t>(tilesY);
    auto forTiles = [&](const Survivor& survivor, auto action) {
        for (std::size_t y = survivor.y0; y <= survivor.y1; ++y)
            for (std::size_t x = survivor.x0; x <= survivor.x1; ++x) action(y * static_cast<std::size_t>(tilesX) + x);
    };
    places_.resize(chunks.size() * tiles);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        std::uint64_t* places = places_.data() + c * tiles;
        std::fill_n(places, tiles, 0);
        for (std::size_t i = chunks[c].begin; i < chunks[c].begin + chunks[c].count; ++i)
            forTiles(survivors[i], [&](std::size_t tile) { ++places[tile]; });
    });
    start_.assign(tiles + 1, 0);
    std::uint64_t total = 0;
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        start_[tile] = total;
        for (std::size_t c = 0; c < chunks.size(); ++c) {
            const std::uint64_t count = places_[c * tiles + tile];
            places_[c * tiles + tile] = total;
            total += count;
        }
    }
    start_[tiles] = total;
    entries_.resize(total);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        std::uint64_t* places = places_.data() + c * tiles;
        for (std::size_t i = chunks[c].begin; i < chunks[c].begin + chunks[c].count; ++i) {
            const TileEntry entry{orderedKey(survivors[i].key, nearest, farthest), survivors[i].cell};
            forTiles(survivors[i], [&](std::size_t tile) { entries_[places[tile]++] = entry; });
        }
    });
}

void TileBins::sort() {
    tbb::enumerable_thread_specific<std::vector<TileEntry>> scratch;
    tbb::parallel_for(std::size_t{0}, tileCount(), [&](std::size_t tile) {
        sortEntries({entries_.data() + start_[tile], entries_.data() + start_[tile + 1]}, scratch.local());
    });
}

void sortEntries(std::span<TileEntry> entries, std::vector<TileEntry>& scratch) {
    if (entries.size() < 64) {
        std::stable_sort(entries.begin(), entries.end(), [](const TileEntry& a, const TileEntry& b) { return a.key < b.key; });
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
