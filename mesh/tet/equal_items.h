// SPDX-License-Identifier: Apache-2.0
/// \file
/// Equal items among millions of mostly different ones, by many threads and without sorting or keeping all of them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <mesh/tet/huge_pages.h>

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

/// Two passes. The first notes every item in a Bloom filter that keeps the bits of an item in one word (Putze, Sanders
/// and Singler 2007, "Cache-, Hash- and Space-Efficient Bloom Filters"): of equal items all but the first find their
/// bits set. The second collects what shares a group with such a one, a few in a thousand, and sorts just these.
class EqualItems {
public:
    /// Hash and number of an item.
    using Pairs = std::vector<std::pair<std::uint64_t, std::uint32_t>>;

    /// What equal items have in common. Groups and places are the faster the nearer those of successive items lie;
    /// all places should be about equally popular.
    struct Key {
        std::uint64_t group;  ///< below `groups` of the constructor
        std::uint64_t place;  ///< below `places()`
        std::uint64_t hash;
    };

    /// `groups`: 0 for as many as places.
    EqualItems(std::size_t items, std::size_t groups)
        : places_(items / itemsPerPlace + 1),
          bits_(zeros<std::uint64_t>(places_)),
          hot_(zeros<std::uint8_t>(groups == 0 ? places_ : groups)) {
        preferHugePages(bits_.get(), places_ * sizeof(std::uint64_t));
    }
    std::uint64_t places() const { return places_; }

    /// Once for each item, from any thread.
    void note(const Key& key) {
        const std::uint64_t mask =
            1ull << (key.hash & 63) | 1ull << (key.hash >> 6 & 63) | 1ull << (key.hash >> 12 & 63);
        const std::atomic_ref<std::uint64_t> word(bits_.get()[key.place]);
        std::uint64_t before = word.load(std::memory_order_relaxed);
        if ((before & mask) != mask) {
            before = word.fetch_or(mask, std::memory_order_relaxed);
        }
        if ((before & mask) == mask) {
            std::atomic_ref<std::uint8_t>(hot_.get()[key.group]).fetch_or(hotBit(key), std::memory_order_relaxed);
        }
    }

    static constexpr std::uint64_t noGroup = ~std::uint64_t{0};

    /// Hashes and numbers, sorted, of items 0 … count − 1 that equal another one, and of some that do not.
    /// `groupOf(item)` is the group under which the item was noted, or `noGroup` if it was not; `keyOf(item)` all of
    /// its key, for the few that are looked at closely.
    template <class GroupOf, class KeyOf>
    Pairs find(std::size_t count, const GroupOf& groupOf, const KeyOf& keyOf) const {
        Pairs found;
        std::mutex mutex;
        using Range = tbb::blocked_range<std::size_t>;
        tbb::parallel_for(Range(0, count, 32768), [&](const Range& range) {
            Pairs here;
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const std::uint64_t group = groupOf(static_cast<std::uint32_t>(i));
                if (group == noGroup || hot_.get()[group] == 0) {
                    continue;
                }
                const Key key = keyOf(static_cast<std::uint32_t>(i));
                if ((hot_.get()[group] & hotBit(key)) != 0) {
                    here.emplace_back(key.hash, static_cast<std::uint32_t>(i));
                }
            }
            const std::lock_guard lock(mutex);
            found.insert(found.end(), here.begin(), here.end());
        });
        tbb::parallel_sort(found.begin(), found.end());
        return found;
    }

private:
    static constexpr std::size_t itemsPerPlace = 4;  // three of 64 bits each: two in a thousand are taken for equal

    template <class Value>
    using Zeros = std::unique_ptr<Value, void (*)(void*)>;

    template <class Value>
    static Zeros<Value> zeros(std::size_t count) {
        Zeros<Value> values(static_cast<Value*>(std::calloc(count, sizeof(Value))), &std::free);
        if (values == nullptr) {
            throw std::bad_alloc();
        }
        return values;
    }

    static std::uint8_t hotBit(const Key& key) { return static_cast<std::uint8_t>(1u << (key.hash >> 18 & 7)); }

    std::uint64_t places_;
    Zeros<std::uint64_t> bits_;  // from calloc: cleared when touched
    Zeros<std::uint8_t> hot_;    // for each group, an eighth of its items for each bit
};

/// Calls `use(first, last)` for every run of two or more pairs of one hash; `pairs` are sorted.
template <class Use>
void forEachRun(const EqualItems::Pairs& pairs, const Use& use) {
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
