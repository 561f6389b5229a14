// SPDX-License-Identifier: Apache-2.0
#include <projection/order/incremental_sort.h>

#include <algorithm>

namespace tetralux::projection {

namespace {

/// Share of all cells that repairs may visit before sorting anew costs less.
constexpr std::size_t worthwhileShare = 8;

class Repair {
public:
    Repair(const VisibilityRelations& relations, std::vector<mesh::CellIndex>& order,
           std::vector<std::uint32_t>& places)
        : relations_(relations),
          order_(order),
          places_(places),
          reached_(relations.cellCount()),
          budget_(relations.cellCount() / worthwhileShare + 16) {}

    /// Moves cells so that `near` stands before `far`; false for a cycle or when the budget is spent.
    bool place(mesh::CellIndex near, mesh::CellIndex far) {
        if (places_[near] < places_[far]) return true;
        const std::uint32_t first = places_[far], last = places_[near];
        behind_.clear();
        before_.clear();
        const bool clean = reach(far, behind_,
                                 [&](mesh::CellIndex cell, auto visit) {
                                     relations_.eachBehind(cell, [&](mesh::CellIndex other) {
                                         if (places_[other] > places_[cell] && places_[other] <= last) visit(other);
                                     });
                                 }) &&
                           !reached_[near] && reach(near, before_, [&](mesh::CellIndex cell, auto visit) {
                               relations_.eachBefore(cell, [&](mesh::CellIndex other) {
                                   if (places_[other] < places_[cell] && places_[other] >= first) visit(other);
                               });
                           });
        for (mesh::CellIndex cell : behind_) reached_[cell] = false;
        for (mesh::CellIndex cell : before_) reached_[cell] = false;
        if (clean) exchange();
        return clean;
    }

private:
    /// Everything that `each` leads to from `start`, itself included.
    template <class Each>
    bool reach(mesh::CellIndex start, std::vector<mesh::CellIndex>& cells, Each each) {
        cells.push_back(start);
        reached_[start] = true;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (budget_-- == 0) {
                budget_ = 0;
                return false;
            }
            each(cells[i], [&](mesh::CellIndex other) {
                if (reached_[other]) return;
                reached_[other] = true;
                cells.push_back(other);
            });
        }
        return true;
    }

    /// What lies in front takes the first of the places that both sets hold, each set in its own order.
    void exchange() {
        auto byPlace = [&](mesh::CellIndex a, mesh::CellIndex b) { return places_[a] < places_[b]; };
        std::sort(before_.begin(), before_.end(), byPlace);
        std::sort(behind_.begin(), behind_.end(), byPlace);
        free_.clear();
        for (mesh::CellIndex cell : before_) free_.push_back(places_[cell]);
        for (mesh::CellIndex cell : behind_) free_.push_back(places_[cell]);
        std::sort(free_.begin(), free_.end());
        before_.insert(before_.end(), behind_.begin(), behind_.end());
        for (std::size_t i = 0; i < free_.size(); ++i) {
            order_[free_[i]] = before_[i];
            places_[before_[i]] = free_[i];
        }
    }

    const VisibilityRelations& relations_;
    std::vector<mesh::CellIndex>& order_;
    std::vector<std::uint32_t>& places_;
    std::vector<bool> reached_;
    std::size_t budget_;
    std::vector<mesh::CellIndex> behind_, before_;
    std::vector<std::uint32_t> free_;
};

}  // namespace

bool repairOrder(const VisibilityRelations& relations, const std::vector<CellPair>& violations,
                 std::vector<mesh::CellIndex>& order, std::vector<std::uint32_t>& places) {
    if (violations.size() > relations.cellCount() / worthwhileShare) return false;
    Repair repair(relations, order, places);
    return std::all_of(violations.begin(), violations.end(),
                       [&](const CellPair& pair) { return repair.place(pair.first, pair.second); });
}

}  // namespace tetralux::projection
