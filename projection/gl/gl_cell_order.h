// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: which cells a frame of the OpenGL engine draws, and in which order.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <projection/core/engine.h>
#include <projection/order/key_sort.h>
#include <projection/order/visibility_order.h>

namespace tetralux::projection {

class GlCellOrder {
public:
    /// `ordered`: whether the picture depends on the order of cells. `looksUp`: whether the transfer function says
    /// which cells show.
    GlCellOrder(const Scene& scene, bool ordered, bool looksUp);

    /// The cells that the transfer function shows, ascending.
    const std::vector<mesh::CellIndex>& visible() const { return visible_; }

    /// Keys that put any of the cells in order; nullptr where there are none or none are needed.
    const OrderKeys* keys() const { return sorter_ && !sorter_->keys().empty() ? &sorter_->keys() : nullptr; }

    /// Whose relations an order by keys must keep; nullptr where it is not held to any.
    const mesh::Adjacency* relations() const {
        return sorter_ && sorter_->method() == "power" ? &sorter_->adjacency() : nullptr;
    }

    /// Whether the order is one of all cells at once, to be asked of backToFront: neither keys nor indifference.
    bool ofWholeMesh() const { return sorter_ && sorter_->keys().empty(); }

    /// Cells that cover pixels and show something, the farthest first; in a frame without order as they come. Valid
    /// until the next call. Only what is drawn is sorted where there are keys.
    const std::vector<mesh::CellIndex>& drawnCells(const CellProjector& projector, FrameReport& report);

    /// All visible cells, the farthest first, by the relations of the whole mesh; where ofWholeMesh().
    const std::vector<mesh::CellIndex>& backToFront(const CellProjector& projector, FrameReport& report);

    /// Of drawnCells' last call, what was spent on the order.
    double sortMilliseconds() const { return sortMilliseconds_; }

    /// Adds to a report which cells are not drawn: of the visible ones so many for either reason, and the invisible.
    void tellSkipped(std::uint64_t outsideView, std::uint64_t noPixelCentre, FrameReport& report) const;

    /// What a report says of the order, whoever made it.
    void describe(FrameReport& report) const;

    /// Of an order by centroids: the pixels that it may spoil are uncertain.
    void tellDisorder(const CellProjector& projector, FrameReport& report);

private:
    void findVisible(const Scene& scene);
    void select(const CellProjector& projector, std::span<const mesh::CellIndex> candidates, FrameReport& report);
    bool sortDrawn(const CellProjector& projector);

    std::size_t cellCount_;
    std::vector<mesh::CellIndex> visible_;
    std::vector<std::uint8_t> shows_;  // empty: all do
    std::optional<VisibilitySorter> sorter_;
    KeySorter keySorter_;
    std::vector<mesh::CellIndex> drawn_, ordered_;
    std::vector<std::uint32_t> places_;
    double sortMilliseconds_ = 0.0;
};

}  // namespace tetralux::projection
