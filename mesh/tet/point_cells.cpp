// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/point_cells.h>

#include <algorithm>

#include <mesh/tet/vertex_buckets.h>

namespace tetralux::mesh {

PointCells::PointCells(std::span<const Tetrahedron> cells, std::size_t pointCount)
    : starts_(pointCount + 1), cells_(4 * cells.size()) {
    const VertexBuckets<std::size_t> buckets(4 * cells.size(), pointCount,
                                             [&](std::size_t i) { return cells[i / 4][i % 4]; });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pointCount, 4096), [&](const auto& range) {
        for (std::size_t point = range.begin(); point != range.end(); ++point) {
            starts_[point + 1] = buckets.end(point);
            for (std::size_t i = buckets.begin(point); i < buckets.end(point); ++i)
                cells_[i] = static_cast<CellIndex>(buckets.item(i) / 4);
            std::sort(cells_.begin() + static_cast<std::ptrdiff_t>(buckets.begin(point)),
                      cells_.begin() + static_cast<std::ptrdiff_t>(buckets.end(point)));
        }
    });
}

}  // namespace tetralux::mesh
