// SPDX-License-Identifier: Apache-2.0
#include <mesh/duplicate_cells.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <mesh/vertex_buckets.h>

namespace tetralux::mesh {

std::vector<std::uint8_t> findDuplicateCells(const std::vector<Tetrahedron>& cells, std::size_t pointCount) {
    const VertexBuckets<std::uint32_t> buckets(cells.size(), pointCount,
                                               [&](std::size_t i) { return *std::min_element(cells[i].begin(), cells[i].end()); });
    std::vector<std::uint8_t> duplicate(cells.size(), 0);
    std::atomic<bool> any = false;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pointCount, 2048), [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<std::pair<Tetrahedron, std::uint32_t>> bucket;
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
            bucket.clear();
            for (std::size_t slot = buckets.begin(p); slot < buckets.end(p); ++slot) {
                Tetrahedron key = cells[buckets.item(slot)];
                std::sort(key.begin(), key.end());
                bucket.emplace_back(key, buckets.item(slot));
            }
            std::sort(bucket.begin(), bucket.end());
            for (std::size_t i = 1; i < bucket.size(); ++i) {
                if (bucket[i].first == bucket[i - 1].first) {
                    duplicate[bucket[i].second] = 1;
                    any.store(true, std::memory_order_relaxed);
                }
            }
        }
    });
    if (!any) {
        duplicate.clear();
    }
    return duplicate;
}

}  // namespace tetralux::mesh
