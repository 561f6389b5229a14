// SPDX-License-Identifier: Apache-2.0
#include <mesh/duplicate_cells.h>

#include <algorithm>
#include <utility>

namespace tetralux::mesh {
namespace {

/// The same for every order of the points.
std::uint64_t pointsHash(const Tetrahedron& cell) {
    std::uint64_t sum = 0;
    for (const PointIndex p : cell) {
        const std::uint64_t product = (p + 1) * 0x9e3779b97f4a7c15ull;
        sum += product ^ product >> 32;
    }
    return mixed(1, sum);
}

/// The points in ascending order, by a network of five exchanges.
Tetrahedron sortedPoints(Tetrahedron cell) {
    const auto order = [&cell](std::size_t i, std::size_t j) {
        const PointIndex low = std::min(cell[i], cell[j]);
        cell[j] = std::max(cell[i], cell[j]);
        cell[i] = low;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
    return cell;
}

bool haveSamePoints(const Tetrahedron& a, const Tetrahedron& b) {
    // Most that are asked about differ in this already.
    const bool maybe = (a[0] ^ a[1] ^ a[2] ^ a[3]) == (b[0] ^ b[1] ^ b[2] ^ b[3]);
    return maybe && sortedPoints(a) == sortedPoints(b);
}

}  // namespace

// Places go with the smallest point, because neighbours in the list are neighbours in space: a place at random would
// miss the caches, which costs ten times as much.
DuplicateSearch::DuplicateSearch(std::size_t cellCount, std::size_t pointCount)
    : items_(std::max(cellCount, pointCount), 2),
      slotsPerPoint_(items_.slots() / std::max<std::size_t>(1, pointCount)) {}

void DuplicateSearch::note(const std::vector<Tetrahedron>& cells, std::uint32_t i) {
    const Tetrahedron& cell = cells[i];
    const std::uint64_t hash = pointsHash(cell);
    const std::uint64_t smallest = std::min({cell[0], cell[1], cell[2], cell[3]});
    items_.note(i, smallest * slotsPerPoint_ + placeBelow(slotsPerPoint_, hash), hash,
                [&](std::uint32_t other) { return haveSamePoints(cells[other], cell); });
}

std::vector<std::uint32_t> DuplicateSearch::find(const std::vector<Tetrahedron>& cells) {
    const EqualItems::Pairs equal = items_.find();
    std::vector<std::uint32_t> duplicates;
    std::vector<std::pair<Tetrahedron, std::uint32_t>> run;
    forEachRun(equal, [&](std::size_t first, std::size_t last) {
        run.clear();
        for (std::size_t i = first; i < last; ++i) {
            run.emplace_back(sortedPoints(cells[equal[i].second]), equal[i].second);
        }
        std::sort(run.begin(), run.end());
        for (std::size_t i = 1; i < run.size(); ++i) {
            if (run[i].first == run[i - 1].first) {
                duplicates.push_back(run[i].second);
            }
        }
    });
    std::sort(duplicates.begin(), duplicates.end());
    return duplicates;
}

}  // namespace tetralux::mesh
