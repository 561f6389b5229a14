// SPDX-License-Identifier: Apache-2.0
#include <projection/order/key_sort.h>

#include <algorithm>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace tetralux::projection {

namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t grain = 8192;

struct Extent {
    double far = std::numeric_limits<double>::infinity(), near = -far;
};

Extent extentOf(const std::vector<double>& values) {
    return tbb::parallel_reduce(
        Range(0, values.size(), grain), Extent{},
        [&](const Range& range, Extent e) {
            for (std::size_t i = range.begin(); i != range.end(); ++i)
                e = {std::min(e.far, values[i]), std::max(e.near, values[i])};
            return e;
        },
        [](const Extent& a, const Extent& b) {
            return Extent{std::min(a.far, b.far), std::max(a.near, b.near)};
        });
}

/// Orders each run of equal whole-number keys by the doubles that they stand for.
void settleTies(std::vector<KeyedCell>& keyed, const std::vector<double>& values) {
    for (std::size_t begin = 0, end = 1; end <= keyed.size(); ++end) {
        if (end < keyed.size() && keyed[end].key == keyed[begin].key) continue;
        if (end - begin > 1)
            std::stable_sort(keyed.begin() + static_cast<std::ptrdiff_t>(begin),
                             keyed.begin() + static_cast<std::ptrdiff_t>(end),
                             [&](const KeyedCell& a, const KeyedCell& b) { return values[a.cell] > values[b.cell]; });
        begin = end;
    }
}

}  // namespace

void KeySorter::sort(const OrderKeys& keys, const glm::dvec4& eye, std::vector<mesh::CellIndex>& cells) {
    const std::vector<glm::dvec4>& planes = keys.planes();
    values_.resize(cells.size());
    keyed_.resize(cells.size());
    sorted_.resize(cells.size());
    auto eachPlace = [&](auto visit) {
        tbb::parallel_for(Range(0, cells.size(), grain), [&](const Range& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i);
        });
    };
    eachPlace([&](std::size_t i) { values_[i] = orderKey(planes[cells[i]], eye); });
    const Extent extent = extentOf(values_);
    eachPlace([&](std::size_t i) {
        keyed_[i] = {orderedKey(values_[i], extent.near, extent.far), static_cast<std::uint32_t>(i)};
    });
    radixSort(keyed_, scratch_);
    settleTies(keyed_, values_);
    eachPlace([&](std::size_t i) { sorted_[i] = cells[keyed_[i].cell]; });
    cells.swap(sorted_);
}

}  // namespace tetralux::projection
