// SPDX-License-Identifier: Apache-2.0
/// \file
/// Draws one tile: its cells front to back into accumulators that stay in the first cache.
///
/// A tile's pixels lie in columns four wide, row by row within a column, so that a vector of 4·n pixels covers n rows
/// of a column and may begin at any row: a cell of a few pixels takes fewer blocks than with blocks on a grid.
#include <array>
#include <cmath>
#include <type_traits>

#include <projection/cpu/cpu_cell_batch.h>
#include <projection/cpu/cpu_cell_rays.h>
#include <projection/cpu/cpu_limited_segment.h>
#include <projection/cpu/cpu_look.h>
#include <projection/cpu/cpu_segment.h>
#include <projection/cpu/cpu_shading.h>
#include <projection/cpu/cpu_steep_cell.h>
#include <projection/cpu/cpu_tile.h>
#include <projection/cpu/cpu_tile_buffers.h>

#if defined(TETRALUX_CPU_TILE_DRAWING_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_TILE_DRAWING_H
#undef TETRALUX_CPU_TILE_DRAWING_H
#else
#define TETRALUX_CPU_TILE_DRAWING_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// `Limited`: within frame.limits and with frame.classification; then ScaleInvariant is false and frame.scaleInvariant
/// counts, and Peaks is true.
/// `look`: how Composite is shaded, and Absorption with silhouettes; General: not at all.
template <TileKind Kind, bool ScaleInvariant, bool Peaks, bool Limited, Look look>
class TileDrawing {
public:
    TileDrawing(const TileFrame& frame, int x0, int y0, TileResult& result)
        : frame_(frame), x0_(x0), y0_(y0), result_(result) {
        alignas(64) float x[16], y[16];
        for (std::size_t i = 0; i < 16; ++i) {
            x[i] = static_cast<float>(i % columnWidth);
            y[i] = static_cast<float>(i / columnWidth);
        }
        laneX_ = loadAligned(x);
        laneY_ = loadAligned(y);
        layered_ = frame.limits != nullptr && !frame.limits->layerEnd.empty() && frame.shading->lit();
        clear();
    }

    void draw(std::span<const TileEntry> entries) {
        constexpr std::size_t ahead = 3 * CellBatch::capacity;
        std::size_t sinceCheck = 0;
        for (std::size_t i = 0; i < entries.size(); i += CellBatch::capacity) {
            for (std::size_t k = i + ahead; k < std::min(entries.size(), i + ahead + CellBatch::capacity); ++k)
                __builtin_prefetch(&frame_.cells[entries[k].cell]);
            const std::size_t cells = setUpBatch<gradients>(frame_, x0_, y0_, entries.subspan(i), batch_);
            result_.cellsSetUp += cells;
            if constexpr (looksAtPeaks) lookAtPeaks(frame_, batch_, cells, rays_, peakLooks_);
            for (std::size_t j = 0; j < cells; ++j) drawCell(j);
            if (frame_.earlyTermination && ++sinceCheck == 8) {
                sinceCheck = 0;
                if (finished()) {
                    result_.retired = i + cells < entries.size();
                    return;
                }
            }
        }
    }

    void resolve(Image& image) const {
        resolveTile<Kind>(frame_, px_, x0_, y0_, (colors || Kind == TileKind::Depth) && frame_.ordered, image, result_);
    }

private:
    static constexpr bool colors =
        Kind == TileKind::Composite || Kind == TileKind::Shaded || Kind == TileKind::FirstHit;
    static constexpr bool integrates =
        colors || Kind == TileKind::Absorption || Kind == TileKind::Additive || Kind == TileKind::Depth;
    static constexpr bool usesNormals = look == Look::Lit || look == Look::Lamps || Kind == TileKind::Shaded ||
                                        Kind == TileKind::FirstHit || Kind == TileKind::Additive ||
                                        (Limited && Kind == TileKind::Absorption);
    static constexpr GradientParts gradients = usesNormals                 ? GradientParts::All
                                               : look == Look::Silhouettes ? GradientParts::Magnitude
                                                                           : GradientParts::None;
    /// Light falls on the layers of cuts by their own normals, so segments are divided at the end of one.
    static constexpr bool cutLayers =
        Limited && (Kind == TileKind::Shaded || Kind == TileKind::FirstHit || Kind == TileKind::Additive);
    static constexpr bool looksAtPeaks = look != Look::General && Peaks && Kind == TileKind::Composite;
    static constexpr int rows = static_cast<int>(laneCount()) / columnWidth;

