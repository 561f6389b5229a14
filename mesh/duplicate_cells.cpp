// SPDX-License-Identifier: Apache-2.0
#include <mesh/duplicate_cells.h>

#include <algorithm>

#include <mesh/hash_collisions.h>

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

}  // namespace

std::vector<std::uint8_t> findDuplicateCells(const std::vector<Tetrahedron>& cells, std::size_t pointCount) {
    // Places go with the smallest point, because neighbours in the list are neighbours in space: a place at random
    // would miss the caches, which costs ten times as much.
    constexpr std::uint64_t placesPerPoint = 128;
    const auto candidates = collisionCandidates(
        cells.size(), [&](std::size_t i) { return pointsHash(cells[i]); }, placesPerPoint * pointCount,
        [&](std::size_t i, std::uint64_t hash) {
            const std::uint64_t smallest = *std::min_element(cells[i].begin(), cells[i].end());
            return smallest * placesPerPoint + hash % placesPerPoint;
        });
    std::vector<std::uint8_t> duplicate;
    std::vector<std::pair<Tetrahedron, std::uint32_t>> run;
    forEachRun(candidates, [&](std::size_t first, std::size_t last) {
        run.clear();
        for (std::size_t i = first; i < last; ++i) {
            run.emplace_back(sortedPoints(cells[candidates[i].second]), candidates[i].second);
        }
        std::sort(run.begin(), run.end());
        for (std::size_t i = 1; i < run.size(); ++i) {
            if (run[i].first == run[i - 1].first) {
                duplicate.resize(cells.size(), 0);
                duplicate[run[i].second] = 1;
            }
        }
    });
    return duplicate;
}

}  // namespace tetralux::mesh
