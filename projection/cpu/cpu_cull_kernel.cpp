// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which cells can be seen, in SIMD lanes over cells: the rectangle of the corners' pixels against the image and
/// against pixel centres.
#include <projection/cpu/cpu_targets.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "projection/cpu/cpu_cull_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include <projection/cpu/cpu_cull.h>
#include <projection/cpu/cpu_special_cell.h>

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
constexpr std::size_t mostLanes = 16;

/// First and last pixels of the rectangles of some cells.
struct Rectangles {
    alignas(64) std::int32_t x0[mostLanes], y0[mostLanes], x1[mostLanes], y1[mostLanes];
};

HWY_INLINE std::uint32_t bitsOf(hn::Mask<FloatTag> lanes) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(FloatTag(), lanes, bytes);
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// Lanes of a group of cells, as bits.
struct GroupBits {
    std::uint32_t seen, outside, atEye;  ///< atEye: a corner lies behind the eye
};

HWY_INLINE GroupBits rectanglesOf(const TileFrame& frame, hn::Vec<IntTag> cells, Rectangles& rectangles) {
    const FloatTag tag;
    const IntTag ints;
    const auto* corners = reinterpret_cast<const std::int32_t*>(frame.cells);
    const auto* pixels = reinterpret_cast<const float*>(frame.points);
    constexpr int xAt = 6, yAt = 7;  // in floats of CameraPoint
    const auto row = hn::ShiftLeft<2>(cells);
    hn::Vec<FloatTag> lowX, highX, lowY, highY, sum;
    for (int k = 0; k < 4; ++k) {
        const auto point = hn::ShiftLeft<3>(hn::GatherIndex(ints, corners, hn::Add(row, hn::Set(ints, k))));
        const auto x = hn::GatherIndex(tag, pixels, hn::Add(point, hn::Set(ints, xAt)));
        const auto y = hn::GatherIndex(tag, pixels, hn::Add(point, hn::Set(ints, yAt)));
        lowX = k == 0 ? x : hn::Min(lowX, x);
        highX = k == 0 ? x : hn::Max(highX, x);
        lowY = k == 0 ? y : hn::Min(lowY, y);
        highY = k == 0 ? y : hn::Max(highY, y);
        sum = k == 0 ? x : hn::Add(sum, x);
    }
    const auto pad = hn::Set(tag, pixelPadding(frame.width, frame.height)), zero = hn::Zero(tag);
    const auto lastX = hn::Set(tag, static_cast<float>(frame.width - 1)),
               lastY = hn::Set(tag, static_cast<float>(frame.height - 1));
    lowX = hn::Sub(lowX, pad);
    lowY = hn::Sub(lowY, pad);
    highX = hn::Add(highX, pad);
    highY = hn::Add(highY, pad);
    const auto inside =
        hn::And(hn::And(hn::Ge(highX, zero), hn::Ge(highY, zero)), hn::And(hn::Le(lowX, lastX), hn::Le(lowY, lastY)));
    const auto x0 = hn::Max(hn::Ceil(lowX), zero), y0 = hn::Max(hn::Ceil(lowY), zero);
    const auto x1 = hn::Min(hn::Floor(highX), lastX), y1 = hn::Min(hn::Floor(highY), lastY);
    hn::Store(hn::ConvertTo(ints, x0), ints, rectangles.x0);
    hn::Store(hn::ConvertTo(ints, y0), ints, rectangles.y0);
    hn::Store(hn::ConvertTo(ints, x1), ints, rectangles.x1);
    hn::Store(hn::ConvertTo(ints, y1), ints, rectangles.y1);
    const auto covers = hn::And(inside, hn::And(hn::Le(x0, x1), hn::Le(y0, y1)));
    const auto whole = hn::Eq(sum, sum);  // NaN where a corner has no pixel
    return {bitsOf(hn::And(whole, covers)), bitsOf(hn::AndNot(inside, whole)), ~bitsOf(whole)};
}

class Culling {
public:
    Culling(const TileFrame& frame, const CullTask& task, CullCounts& counts)
        : frame_(frame), task_(task), counts_(counts) {}