    void clear() {
        if constexpr (Limited) limits_.clear();
        for (int x = 0; x < cpuTileSize; ++x)
            for (int y = 0; y < paddedRows; ++y) {
                const std::size_t i = placeInTile(x, y);
                const bool inside = y < cpuTileSize && x0_ + x < frame_.width && y0_ + y < frame_.height;
                px_.r[i] = px_.g[i] = px_.b[i] = 0;
                if constexpr (colors || Kind == TileKind::Depth)
                    px_.t[i] = inside ? 1.0f : 0.0f;
                else if constexpr (Kind == TileKind::Absorption)
                    px_.t[i] = inside ? 0.0f : 1e30f;
                else
                    px_.t[i] = Kind == TileKind::Mip ? unset : Kind == TileKind::Minimum ? -unset : 0.0f;
                px_.last[i] = nothingYet;
                px_.lastScalar[i] = unset;
                if constexpr (Limited) {
                    if (inside && frame_.limits != nullptr)
                        limits_.set(*frame_.limits,
                                    static_cast<std::size_t>(y0_ + y) * static_cast<std::size_t>(frame_.width) +
                                        static_cast<std::size_t>(x0_ + x),
                                    i);
                }
                const double dx = x0_ + x - frame_.centre.x, dy = y0_ + y - frame_.centre.y;
                px_.rayLength[i] =
                    frame_.orthographic
                        ? 1.0f
                        : static_cast<float>(std::sqrt(1 + frame_.pixel * frame_.pixel * (dx * dx + dy * dy)));
            }
        if constexpr (looksAtPeaks || look == Look::Lit || look == Look::Lamps) rays_ = inverseRayLengths(px_);
    }

    bool finished() const {
        if constexpr (colors || Kind == TileKind::Depth) {
            real most(0.0f);
            for (std::size_t i = 0; i < tilePixels; i += laneCount()) most = max(most, loadAligned(px_.t + i));
            return largest(most) < leastTransmittance;
        } else if constexpr (Kind == TileKind::Absorption) {
            real least(-1e30f);
            for (std::size_t i = 0; i < tilePixels; i += laneCount()) least = max(least, -loadAligned(px_.t + i));
            return largest(least) < -absorbed;
        } else {
            return false;
        }
    }

    HWY_INLINE void drawCell(std::size_t j) {
        const int x1 = batch_.end[j][0], y1 = batch_.end[j][1];
        const int xBegin = batch_.begin[j][0] / columnWidth * columnWidth, yFirst = batch_.begin[j][1],
                  yGrid = yFirst / rows * rows;
        // blocks on the grid are loaded faster; beside it a cell may take fewer
        const int yBegin = (y1 - yFirst + rows - 1) / rows == (y1 - yGrid + rows - 1) / rows ? yGrid : yFirst;
        if (xBegin >= x1 || yBegin >= y1) return;
        const FaceOrder& order = faceOrders[batch_.frontMask[j]];
        std::size_t first = 0, last = 0;
        if constexpr (looksAtPeaks) {
            first = peakLooks_.first[j];
            last = peakLooks_.last[j];
        } else if constexpr (integrates) {
            findPieces<Peaks>(*frame_.transfer, batch_, j, first, last);
        }
        if constexpr (look != Look::General) setLook<look, ScaleInvariant>(frame_.look, batch_, j, look_);
        const CellBlocks blocks{j, &order, xBegin, yBegin, x1, y1, first, last};
        if constexpr (looksAtPeaks && look == Look::Silhouettes) {
            if (peakLooks_.peak[j] != nullptr && look_.gradient > 0) {
                if (!peakLooks_.veiled[j])
                    return peakLooks_.narrow(j) ? drawBlocks<CellShows::NarrowPeak>(blocks)
                                                : drawBlocks<CellShows::WidePeak>(blocks);
                if constexpr (ScaleInvariant) return drawBlocks<CellShows::VeiledPeak>(blocks);
            }
        }
        drawBlocks<CellShows::Anything>(blocks);
    }

