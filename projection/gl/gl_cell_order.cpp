// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_cell_order.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <projection/core/transfer_support.h>
#include <projection/order/visibility_relations.h>

namespace tetralux::projection {

namespace {

constexpr std::size_t chunkCells = 8192;

}  // namespace

GlCellOrder::GlCellOrder(const Scene& scene, bool ordered, bool looksUp) : cellCount_(scene.mesh->cells.size()) {
    if (looksUp && scene.settings.skipInvisible) findVisible(scene);
    if (shows_.empty()) {
        visible_.resize(cellCount_);
        std::iota(visible_.begin(), visible_.end(), mesh::CellIndex{0});
    }
    if (ordered) sorter_.emplace(*scene.mesh, scene.settings.order, VisibilitySorter::Use::Whole, scene.meshMemo.get());
}

void GlCellOrder::findVisible(const Scene& scene) {
    const CellVisibility visibility(*scene.mesh, scene.transferFunction, scene.settings);
    shows_.resize(cellCount_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cellCount_, 4096), [&](const auto& range) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell)
            shows_[cell] = visibility.shows(static_cast<mesh::CellIndex>(cell)) ? 1 : 0;
    });
    for (std::size_t cell = 0; cell < cellCount_; ++cell)
        if (shows_[cell] != 0) visible_.push_back(static_cast<mesh::CellIndex>(cell));
}

void GlCellOrder::describe(FrameReport& report) const {
    report.orderMethod = sorter_ ? sorter_->method() : "none";
    if (!sorter_) return;
    report.failingFaces = sorter_->failingFaces();
    report.incrementalSort = "sorted";
}

void GlCellOrder::tellSkipped(std::uint64_t outsideView, std::uint64_t noPixelCentre, FrameReport& report) const {
    report.cellsSkipped.clear();
    const std::pair<SkipReason, std::uint64_t> counts[] = {{SkipReason::OutsideView, outsideView},
                                                           {SkipReason::NoPixelCentre, noPixelCentre},
                                                           {SkipReason::Invisible, cellCount_ - visible_.size()}};
    for (const auto& [reason, cells] : counts)
        if (cells > 0) report.cellsSkipped[skipReasonName(reason)] = cells;
}

/// Fills drawn_ with the candidates that cover pixels, in their order, and counts the others.
void GlCellOrder::select(const CellProjector& projector, std::span<const mesh::CellIndex> candidates,
                         FrameReport& report) {
    struct Chunk {
        std::size_t drawn = 0;
        std::array<std::uint64_t, 4> skipped{};
    };
    std::vector<Chunk> chunks((candidates.size() + chunkCells - 1) / chunkCells);
    drawn_.resize(candidates.size());
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        const std::size_t begin = c * chunkCells, end = std::min(candidates.size(), begin + chunkCells);
        PixelRect rect;
        for (std::size_t i = begin; i < end; ++i) {
            const SkipReason reason = projector.bounds(candidates[i], rect);
            ++chunks[c].skipped[static_cast<std::size_t>(reason)];
            if (reason == SkipReason::None) drawn_[begin + chunks[c].drawn++] = candidates[i];
        }
    });
    std::array<std::uint64_t, 4> skipped{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        const auto first = drawn_.begin() + static_cast<std::ptrdiff_t>(c * chunkCells);
        std::copy(first, first + static_cast<std::ptrdiff_t>(chunks[c].drawn),
                  drawn_.begin() + static_cast<std::ptrdiff_t>(count));
        count += chunks[c].drawn;
        for (std::size_t r = 0; r < skipped.size(); ++r) skipped[r] += chunks[c].skipped[r];
    }
    drawn_.resize(count);
    tellSkipped(skipped[static_cast<std::size_t>(SkipReason::OutsideView)] + visible_.size() - candidates.size(),
                skipped[static_cast<std::size_t>(SkipReason::NoPixelCentre)], report);
    report.cellsDrawn = count;
}

/// Sorts drawn_ by keys, the farthest first. False where that breaks a relation across a face between two of them:
/// keys are certain in exact numbers, these are doubles.
bool GlCellOrder::sortDrawn(const CellProjector& projector) {
    keySorter_.sort(*keys(), keys()->eye(projector.frame()), drawn_);
    if (relations() != nullptr && !keepsFaceRelations(*relations(), projector, drawn_, places_)) return false;
    std::reverse(drawn_.begin(), drawn_.end());
    return true;
}

const std::vector<mesh::CellIndex>& GlCellOrder::backToFront(const CellProjector& projector, FrameReport& report) {
    const VisibilityOrder& order = sorter_->sort(projector);
    report.cellsSorted = order.frontToBack.size();
    report.orderCycles = order.cyclicCells;
    report.incrementalSort = order.incrementalSort;
    report.uncertainPixels = order.uncertainPixels;
    ordered_.clear();
    for (auto cell = order.frontToBack.rbegin(); cell != order.frontToBack.rend(); ++cell)
        if (shows_.empty() || shows_[*cell] != 0) ordered_.push_back(*cell);
    return ordered_;
}

const std::vector<mesh::CellIndex>& GlCellOrder::drawnCells(const CellProjector& projector, FrameReport& report) {
    describe(report);
    sortMilliseconds_ = 0.0;
    auto timed = [&](auto sort) {
        const auto start = std::chrono::steady_clock::now();
        const auto sorted = sort();
        sortMilliseconds_ +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        return sorted;
    };
    auto wholeOrder = [&] { return std::span(backToFront(projector, report)); };
    select(projector, ofWholeMesh() ? timed(wholeOrder) : std::span(std::as_const(visible_)), report);
    if (keys() != nullptr) {
        report.cellsSorted = drawn_.size();
        if (!timed([&] { return sortDrawn(projector); })) select(projector, timed(wholeOrder), report);
    }
    return drawn_;
}

void GlCellOrder::tellDisorder(const CellProjector& projector, FrameReport& report) {
    if (sorter_ && sorter_->method() == "centroid") report.uncertainPixels = sorter_->pixelsOutOfOrder(projector);
}

}  // namespace tetralux::projection