    std::size_t run() {
        const IntTag ints;
        const std::size_t lanes = hn::Lanes(ints);
        alignas(64) std::int32_t cells[mostLanes];
        for (std::size_t i = task_.begin; i < task_.end; i += lanes) {
            const std::size_t count = std::min(lanes, task_.end - i);
            auto all = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
            if (task_.shown) all &= static_cast<std::uint32_t>(task_.shown[i / 64] >> i % 64);
            if (all == 0) continue;
            for (std::size_t j = 0; j < lanes; ++j) {
                const std::size_t at = i + std::min(j, count - 1);
                cells[j] = static_cast<std::int32_t>(task_.visible ? task_.visible[at] : at);
            }
            GroupBits bits = rectanglesOf(frame_, hn::Load(ints, cells), rectangles_);
            addGroup({bits.seen & all, bits.outside & all, bits.atEye & all},
                     static_cast<std::size_t>(std::popcount(all)), cells);
        }
        return kept_;
    }

private:
    void addGroup(const GroupBits& bits, std::size_t count, const std::int32_t* cells) {
        const auto seen = static_cast<std::size_t>(std::popcount(bits.seen)),
                   outside = static_cast<std::size_t>(std::popcount(bits.outside)),
                   atEye = static_cast<std::size_t>(std::popcount(bits.atEye));
        counts_.outsideView += outside;
        counts_.noPixelCentre += count - seen - outside - atEye;
        for (std::uint32_t rest = bits.seen | bits.atEye; rest != 0; rest &= rest - 1) {
            const auto j = static_cast<std::size_t>(std::countr_zero(rest));
            const auto cell = static_cast<mesh::CellIndex>(cells[j]);
            if (HWY_UNLIKELY((bits.atEye >> j & 1u) != 0 || frame_.orthographic) &&
                !meetsFrontHalf(cell, (bits.atEye >> j & 1u) != 0, j))
                continue;
            add(cell, rectangles_.x0[j], rectangles_.y0[j], rectangles_.x1[j], rectangles_.y1[j]);
        }
    }

    /// Cells that reach behind the eye: their rectangle is that of the part in front.
    bool meetsFrontHalf(mesh::CellIndex cell, bool atEye, std::size_t j) {
        std::array<CameraPoint, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = frame_.points[frame_.cells[cell][k]];
        if (!atEye) {
            if (std::any_of(corners.begin(), corners.end(), [](const CameraPoint& p) { return p.z > 0; })) return true;
        } else {
            PixelRect rect;
            if (rectangleAtEye(frame_, corners, rect)) {
                rectangles_.x0[j] = rect.x0;
                rectangles_.y0[j] = rect.y0;
                rectangles_.x1[j] = rect.x1 - 1;
                rectangles_.y1[j] = rect.y1 - 1;
                return true;
            }
        }
        ++counts_.outsideView;
        return false;
    }

    HWY_INLINE void add(mesh::CellIndex cell, int x0, int y0, int x1, int y1) {
        const double key = task_.keys.keyOf(cell);
        counts_.nearest = std::max(counts_.nearest, key);
        counts_.farthest = std::min(counts_.farthest, key);
        auto tile = [](int pixel) HWY_ATTR { return static_cast<std::uint16_t>(pixel / cpuTileSize); };
        const VisibleCell visibleCell{key, cell, tile(x0), tile(y0), tile(x1), tile(y1)};
        for (int y = visibleCell.y0; y <= visibleCell.y1; ++y)
            for (int x = visibleCell.x0; x <= visibleCell.x1; ++x) ++task_.tileCounts[y * task_.tilesX + x];
        task_.visibleCells[kept_++] = visibleCell;
    }

    const TileFrame& frame_;
    const CullTask& task_;
    CullCounts& counts_;
    std::size_t kept_ = 0;
    Rectangles rectangles_;
};

std::size_t cullCellsHere(const TileFrame& frame, const CullTask& task, CullCounts& counts) {
    return Culling(frame, task, counts).run();
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetralux::projection {

HWY_EXPORT(cullCellsHere);

std::size_t cullCells(const TileFrame& frame, const CullTask& task, CullCounts& counts) {
    return HWY_DYNAMIC_DISPATCH(cullCellsHere)(frame, task, counts);
}

}  // namespace tetralux::projection
#endif