    template <CellShows shows>
    HWY_INLINE void drawBlocks(const CellBlocks& cell) {
        for (int x = cell.x0; x < cell.x1; x += columnWidth) {
            const real dx = laneX_ + real((batch_.offsetX[cell.j] + static_cast<float>(x)) + batch_.restX[cell.j]);
            for (int y = cell.y0; y < cell.y1; y += rows) {
                const real dy = laneY_ + real((batch_.offsetY[cell.j] + static_cast<float>(y)) + batch_.restY[cell.j]);
                real in, out;
                if (HWY_UNLIKELY(batch_.steep.is[cell.j] != 0.0f))
                    SteepRays(batch_, cell.j, x, y).interval(in, out);
                else
                    cellInterval(batch_, cell.j, *cell.order, dx, dy, in, out);
                drawBlock<shows>(cell.j, placeInTile(x, y), x, y, dx, dy, in, out, cell.first, cell.last);
            }
        }
    }

    template <CellShows shows>
    HWY_INLINE void drawBlock(std::size_t j, std::size_t at, int x, int y, real dx, real dy, real in, real out,
                              std::size_t first, std::size_t last) {
        if constexpr (Limited) {
            if (frame_.limits != nullptr) limit(j, at, in, out);
        }
        if constexpr (cutLayers) {
            if (layered_) {
                const real end = rhoOfNearness(j, loadAt(limits_.layerEnd + at)), layerOut = max(out, end);
                if (!none(in > layerOut))
                    drawSegments<shows>({j, at, x, y, dx, dy, in, layerOut, real(0.0f), true}, first, last);
                in = min(in, end);
            }
        }
        drawSegments<shows>({j, at, x, y, dx, dy, in, out, real(0.0f), false}, first, last);
    }

