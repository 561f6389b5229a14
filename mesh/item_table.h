// SPDX-License-Identifier: Apache-2.0
/// \file
/// Equal items among millions of mostly different ones, by many threads and without sorting all of them.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <mesh/huge_pages.h>

namespace tetralux::mesh {

/// A hash: `hash` with `value` added. Start from any constant.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15ull;
    return hash ^ hash >> 32;
}

/// A number below `count`, as evenly as `hash` is spread in its upper half. `count` must be below 2^32.
inline std::uint64_t placeBelow(std::uint64_t count, std::uint64_t hash) {
    return (hash >> 32) * count >> 32;
}

/// A hash table of item numbers with open addressing. Item i is whatever the caller calls so.
class ItemTable {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    /// For at most `items` items, four bytes for each of `slotsPerItem` (at least 2) places.
    ItemTable(std::size_t items, std::size_t slotsPerItem)
        : slots_(slotsPerItem * items + 1),
          numbers_(static_cast<std::uint32_t*>(std::calloc(slots_, sizeof(std::uint32_t))), &std::free) {
        if (numbers_ == nullptr) {
            throw std::bad_alloc();
        }
        preferHugePages(numbers_.get(), slots_ * sizeof(std::uint32_t));
    }
    std::uint64_t slots() const { return slots_; }

    /// Puts `item` in, unless it equals one that is there: then \returns that one, else `none`. Equal items must have
    /// the same `place` (below `slots()`: the nearer those of successive items lie, the faster it is) and `hash`;
    /// `equal(other)` compares with another. Once for each item, from any thread; what is written before is seen by
    /// the `equal` of others.
    template <class Equal>
    std::uint32_t insert(std::uint32_t item, std::uint64_t place, std::uint64_t hash, const Equal& equal) {
        constexpr unsigned nearProbes = 8;
        for (unsigned probe = 0;; ++probe) {
            const std::atomic_ref<std::uint32_t> slot(numbers_.get()[place]);
            std::uint32_t there = slot.load(std::memory_order_acquire);
            if (there == 0 && slot.compare_exchange_strong(there, item + 1, std::memory_order_acq_rel)) {
                return none;
            }
            if (equal(there - 1)) {
                return there - 1;
            }
            // Where it is crowded, anywhere else.
            hash = probe < nearProbes ? hash : mixed(hash, probe);
            place = probe < nearProbes ? (place + 1) % slots_ : hash % slots_;
        }
    }

private:
    std::uint64_t slots_;
    std::unique_ptr<std::uint32_t, void (*)(void*)> numbers_;  ///< item + 1, or 0; from calloc: cleared when touched
};

/// Calls `use(first, last)` for every run of two or more pairs of one hash; `pairs` are sorted.
template <class Use>
void forEachRun(const std::vector<std::pair<std::uint64_t, std::uint32_t>>& pairs, const Use& use) {
    for (std::size_t first = 0; first < pairs.size();) {
        std::size_t last = first + 1;
        while (last < pairs.size() && pairs[last].first == pairs[first].first) {
            ++last;
        }
        if (last - first > 1) {
            use(first, last);
        }
        first = last;
    }
}

}  // namespace tetralux::mesh
