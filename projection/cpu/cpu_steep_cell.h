// SPDX-License-Identifier: Apache-2.0
/// \file
/// Cells that floats cannot hold, in double. Floats err by a millionth of a pixel or so in where a face's plane stands:
/// that times the plane's slope is the error of where rays enter and leave. Where it is not small to the cell's own
/// thickness (a face seen edge-on, a sliver, a cell about the eye) rays are cut in double, half of a block at a time:
/// then no ray loses or gains a piece at a face, however near to it it runs. Included once per instruction set.
#include <projection/cpu/cpu_cell_batch.h>
#include <projection/cpu/cpu_segment.h>

#include <projection/cpu/cpu_tile_buffers.h>

#if defined(TETRALUX_CPU_STEEP_CELL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_STEEP_CELL_H
#undef TETRALUX_CPU_STEEP_CELL_H
#else
#define TETRALUX_CPU_STEEP_CELL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

namespace in_double {
using real = wide;
using cell_real = wide;
#include <projection/cells/cell_interval.glsl>
}  // namespace in_double

/// The rays of a block of pixels in such a cell, some of its lanes at a time.
class SteepRays {
public:
    /// `x`, `y`: the block's first pixel within the tile.
    HWY_NOINLINE SteepRays(const CellBatch& batch, std::size_t j, int x, int y)
        : batch_(batch), steep_(batch.steep), j_(j) {
        for (std::size_t i = 0; i < laneCount(); ++i) {
            dx_[i] = steep_.offsetX[j] + static_cast<double>(x + static_cast<int>(i % columnWidth));
            dy_[i] = steep_.offsetY[j] + static_cast<double>(y + static_cast<int>(i / columnWidth));
        }
        const FaceOrder& order = faceOrders[batch.frontMask[j]];
        for (std::size_t i = 0; i < laneCount(); i += step) {
            wide in(order.fronts < 4 ? static_cast<double>(batch.inverseDepthNear[j])
                                     : -1e30);  // none is seen of a flat cell
            wide out(static_cast<double>(batch.inverseDepthFar[j]));
            for (int k = 0; k < 4; ++k) {
                const auto& plane = steep_.plane[order.face[k]];
                const wide inverseDepth = in_double::planeInverseDepth(wide(plane[0][j]), wide(plane[1][j]),
                                                                       wide(plane[2][j]), load(dx_ + i), load(dy_ + i));
                if (k < order.fronts)
                    in = min(in, inverseDepth);
                else
                    out = max(out, inverseDepth);
            }
            store(in, in_ + i);
            store(out, out_ + i);
        }
    }

    /// Inverse depth ratios at which rays enter and leave.
    HWY_INLINE void interval(real& in, real& out) const {
        in = rounded(in_);
        out = rounded(out_);
    }

    /// What lies between the numbers that interval() told, or what limits have made of them.
    HWY_NOINLINE void cut(real in, real out, float scale, real rayLength, bool orthographic, Segments& segments) {
        limitTo(in, rounded(in_), in_);
        limitTo(out, rounded(out_), out_);
        alignas(64) float rays[most];
        alignas(64) double front[most], back[most], length[most], between[most];
        storeAt(rayLength, rays);
        const wide atReference(steep_.scalar[j_]), perX(steep_.scalarPerX[j_]), perY(steep_.scalarPerY[j_]),
            perInverseDepth(steep_.scalarPerInverseDepth[j_]), low(static_cast<double>(batch_.scalarLow[j_])),
            high(static_cast<double>(batch_.scalarHigh[j_])), lengths(static_cast<double>(scale));
        for (std::size_t i = 0; i < laneCount(); i += step) {
            const wide dx = load(dx_ + i), dy = load(dy_ + i), from = load(in_ + i), to = load(out_ + i);
            store(from - to, between + i);
            if (orthographic) {
                store(in_double::scalarOrthographic(atReference, perX, perY, perInverseDepth, dx, dy, from, low, high),
                      front + i);
                store(in_double::scalarOrthographic(atReference, perX, perY, perInverseDepth, dx, dy, to, low, high),
                      back + i);
                store(in_double::segmentLengthOrthographic(lengths, from, to), length + i);
            } else {
                const wide ray(hn::PromoteTo(DoubleTag(), hn::LoadU(HalfFloatTag(), rays + i)));
                store(in_double::scalarPerspective(atReference, perX, perY, perInverseDepth, dx, dy, from, low, high),
                      front + i);
                store(in_double::scalarPerspective(atReference, perX, perY, perInverseDepth, dx, dy, to, low, high),
                      back + i);
                store(in_double::segmentLengthPerspective(lengths, from, to, ray), length + i);
            }
        }
        segments.length = rounded(length);
        segments.live = rounded(between) > real(0.0f);
        segments.front = rounded(front);
        segments.back = rounded(back);
    }

private:
    static constexpr std::size_t most = 16, step = hn::MaxLanes(DoubleTag());

    HWY_INLINE static wide load(const double* from) { return hn::Load(DoubleTag(), from); }
    HWY_INLINE static void store(wide value, double* to) { hn::Store(value.v, DoubleTag(), to); }
    HWY_INLINE static real rounded(const double* from) {
        alignas(64) float floats[most];
        for (std::size_t i = 0; i < laneCount(); i += step)
            hn::StoreU(hn::DemoteTo(HalfFloatTag(), load(from + i).v), HalfFloatTag(), floats + i);
        return loadAligned(floats);
    }
    /// Takes over where `clipped` is no longer what was told.
    HWY_INLINE static void limitTo(real clipped, real told, double* numbers) {
        alignas(64) float now[most], before[most];
        storeAt(clipped, now);
        storeAt(told, before);
        for (std::size_t i = 0; i < laneCount(); ++i)
            if (now[i] != before[i]) numbers[i] = static_cast<double>(now[i]);
    }

    const CellBatch& batch_;
    const SteepCells& steep_;
    const std::size_t j_;
    alignas(64) double dx_[most], dy_[most], in_[most], out_[most];
};

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