    /// The block's rays from `in` to `out`; its ray lengths are set here.
    template <CellShows shows>
    HWY_INLINE void drawSegments(Block block, std::size_t first, std::size_t last) {
        const std::size_t j = block.j, at = block.at;
        const real dx = block.dx, dy = block.dy;
        real &in = block.in, &out = block.out;
        const cell_real scale{look == Look::General ? batch_.scale[j] : look_.lengthScale};
        const real rayLength = loadAt(px_.rayLength + at);
        const bool steep = batch_.steep.is[j] != 0.0f;
        Segments segments;
        segments.live = in > out;
        if (HWY_UNLIKELY(steep))
            SteepRays(batch_, j, block.x, block.y).cut(in, out, scale.value, rayLength, frame_.orthographic, segments);
        mask& live = segments.live;
        const real t = loadAt(px_.t + at);
        if constexpr (colors || Kind == TileKind::Depth)
            live = both(live, t > real(frame_.earlyTermination ? leastTransmittance : -1.0f));
        if constexpr (Kind == TileKind::Absorption)
            live = both(live, t < real(frame_.earlyTermination ? absorbed : 1e29f));
        if (none(live)) return;
        result_.fragments += count(live);
        in = keep(live, in);
        out = keep(live, out);

        const cell_real scalar{batch_.scalar[j]}, perX{batch_.scalarPerX[j]}, perY{batch_.scalarPerY[j]},
            perRho{batch_.scalarPerRho[j]}, low{batch_.scalarLow[j]}, high{batch_.scalarHigh[j]};
        block.rayLength = rayLength;
        real across(0.0f);
        if (!frame_.orthographic) across = perX * dx + perY * dy;
        if (HWY_UNLIKELY(steep)) {
            segments.length = keep(live, segments.length);
            segments.back = select(live, segments.back, segments.front);
        } else if (HWY_UNLIKELY(frame_.orthographic)) {
            segments.front = scalarOrthographic(scalar, perX, perY, perRho, dx, dy, in, low, high);
            segments.back = scalarOrthographic(scalar, perX, perY, perRho, dx, dy, out, low, high);
            segments.length = segmentLengthOrthographic(scale, in, out);
        } else {
            const real towardsIn = real(1.0f) + in, towardsOut = real(1.0f) + out;
            const real inverse = reciprocal(towardsIn * towardsOut);
            const real ratioIn = inverse * towardsOut, ratioOut = inverse * towardsIn;
            segments.front = scalarOfRatio(scalar, across, perRho, in, ratioIn, low, high);
            segments.back = scalarOfRatio(scalar, across, perRho, out, ratioOut, low, high);
            segments.length = segmentLengthOfRatios(scale, in, out, ratioIn, ratioOut, rayLength);
        }
        if constexpr (colors || Kind == TileKind::Depth) checkOrder(j, at, live, in, out, segments);

        if constexpr (Kind == TileKind::Composite) {
            ColorSink sink{loadAt(px_.r + at), loadAt(px_.g + at), loadAt(px_.b + at), t};
            if constexpr (look == Look::General)
                integrate(first, last, segments, sink);
            else
                integrateLooked<shows>(block, scalarFall(across, perRho), first, last, segments, sink);
            storeAt(sink.r, px_.r + at);
            storeAt(sink.g, px_.g + at);
            storeAt(sink.b, px_.b + at);
            storeAt(sink.t, px_.t + at);
        } else if constexpr (Kind == TileKind::Absorption) {
            if constexpr (Limited) {
                drawDepth(block, t, first, last, segments);
            } else if constexpr (look == Look::Silhouettes) {
                BlockLook pixels;
                pixels.fall = scalarFall(across, perRho);
                pixels.rayLength = rayLength;
                storeAt(enhancedDepth<ScaleInvariant>(*frame_.transfer, look_, pixels, first, last, segments, t),
                        px_.t + at);
            } else {
                DepthSink sink{t};
                integrate(first, last, segments, sink);
                storeAt(sink.depth, px_.t + at);
            }
        } else if constexpr (Kind == TileKind::Additive) {
            drawAdditive(block, t, first, last, segments);
        } else if constexpr (Kind == TileKind::Depth) {
            drawFirstShown(block, t, first, last, segments);
        } else if constexpr (Kind == TileKind::Mip) {
            storeAt(select(live, max(t, max(segments.front, segments.back)), t), px_.t + at);
        } else if constexpr (Kind == TileKind::Minimum) {
            storeAt(select(live, min(t, min(segments.front, segments.back)), t), px_.t + at);
        } else if constexpr (Kind == TileKind::Average) {
            const real mean = real(0.5f) * (segments.front + segments.back);
            storeAt(loadAt(px_.r + at) + mean * segments.length, px_.r + at);
            storeAt(t + segments.length, px_.t + at);
        } else {
            drawShaded(block, t, first, last, segments);
        }
    }

    template <class Sink>
    HWY_INLINE void integrate(std::size_t first, std::size_t last, const Segments& segments, Sink& sink) const {
        addAlong<ScaleInvariant>(*frame_.transfer, first, last, segments, sink);
    }

    template <CellShows shows>
    HWY_INLINE void integrateLooked(const Block& block, real fall, std::size_t first, std::size_t last,
                                    const Segments& segments, ColorSink& sink) const {
        BlockLook pixels;
        pixels.fall = fall;
        pixels.rayLength = block.rayLength;
        pixels.inverse = loadAt(px_.inverseLength + block.at);
        if constexpr (look != Look::Silhouettes) {
            const vec3 direction = perDepth(block.x, block.y);
            const real sideways(frame_.orthographic ? 0.0f : 1.0f);
            pixels.x = sideways * direction.x;
            pixels.y = sideways * direction.y;
        }
        if constexpr (look == Look::Lamps) {
            if (frame_.look.places) pixels.place = middlePlace(block);
        }
        LookedSegments<look, ScaleInvariant, Peaks, shows>{frame_, peakLooks_, look_, pixels, segments}.add(first, last,
                                                                                                            sink);
    }

