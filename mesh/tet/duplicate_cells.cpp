// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/duplicate_cells.h>

#include <utility>

namespace tetralux::mesh {
namespace {

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

}  // namespace

DuplicateSearch::DuplicateSearch(std::size_t cellCount, std::size_t pointCount)
    : items_(cellCount + 4 * spread, std::max<std::size_t>(1, pointCount)),
      placesPerPoint_(((items_.places() - spread) << 32) / std::max<std::size_t>(1, pointCount)) {}

std::vector<std::uint32_t> DuplicateSearch::duplicatesAmong(const std::vector<Tetrahedron>& cells,
                                                            const EqualItems::Pairs& maybeEqual) {
    std::vector<std::uint32_t> duplicates;
    std::vector<std::pair<Tetrahedron, std::uint32_t>> run;
    forEachRun(maybeEqual, [&](std::size_t first, std::size_t last) {
        run.clear();
        for (std::size_t i = first; i < last; ++i) {
            run.emplace_back(sortedPoints(cells[maybeEqual[i].second]), maybeEqual[i].second);
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
