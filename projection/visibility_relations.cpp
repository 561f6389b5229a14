// SPDX-License-Identifier: Apache-2.0
#include <projection/visibility_relations.h>

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace tetralux::projection {

VisibilityRelations::VisibilityRelations(const mesh::Adjacency& adjacency, const CellProjector& projector)
    : adjacency_(adjacency), sides_(adjacency.neighbours.size()) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sides_.size(), 2048), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::array<double, 4> side = projector.eyeSides(static_cast<mesh::CellIndex>(i));
            unsigned sides = 0;
            for (unsigned k = 0; k < 4; ++k) {
                if (adjacency.neighbours[i][k] == mesh::Adjacency::noNeighbour) continue;
                sides |= side[k] < 0 ? 1u << k : side[k] > 0 ? 16u << k : 0u;
            }
            sides_[i] = static_cast<std::uint16_t>(sides);
        }
    });
}

void VisibilityRelations::setGaps(std::vector<CellPair> gaps) {
    gaps_ = std::move(gaps);
    reversedGaps_.clear();
    reversedGaps_.reserve(gaps_.size());
    for (const auto& [near, far] : gaps_) {
        sides_[near] |= gapBehind;
        sides_[far] |= gapBefore;
        reversedGaps_.emplace_back(far, near);
    }
    std::sort(reversedGaps_.begin(), reversedGaps_.end());
}

std::vector<CellPair>::const_iterator VisibilityRelations::firstOf(const std::vector<CellPair>& pairs,
                                                                   mesh::CellIndex cell) {
    return std::lower_bound(pairs.begin(), pairs.end(), CellPair{cell, 0});
}

bool VisibilityRelations::mostlyHold(const std::vector<std::uint32_t>& places) const {
    constexpr std::size_t step = 61;  // a prime: cells from everywhere, in no rhythm of a grid
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < sides_.size(); i += step)
        eachBehind(static_cast<mesh::CellIndex>(i),
                   [&](mesh::CellIndex other) { wrong += places[other] < places[i] ? 1 : 0; });
    return wrong * step * 4 <= sides_.size() + step * 64;  // so few are no sample
}

std::vector<CellPair> VisibilityRelations::violations(const std::vector<std::uint32_t>& places) const {
    tbb::enumerable_thread_specific<std::vector<CellPair>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sides_.size(), 4096), [&](const auto& range) {
        auto& mine = found.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const auto cell = static_cast<mesh::CellIndex>(i);
            eachBehind(cell, [&](mesh::CellIndex other) {
                if (places[other] < places[cell]) mine.emplace_back(cell, other);
            });
        }
    });
    std::vector<CellPair> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

bool keepsFaceRelations(const mesh::Adjacency& adjacency, const CellProjector& projector,
                        std::span<const mesh::CellIndex> nearestFirst, std::vector<std::uint32_t>& places) {
    constexpr std::uint32_t notThere = 0xffffffffu;
    places.assign(adjacency.neighbours.size(), notThere);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nearestFirst.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            places[nearestFirst[i]] = static_cast<std::uint32_t>(i);
    });
    // in the order of their numbers, in which cells and points lie side by side
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, places.size(), 4096), true,
        [&](const auto& range, bool kept) {
            for (std::size_t i = range.begin(); kept && i != range.end(); ++i) {
                if (places[i] == notThere) continue;
                for (std::size_t k = 0; k < 4; ++k) {
                    const mesh::CellIndex other = adjacency.neighbours[i][k];
                    if (other == mesh::Adjacency::noNeighbour || other < i || places[other] == notThere) continue;
                    // negative: the face shows its outside to the eye, the other cell lies in front
                    const double side = projector.eyeSide(static_cast<mesh::CellIndex>(i), static_cast<int>(k));
                    kept = kept && !(places[other] > places[i] ? side < 0 : side > 0);
                }
            }
            return kept;
        },
        [](bool a, bool b) { return a && b; });
}

}  // namespace tetralux::projection