    HWY_INLINE void drawShaded(const Block& block, real t, std::size_t first, std::size_t last,
                               const Segments& segments) {
        const std::size_t at = block.at;
        std::conditional_t<Limited, ScaledSegmentSink, SegmentSink> sink;
        sink.begin();
        if constexpr (Limited)
            classified(block, first, last, segments, loadAt(limits_.scale + block.at)).gather(sink);
        else if (ScaleInvariant && frame_.shading->silhouette)
            classified(block, first, last, segments, real(1.0f)).integrate(real(1.0f), sink);
        else
            integrate(first, last, segments, sink);
        const ShadedSegment shaded = shade(block, sink, segments);
        if constexpr (Kind == TileKind::FirstHit) {
            const mask hit = both(segments.live, shaded.opacity > real(0.0f));
            storeAt(select(hit, shaded.r, loadAt(px_.r + at)), px_.r + at);
            storeAt(select(hit, shaded.g, loadAt(px_.g + at)), px_.g + at);
            storeAt(select(hit, shaded.b, loadAt(px_.b + at)), px_.b + at);
            storeAt(select(hit, real(0.0f), t), px_.t + at);
        } else {
            const real ta = keep(segments.live, t * shaded.opacity);
            storeAt(loadAt(px_.r + at) + shaded.r * ta, px_.r + at);
            storeAt(loadAt(px_.g + at) + shaded.g * ta, px_.g + at);
            storeAt(loadAt(px_.b + at) + shaded.b * ta, px_.b + at);
            storeAt(t - ta, px_.t + at);
        }
    }

    HWY_INLINE ShadedSegment shade(const Block& block, const SegmentSink& sink, const Segments& segments) {
        vec3 towards(real(0.0f), real(0.0f), real(1.0f));
        if (!frame_.orthographic) towards = reciprocal(block.rayLength) * perDepth(block.x, block.y);
        const auto middles = [&]() HWY_ATTR {
            return segmentMiddles(block.dx, block.dy, block.in, block.out, frame_.orthographic);
        };
        const auto place = [&]() HWY_ATTR { return middlePlace(block); };
        ShadedSegment shaded = shadeAs(block, sink, segments, towards, middles, place);
        if (HWY_UNLIKELY(frame_.shading->depthColor.has_value()))
            colorByDepth(frame_, distanceBeyond(block.x, block.y, middleBeyond(block), block.rayLength), shaded);
        return shaded;
    }

    template <class Middles, class Place>
    HWY_INLINE ShadedSegment shadeAs(const Block& block, const SegmentSink& sink, const Segments& segments,
                                     vec3 towards, const Middles& middles, const Place& place) {
        const std::size_t j = block.j;
        const real fall = cellFall(batch_, block.j, block.dx, block.dy, frame_.orthographic);
        if constexpr (Limited) {
            const vec3 normal(loadAt(limits_.normal[0] + block.at), loadAt(limits_.normal[1] + block.at),
                              loadAt(limits_.normal[2] + block.at));
            const vec3* cut = block.inCutLayer ? &normal : nullptr;
            return frame_.scaleInvariant
                       ? shadeSegment<true>(frame_, batch_, j, sink, segments, fall, towards, middles, place, cut)
                       : shadeSegment<false>(frame_, batch_, j, sink, segments, fall, towards, middles, place, cut);
        } else {
            return shadeSegment<ScaleInvariant>(frame_, batch_, j, sink, segments, fall, towards, middles, place);
        }
    }

