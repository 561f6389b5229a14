// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace tetralux::projection {

/// What add(i, found) appends for every i below `count`, in parallel, in no order.
template <class Item, class Add>
std::vector<Item> gathered(std::size_t count, Add add) {
    tbb::enumerable_thread_specific<std::vector<Item>> parts;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
        auto& part = parts.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) add(i, part);
    });
    std::vector<Item> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace tetralux::projection
