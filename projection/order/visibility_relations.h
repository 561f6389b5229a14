// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <mesh/tet/adjacency.h>
#include <projection/cells/cell_setup.h>
#include <projection/order/rounded_planes.h>

namespace tetralux::projection {

/// (nearer, farther)
using CellPair = std::pair<mesh::CellIndex, mesh::CellIndex>;

/// Which cell lies directly in front of which, for one eye: across shared faces (Williams' MPVO, 1992) and across the
/// gaps of a nonconvex boundary. Wherever two cells follow one another along a pixel's ray there is a relation
/// between them, so an order that keeps all relations is right in every pixel.
class VisibilityRelations {
public:
    /// Both are kept by reference. `planes`: all of the mesh's, or none, which takes longer.
    VisibilityRelations(const mesh::Adjacency& adjacency, const RoundedPlanes& planes)
        : adjacency_(adjacency), planes_(planes) {}

    /// Sides of all faces as this frame's eye sees them, in parallel; no gaps. A face seen edge-on is in front for
    /// neither of its cells: no relation.
    void see(const CellProjector& projector);

    /// Pairs across gaps: unique and sorted.
    void setGaps(std::vector<CellPair> gaps);

    std::size_t cellCount() const { return sides_.size(); }

    /// How many cells lie directly in front of `cell`.
    std::uint32_t countBefore(mesh::CellIndex cell) const {
        const unsigned sides = sides_[cell];
        std::uint32_t count = (sides & 1u) + (sides >> 1 & 1u) + (sides >> 2 & 1u) + (sides >> 3 & 1u);
        if (!(sides & gapBefore)) return count;
        for (auto i = firstOf(reversedGaps_, cell); i != reversedGaps_.end() && i->first == cell; ++i) ++count;
        return count;
    }

    /// A step of Kahn's sort: takes one off `nearer` of each cell behind `cell`, and appends the cells for which
    /// nothing is left to `sorted`, which holds `found`. Returns how many it holds then; it needs room for one more. No
    /// branches: half of them would be mispredicted.
    std::size_t release(mesh::CellIndex cell, std::uint32_t* nearer, mesh::CellIndex* sorted, std::size_t found) const {
        const unsigned sides = sides_[cell];
        const std::array<mesh::CellIndex, 4>& neighbours = adjacency_.neighbours[cell];
        const auto count = [&](mesh::CellIndex other, unsigned one) {
            nearer[other] -= one;
            sorted[found] = other;
            found += one & (nearer[other] == 0 ? 1u : 0u);
        };
        for (unsigned k = 0; k < 4; ++k) {
            const unsigned behind = sides >> (4 + k) & 1u;
            count(behind ? neighbours[k] : cell, behind);
        }
        if (sides & gapBehind)
            for (auto i = firstOf(gaps_, cell); i != gaps_.end() && i->first == cell; ++i) count(i->second, 1);
        return found;
    }

    /// release of this cell will be asked for soon.
    void prefetch(mesh::CellIndex cell) const { __builtin_prefetch(&adjacency_.neighbours[cell]); }

    /// Calls visit(cell) for each cell that lies directly behind `cell`.
    template <class Visit>
    void eachBehind(mesh::CellIndex cell, Visit visit) const {
        eachAcross(cell, 4, visit);
        if (!(sides_[cell] & gapBehind)) return;
        for (auto i = firstOf(gaps_, cell); i != gaps_.end() && i->first == cell; ++i) visit(i->second);
    }

    /// Calls visit(cell) for each cell that lies directly in front of `cell`.
    template <class Visit>
    void eachBefore(mesh::CellIndex cell, Visit visit) const {
        eachAcross(cell, 0, visit);
        if (!(sides_[cell] & gapBefore)) return;
        for (auto i = firstOf(reversedGaps_, cell); i != reversedGaps_.end() && i->first == cell; ++i) visit(i->second);
    }

    /// Whether an order is worth repairing, by a sample of the cells.
    bool mostlyHold(const std::vector<std::uint32_t>& places) const;

    /// Pairs that the places (one per cell, ascending from the eye) have the wrong way round.
    std::vector<CellPair> violations(const std::vector<std::uint32_t>& places) const;

private:
    std::uint16_t innerSides(mesh::CellIndex cell, unsigned certain, const CellProjector& projector) const;

    // bit k: face k shows its outside to the eye; bit 4 + k: its inside
    static constexpr std::uint16_t gapBehind = 1u << 8, gapBefore = 1u << 9;

    template <class Visit>
    void eachAcross(mesh::CellIndex cell, unsigned shift, Visit visit) const {
        for (unsigned k = 0; k < 4; ++k)
            if (sides_[cell] >> (shift + k) & 1u) visit(adjacency_.neighbours[cell][k]);
    }
    static std::vector<CellPair>::const_iterator firstOf(const std::vector<CellPair>& pairs, mesh::CellIndex cell);

    const mesh::Adjacency& adjacency_;
    const RoundedPlanes& planes_;
    std::vector<std::uint16_t> sides_;  // only of faces with a neighbour
    std::vector<CellPair> gaps_, reversedGaps_;
};

/// Whether `nearestFirst`, any of a mesh's cells, stand as the faces ask that two of them share. `places` is memory for
/// one number per cell of the mesh, kept from call to call.
bool keepsFaceRelations(const mesh::Adjacency& adjacency, const CellProjector& projector,
                        std::span<const mesh::CellIndex> nearestFirst, std::vector<std::uint32_t>& places);

}  // namespace tetralux::projection