    /// How much deeper than TileFrame::depthReference rays are at rho, scene lengths: from nearness, which holds it
    /// however far the eye is.
    HWY_INLINE real depthBeyond(std::size_t j, real rho) const {
        const real nearness = real(batch_.nearness[j]) + real(batch_.nearnessPerRho[j]) * rho;
        if (frame_.orthographic) return -nearness;
        return real(-frame_.depthReference) * nearness * reciprocal(real(1.0f) + nearness);
    }
    HWY_INLINE real middleBeyond(const Block& block) const {
        return real(0.5f) * (depthBeyond(block.j, block.in) + depthBeyond(block.j, block.out));
    }

    /// The distance along rays at a depth that is `beyond` the reference's, less the reference's own depth.
    HWY_INLINE real distanceBeyond(int x, int y, real beyond, real rayLength) const {
        if (frame_.orthographic) return beyond;
        const vec3 ray = perDepth(x, y);
        const real square = ray.x * ray.x + ray.y * ray.y;
        return beyond * rayLength + real(frame_.depthReference) * square * reciprocal(real(1.0f) + rayLength);
    }

    /// The segments' middles from the point on the view's axis at TileFrame::depthReference: (right, down, forward),
    /// scene lengths.
    HWY_INLINE vec3 middlePlace(const Block& block) const {
        const real beyond = middleBeyond(block);
        const vec3 ray = perDepth(block.x, block.y);
        if (frame_.orthographic) return {ray.x, ray.y, beyond};
        const real depth = real(frame_.depthReference) + beyond;
        return {depth * ray.x, depth * ray.y, beyond};
    }

    /// The rays' directions with a depth of 1 (orthographic: the rays' places), (right, down, forward).
    HWY_INLINE vec3 perDepth(int x, int y) const {
        const real pixel(frame_.pixel);
        return {pixel * (laneX_ + real(x0_ + x - frame_.centre.x)), pixel * (laneY_ + real(y0_ + y - frame_.centre.y)),
                real(1.0f)};
    }

    HWY_INLINE real rhoOfNearness(std::size_t j, real nearness) const {
        return (nearness - real(batch_.nearness[j])) * real(1.0f / batch_.nearnessPerRho[j]);
    }

    /// Cuts the interval by the pixels' limits.
    HWY_INLINE void limit(std::size_t j, std::size_t at, real& in, real& out) const {
        out = max(out, rhoOfNearness(j, loadAt(limits_.farthest + at)));
        in = min(in, rhoOfNearness(j, loadAt(limits_.nearest + at)));
    }

    HWY_INLINE ClassifiedSegments classified(const Block& block, std::size_t first, std::size_t last,
                                             const Segments& segments, real scale) const {
        return {frame_, batch_, block, first, last, segments, scale};
    }

    /// Absorption with all that changes depth.
    HWY_INLINE void drawDepth(const Block& block, real t, std::size_t first, std::size_t last,
                              const Segments& segments) {
        const std::size_t at = block.at;
        const auto shown = classified(block, first, last, segments, loadAt(limits_.scale + block.at));
        if (!frame_.shading->needsGradient() && !frame_.contributions.perCell) {
            ScaledDepthSink sink{{t}, shown.scale};
            shown.integrate(shown.scale, sink);
            storeAt(sink.depth, px_.t + at);
            return;
        }
        ScaledSegmentSink sink;
        sink.begin();
        shown.gather(sink);
        const ShadedSegment shaded = shade(block, sink, segments);
        storeAt(t + keep(segments.live, shaded.depth), px_.t + at);
    }

