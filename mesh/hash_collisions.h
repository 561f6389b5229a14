// SPDX-License-Identifier: Apache-2.0
/// \file
/// Equal items among millions of mostly different ones, without sorting all of them.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tetralux::mesh {

/// One bit for each of `places`, set by many threads.
class SharedBits {
public:
    explicit SharedBits(std::size_t places)
        : words_(std::make_unique<std::atomic<std::uint64_t>[]>((places + 63) / 64)) {}
    /// \returns whether the bit was set before.
    bool set(std::uint64_t place) {
        const std::uint64_t bit = std::uint64_t{1} << (place & 63);
        return (words_[place >> 6].fetch_or(bit, std::memory_order_relaxed) & bit) != 0;
    }
    bool test(std::uint64_t place) const {
        return (words_[place >> 6].load(std::memory_order_relaxed) >> (place & 63) & 1) != 0;
    }

private:
    std::unique_ptr<std::atomic<std::uint64_t>[]> words_;
};

/// Hash and number of every item that may equal another one, sorted by hash and then number: most of the items that
/// equal no other are not among them. Equal items must have equal hashes and equal places; the fewer others share a
/// place (of which there are `places`, two bits of memory each) and the nearer those of successive items lie, the
/// faster it is.
template <class HashOf, class PlaceOf>
std::vector<std::pair<std::uint64_t, std::uint32_t>> collisionCandidates(std::size_t count, const HashOf& hashOf,
                                                                         std::size_t places, const PlaceOf& placeOf) {
    using Range = tbb::blocked_range<std::size_t>;
    constexpr std::size_t chunk = 65536;
    SharedBits seen(places);
    SharedBits twice(places);
    tbb::parallel_for(Range(0, count, chunk), [&](const Range& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::uint64_t place = placeOf(i, hashOf(i));
            if (seen.set(place)) {
                twice.set(place);
            }
        }
    });
    std::vector<std::vector<std::pair<std::uint64_t, std::uint32_t>>> found((count + chunk - 1) / chunk);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t part) {
        for (std::size_t i = part * chunk; i < std::min(count, (part + 1) * chunk); ++i) {
            const std::uint64_t hash = hashOf(i);
            if (twice.test(placeOf(i, hash))) {
                found[part].emplace_back(hash, static_cast<std::uint32_t>(i));
            }
        }
    });
    std::vector<std::pair<std::uint64_t, std::uint32_t>> candidates;
    for (const auto& part : found) {
        candidates.insert(candidates.end(), part.begin(), part.end());
    }
    std::sort(candidates.begin(), candidates.end());
    return candidates;
}

/// Calls `use(first, last)` for every run of two or more candidates of one hash.
template <class Use>
void forEachRun(const std::vector<std::pair<std::uint64_t, std::uint32_t>>& candidates, const Use& use) {
    for (std::size_t first = 0; first < candidates.size();) {
        std::size_t last = first + 1;
        while (last < candidates.size() && candidates[last].first == candidates[first].first) {
            ++last;
        }
        if (last - first > 1) {
            use(first, last);
        }
        first = last;
    }
}

/// Adds `value` to a hash. Start from any constant.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15ull;
    hash = (hash ^ hash >> 29) * 0xbf58476d1ce4e5b9ull;
    return hash ^ hash >> 32;
}

}  // namespace tetralux::mesh
