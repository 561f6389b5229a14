// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include <tbb/parallel_sort.h>

#include <mesh/item_table.h>

namespace tetralux::mesh {

/// Collects, from any thread, the items that equal another one.
class EqualItems {
public:
    using Pairs = std::vector<std::pair<std::uint64_t, std::uint32_t>>;

    EqualItems(std::size_t items, std::size_t slotsPerItem) : table_(items, slotsPerItem) {}
    std::uint64_t slots() const { return table_.slots(); }

    /// As ItemTable::insert.
    template <class Equal>
    void note(std::uint32_t item, std::uint64_t place, std::uint64_t hash, const Equal& equal) {
        const std::uint32_t other = table_.insert(item, place, hash, equal);
        if (other != ItemTable::none) {
            const std::lock_guard lock(mutex_);
            found_.emplace_back(hash, item);
            found_.emplace_back(hash, other);
        }
    }

    /// Hash and number of every item that equals another one, sorted by hash and then number.
    Pairs find() {
        tbb::parallel_sort(found_.begin(), found_.end());
        found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
        return std::move(found_);
    }

private:
    ItemTable table_;
    std::mutex mutex_;
    Pairs found_;
};

}  // namespace tetralux::mesh