    /// Light of the segment, silhouettes and all: mean colour times depth, hidden by nothing.
    HWY_INLINE void drawAdditive(const Block& block, real t, std::size_t first, std::size_t last,
                                 const Segments& segments) {
        const std::size_t at = block.at;
        const EmissionSink sink = classified(block, first, last, segments, loadAt(limits_.scale + block.at)).emission();
        real r = sink.r, g = sink.g, b = sink.b, depth = sink.smoothDepth + sink.otherDepth;
        if (frame_.shading->needsGradient()) {
            SegmentSink whole;
            whole.r = r;
            whole.g = g;
            whole.b = b;
            whole.opacity = depth;  // what the colour is to be divided by
            whole.smoothDepth = sink.smoothDepth;
            whole.otherDepth = sink.otherDepth;
            const ShadedSegment shaded = shade(block, whole, segments);
            depth = shaded.depth;
            r = shaded.r * depth;
            g = shaded.g * depth;
            b = shaded.b * depth;
        }
        storeAt(loadAt(px_.r + at) + keep(segments.live, r), px_.r + at);
        storeAt(loadAt(px_.g + at) + keep(segments.live, g), px_.g + at);
        storeAt(loadAt(px_.b + at) + keep(segments.live, b), px_.b + at);
        storeAt(t + keep(segments.live, depth), px_.t + at);
    }

    /// Distance along the ray (scene lengths, beyond TileFrame::depthReference) to what is first seen.
    HWY_INLINE void drawFirstShown(const Block& block, real t, std::size_t first, std::size_t last,
                                   const Segments& segments) {
        const std::size_t at = block.at;
        const FirstShown shown = firstShown(*frame_.transfer, first, last, segments);
        if (none(shown.shown)) return;
        const real begin = distanceBeyond(block.x, block.y, depthBeyond(block.j, block.in), block.rayLength);
        const real step = segments.back - segments.front;
        const real share = select(abs(step) > real(0.0f), (shown.scalar - segments.front) / step, real(0.0f));
        const real distance = begin + clamp(share, real(0.0f), real(1.0f)) * segments.length;
        storeAt(select(shown.shown, distance, loadAt(px_.r + at)), px_.r + at);
        storeAt(select(shown.shown, real(0.0f), t), px_.t + at);
    }

    /// Cells along a ray do not overlap, so in the right order each segment begins where the last one ended, or behind
    /// it. One that lies out of order begins nearer than that by at least its own length. An eighth of that length and
    /// the rounding of nearness (the batch's tolerance: 1e-6 of the mesh and what the cell's own numbers carry) are
    /// allowed for: slivers and faces seen edge-on round by more than they are long, and do not show.
    HWY_INLINE void checkOrder(std::size_t j, std::size_t at, mask live, real in, real out, Segments& segments) {
        const real last = loadAt(px_.last + at);
        const real perRho(batch_.nearnessPerRho[j]);
        const real inner = in - real(0.125f) * (in - out);
        const mask early = real(batch_.nearnessChecked[j]) + perRho * inner > last;
        if constexpr (Peaks) {
            // one number for both cells of a face, so that an isosurface there is crossed exactly once
            const real before = loadAt(px_.lastScalar + at);
            const real gap = abs(real(batch_.nearness[j]) + perRho * in - last);
            const real slack = real(batch_.nearness[j] - batch_.nearnessChecked[j]) * real(4.0f);
            const mask joined = both(live, both(gap < slack, abs(before - segments.front) < real(scalarRounding)));
            segments.front = select(joined, before, segments.front);
            storeAt(select(live, segments.back, before), px_.lastScalar + at);
        }
        const real end = real(batch_.nearness[j]) + perRho * out;
        storeAt(select(live, select(early, real(doubtful), end), last), px_.last + at);
    }

    const TileFrame& frame_;
    const int x0_, y0_;
    TileResult& result_;
    real laneX_, laneY_;
    bool layered_ = false;  // cuts have layers that show
    CellBatch batch_;
    CellLook look_;
    PeakLooks peakLooks_;
    TileRays rays_;
    TileBuffers px_;
    struct NoLimits {};
    std::conditional_t<Limited, LimitBuffers<tilePixels>, NoLimits> limits_;
};

template <TileKind Kind, bool ScaleInvariant, bool Peaks, bool Limited = false, Look look = Look::General>
void drawTileAs(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                TileResult& result) {
    TileDrawing<Kind, ScaleInvariant, Peaks, Limited, look> drawing(frame, x0, y0, result);
    drawing.draw(entries);
    drawing.resolve(image);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
