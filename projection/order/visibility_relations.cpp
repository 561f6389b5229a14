// SPDX-License-Identifier: Apache-2.0
#include <projection/order/visibility_relations.h>

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <projection/core/gathered.h>

namespace tetralux::projection {

namespace {

/// Bits k and 4 + k (VisibilityRelations) from what the exact predicate says.
unsigned exactSides(const CellProjector& projector, mesh::CellIndex cell) {
    const std::array<double, 4> side = projector.eyeSides(cell);
    unsigned sides = 0;
    for (unsigned k = 0; k < 4; ++k) sides |= side[k] < 0 ? 1u << k : side[k] > 0 ? 16u << k : 0u;
    return sides;
}

}  // namespace

void VisibilityRelations::see(const CellProjector& projector) {
    gaps_.clear();
    reversedGaps_.clear();
    sides_.resize(adjacency_.neighbours.size());
    const RoundedPlanes::Eye eye = planes_.eye(projector.frame());
    constexpr std::size_t atOnce = 256;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, (sides_.size() + atOnce - 1) / atOnce, 16), [&](const auto& range) {
            std::array<std::uint8_t, atOnce> certain{};
            for (std::size_t block = range.begin(); block != range.end(); ++block) {
                const std::size_t first = block * atOnce, end = std::min(first + atOnce, sides_.size());
                if (!planes_.empty())
                    planes_.sides(static_cast<mesh::CellIndex>(first), end - first, eye, certain.data());
                for (std::size_t i = first; i < end; ++i)
                    sides_[i] = innerSides(static_cast<mesh::CellIndex>(i), certain[i - first], projector);
            }
        });
}

/// The sides of inner faces: those that are certain, and by the exact predicate those that are not.
std::uint16_t VisibilityRelations::innerSides(mesh::CellIndex cell, unsigned certain,
                                              const CellProjector& projector) const {
    unsigned inner = 0;
    for (unsigned k = 0; k < 4; ++k)
        inner |= (adjacency_.neighbours[cell][k] != mesh::Adjacency::noNeighbour ? 17u : 0u) << k;
    const unsigned known = certain | certain >> 4 | certain << 4;
    if (inner & ~known) certain |= exactSides(projector, cell) & ~known;
    return static_cast<std::uint16_t>(certain & inner);
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
    // a fiftieth: to mend more takes as long as to sort anew; four of few are no sample
    return wrong * step * 50 <= sides_.size() + step * 200;
}

std::vector<CellPair> VisibilityRelations::violations(const std::vector<std::uint32_t>& places) const {
    auto all = gathered<CellPair>(sides_.size(), [&](std::size_t i, auto& found) {
        const auto cell = static_cast<mesh::CellIndex>(i);
        eachBehind(cell, [&](mesh::CellIndex other) {
            if (places[other] < places[cell]) found.emplace_back(cell, other);
        });
    });
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
