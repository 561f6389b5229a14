// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <mesh/tet/equal_items.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Finds cells with the same four points. Noting them can be part of another pass.
class DuplicateSearch {
public:
    DuplicateSearch(std::size_t cellCount, std::size_t pointCount);

    /// For each cell at most once, from any thread; its points must be below the `pointCount` given.
    void note(const Tetrahedron& cell) { items_.note(keyOf(cell)); }

    /// Those of `cells` that have the same points as one before them, in ascending order; only cells for which
    /// `noted(i)` says so, which must be those noted.
    template <class Noted>
    std::vector<std::uint32_t> find(const std::vector<Tetrahedron>& cells, const Noted& noted) const {
        return duplicatesAmong(
            cells,
            items_.find(
                cells.size(), [&](std::uint32_t i) { return noted(i) ? smallestPoint(cells[i]) : EqualItems::noGroup; },
                [&](std::uint32_t i) { return keyOf(cells[i]); }));
    }

private:
    /// Cells of one smallest point go to this many places, so that points with many cells do not crowd theirs.
    static constexpr std::uint64_t spread = 16;

    /// The polynomial whose roots are the points, at a place where no other is likely to have the same value: their
    /// order does not matter.
    static std::uint64_t pointsHash(const Tetrahedron& cell) {
        constexpr std::uint64_t odd = 0x9e3779b97f4a7c15ull;
        const auto factor = [](PointIndex p) { return odd + 2 * std::uint64_t{p}; };
        const std::uint64_t product = factor(cell[0]) * factor(cell[1]) * (factor(cell[2]) * factor(cell[3]));
        return product ^ product >> 32;
    }

    static std::uint64_t smallestPoint(const Tetrahedron& cell) {
        return std::min(std::min(cell[0], cell[1]), std::min(cell[2], cell[3]));
    }

    // Places go with the smallest point, because neighbours in the list are neighbours in space: a place at random
    // would miss the caches, which costs ten times as much.
    EqualItems::Key keyOf(const Tetrahedron& cell) const {
        const std::uint64_t hash = pointsHash(cell);
        const std::uint64_t smallest = smallestPoint(cell);
        return {smallest, (smallest * placesPerPoint_ >> 32) + (hash >> 21) % spread, hash};
    }

    static std::vector<std::uint32_t> duplicatesAmong(const std::vector<Tetrahedron>& cells,
                                                      const EqualItems::Pairs& maybeEqual);

    EqualItems items_;
    std::uint64_t placesPerPoint_;  ///< times 2^32
};

}  // namespace tetralux::mesh
