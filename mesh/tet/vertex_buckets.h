// SPDX-License-Identifier: Apache-2.0
/// \file
/// Items sorted into buckets by a small integer, as the first pass of a counting sort, by many threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tetralux::mesh {

/// Bucket b holds items[begin(b)] … items[end(b) − 1], in no particular order (it depends on the threads: sort a
/// bucket before anything is concluded from its order). `Id` must hold item numbers and their count.
template <class Id>
class VertexBuckets {
public:
    /// `keyOf(item)` is the bucket of item 0 … itemCount − 1, below `bucketCount`. It is called twice per item.
    template <class KeyOf>
    VertexBuckets(std::size_t itemCount, std::size_t bucketCount, const KeyOf& keyOf)
        : ends_(std::make_unique<std::atomic<Id>[]>(bucketCount)),
          items_(std::make_unique_for_overwrite<Id[]>(itemCount)) {
        using Range = tbb::blocked_range<std::size_t>;
        constexpr std::size_t grain = 32768;
        tbb::parallel_for(Range(0, itemCount, grain), [&](const Range& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                ends_[keyOf(i)].fetch_add(1, std::memory_order_relaxed);
            }
        });
        Id start = 0;  // sizes become starts, and filling turns starts into ends
        for (std::size_t b = 0; b < bucketCount; ++b) {
            const Id size = ends_[b].load(std::memory_order_relaxed);
            ends_[b].store(start, std::memory_order_relaxed);
            start = static_cast<Id>(start + size);
        }
        tbb::parallel_for(Range(0, itemCount, grain), [&](const Range& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                items_[ends_[keyOf(i)].fetch_add(1, std::memory_order_relaxed)] = static_cast<Id>(i);
            }
        });
    }

    std::size_t begin(std::size_t b) const { return b == 0 ? 0 : end(b - 1); }
    std::size_t end(std::size_t b) const { return static_cast<std::size_t>(ends_[b].load(std::memory_order_relaxed)); }
    Id item(std::size_t slot) const { return items_[slot]; }

private:
    std::unique_ptr<std::atomic<Id>[]> ends_;
    std::unique_ptr<Id[]> items_;
};

}  // namespace tetralux::mesh
