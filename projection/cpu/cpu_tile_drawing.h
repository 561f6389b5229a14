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
#include <projection/cpu/cpu_clipped_segment.h>
#include <projection/cpu/cpu_segment.h>
#include <projection/cpu/cpu_shading.h>
#include <projection/cpu/cpu_steep_cell.h>
#include <projection/cpu/cpu_tile.h>
#include <projection/cpu/cpu_tile_buffers.h>
#include <projection/cpu/cpu_variant.h>

#if defined(TETRALUX_CPU_TILE_DRAWING_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_TILE_DRAWING_H
#undef TETRALUX_CPU_TILE_DRAWING_H
#else
#define TETRALUX_CPU_TILE_DRAWING_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// `Clipped`: within frame.limits and with frame.classification; then ScaleInvariant is false and frame.scaleInvariant
/// counts, and Isosurfaces is true.
/// `variant`: how Composite is shaded, and Absorption with silhouettes; General: not at all.
template <TileKind Kind, bool ScaleInvariant, bool Isosurfaces, bool Clipped, ShadingVariant variant>
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
            if constexpr (preparesIsosurfaces) prepareIsosurfaces(frame_, batch_, cells, rays_, preparedIsosurfaces_);
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
    static constexpr bool usesNormals = variant == ShadingVariant::Lit || variant == ShadingVariant::LocalLights ||
                                        Kind == TileKind::Shaded || Kind == TileKind::FirstHit ||
                                        Kind == TileKind::Additive || (Clipped && Kind == TileKind::Absorption);
    static constexpr GradientParts gradients = usesNormals                              ? GradientParts::All
                                               : variant == ShadingVariant::Silhouettes ? GradientParts::Magnitude
                                                                                        : GradientParts::None;
    /// Light falls on the layers of cuts by their own normals, so segments are divided at the end of one.
    static constexpr bool cutLayers =
        Clipped && (Kind == TileKind::Shaded || Kind == TileKind::FirstHit || Kind == TileKind::Additive);
    static constexpr bool preparesIsosurfaces =
        variant != ShadingVariant::General && Isosurfaces && Kind == TileKind::Composite;
    static constexpr int rows = static_cast<int>(laneCount()) / columnWidth;

    void clear() {
        if constexpr (Clipped) limits_.clear();
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
                if constexpr (Clipped) {
                    if (inside && frame_.limits != nullptr)
                        limits_.set(*frame_.limits,
                                    static_cast<std::size_t>(y0_ + y) * static_cast<std::size_t>(frame_.width) +
                                        static_cast<std::size_t>(x0_ + x),
                                    i);
                }
                const double row = y0_ + y - frame_.centre.y, dy = frame_.rowStretch * row,
                             dx = x0_ + x - frame_.centre.x + frame_.rowLean * row;
                px_.rayLength[i] =
                    frame_.orthographic
                        ? 1.0f
                        : static_cast<float>(std::sqrt(1 + frame_.pixel * frame_.pixel * (dx * dx + dy * dy)));
            }
        if constexpr (preparesIsosurfaces || variant == ShadingVariant::Lit || variant == ShadingVariant::LocalLights)
            rays_ = inverseRayLengths(px_);
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
        if constexpr (preparesIsosurfaces) {
            first = preparedIsosurfaces_.first[j];
            last = preparedIsosurfaces_.last[j];
        } else if constexpr (integrates) {
            findPieces<Isosurfaces>(*frame_.transfer, batch_, j, first, last);
        }
        if constexpr (variant != ShadingVariant::General)
            setVariant<variant, ScaleInvariant>(frame_.variant, batch_, j, variant_);
        const CellBlocks blocks{j, &order, xBegin, yBegin, x1, y1, first, last};
        if constexpr (preparesIsosurfaces && variant == ShadingVariant::Silhouettes) {
            if (preparedIsosurfaces_.isosurface[j] != nullptr && variant_.gradient > 0) {
                if (!preparedIsosurfaces_.inMedium[j])
                    return preparedIsosurfaces_.narrow(j) ? drawBlocks<CellShows::NarrowIsosurface>(blocks)
                                                          : drawBlocks<CellShows::WideIsosurface>(blocks);
                if constexpr (ScaleInvariant) return drawBlocks<CellShows::IsosurfaceInMedium>(blocks);
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
        if constexpr (Clipped) {
            if (frame_.limits != nullptr) limit(j, at, in, out);
        }
        if constexpr (cutLayers) {
            if (layered_) {
                const real end = inverseDepthOfRay(j, loadAt(limits_.layerEnd + at)), layerOut = max(out, end);
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
        const cell_real scale{variant == ShadingVariant::General ? batch_.scale[j] : variant_.lengthScale};
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
            perInverseDepth{batch_.scalarPerInverseDepth[j]}, low{batch_.scalarLow[j]}, high{batch_.scalarHigh[j]};
        block.rayLength = rayLength;
        real across(0.0f);
        if (!frame_.orthographic) across = perX * dx + perY * dy;
        if (HWY_UNLIKELY(steep)) {
            segments.length = keep(live, segments.length);
            segments.back = select(live, segments.back, segments.front);
        } else if (HWY_UNLIKELY(frame_.orthographic)) {
            segments.front = scalarOrthographic(scalar, perX, perY, perInverseDepth, dx, dy, in, low, high);
            segments.back = scalarOrthographic(scalar, perX, perY, perInverseDepth, dx, dy, out, low, high);
            segments.length = segmentLengthOrthographic(scale, in, out);
        } else {
            const real towardsIn = real(1.0f) + in, towardsOut = real(1.0f) + out;
            const real inverse = reciprocal(towardsIn * towardsOut);
            const real ratioIn = inverse * towardsOut, ratioOut = inverse * towardsIn;
            segments.front = scalarOfRatio(scalar, across, perInverseDepth, in, ratioIn, low, high);
            segments.back = scalarOfRatio(scalar, across, perInverseDepth, out, ratioOut, low, high);
            segments.length = segmentLengthOfRatios(scale, in, out, ratioIn, ratioOut, rayLength);
        }
        if constexpr (colors || Kind == TileKind::Depth) checkOrder(j, at, live, in, out, segments);

        if constexpr (Kind == TileKind::Composite) {
            ColorAccumulator accumulator{loadAt(px_.r + at), loadAt(px_.g + at), loadAt(px_.b + at), t};
            if constexpr (variant == ShadingVariant::General)
                integrate(first, last, segments, accumulator);
            else
                integrateVariant<shows>(block, scalarFall(across, perInverseDepth), first, last, segments, accumulator);
            storeAt(accumulator.r, px_.r + at);
            storeAt(accumulator.g, px_.g + at);
            storeAt(accumulator.b, px_.b + at);
            storeAt(accumulator.t, px_.t + at);
        } else if constexpr (Kind == TileKind::Absorption) {
            if constexpr (Clipped) {
                drawDepth(block, t, first, last, segments);
            } else if constexpr (variant == ShadingVariant::Silhouettes) {
                BlockVariant pixels;
                pixels.fall = scalarFall(across, perInverseDepth);
                pixels.rayLength = rayLength;
                storeAt(enhancedDepth<ScaleInvariant>(*frame_.transfer, variant_, pixels, first, last, segments, t),
                        px_.t + at);
            } else {
                DepthAccumulator accumulator{t};
                integrate(first, last, segments, accumulator);
                storeAt(accumulator.depth, px_.t + at);
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

    template <class Accumulator>
    HWY_INLINE void integrate(std::size_t first, std::size_t last, const Segments& segments,
                              Accumulator& accumulator) const {
        addAlong<ScaleInvariant>(*frame_.transfer, first, last, segments, accumulator);
    }

    template <CellShows shows>
    HWY_INLINE void integrateVariant(const Block& block, real fall, std::size_t first, std::size_t last,
                                     const Segments& segments, ColorAccumulator& accumulator) const {
        BlockVariant pixels;
        pixels.fall = fall;
        pixels.rayLength = block.rayLength;
        pixels.inverse = loadAt(px_.inverseLength + block.at);
        if constexpr (variant != ShadingVariant::Silhouettes) {
            const vec3 direction = perDepth(block.x, block.y);
            const real sideways(frame_.orthographic ? 0.0f : 1.0f);
            pixels.x = sideways * direction.x;
            pixels.y = sideways * direction.y;
        }
        if constexpr (variant == ShadingVariant::LocalLights) {
            if (frame_.variant.places) pixels.place = middlePlace(block);
        }
        VariantSegments<variant, ScaleInvariant, Isosurfaces, shows>{frame_, preparedIsosurfaces_, variant_, pixels,
                                                                     segments}
            .add(first, last, accumulator);
    }

    HWY_INLINE void drawShaded(const Block& block, real t, std::size_t first, std::size_t last,
                               const Segments& segments) {
        const std::size_t at = block.at;
        std::conditional_t<Clipped, ScaledSegmentAccumulator, SegmentAccumulator> accumulator;
        accumulator.begin();
        if constexpr (Clipped)
            classified(block, first, last, segments, loadAt(limits_.scale + block.at)).gather(accumulator);
        else if (ScaleInvariant && frame_.shading->silhouette)
            classified(block, first, last, segments, real(1.0f)).integrate(real(1.0f), accumulator);
        else
            integrate(first, last, segments, accumulator);
        const ShadedSegment shaded = shade(block, accumulator, segments);
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

    HWY_INLINE ShadedSegment shade(const Block& block, const SegmentAccumulator& accumulator,
                                   const Segments& segments) {
        vec3 towards(real(0.0f), real(0.0f), real(1.0f));
        if (!frame_.orthographic) towards = reciprocal(block.rayLength) * perDepth(block.x, block.y);
        const auto middles = [&]() HWY_ATTR {
            return segmentMiddles(block.dx, block.dy, block.in, block.out, frame_.orthographic);
        };
        const auto place = [&]() HWY_ATTR { return middlePlace(block); };
        ShadedSegment shaded = shadeAs(block, accumulator, segments, towards, middles, place);
        if (HWY_UNLIKELY(frame_.shading->depthColor.has_value()))
            colorByDepth(frame_, distanceBeyond(block.x, block.y, middleBeyond(block), block.rayLength), shaded);
        return shaded;
    }

    template <class Middles, class Place>
    HWY_INLINE ShadedSegment shadeAs(const Block& block, const SegmentAccumulator& accumulator,
                                     const Segments& segments, vec3 towards, const Middles& middles,
                                     const Place& place) {
        const std::size_t j = block.j;
        const real fall = cellFall(batch_, block.j, block.dx, block.dy, frame_.orthographic);
        if constexpr (Clipped) {
            const vec3 normal(loadAt(limits_.normal[0] + block.at), loadAt(limits_.normal[1] + block.at),
                              loadAt(limits_.normal[2] + block.at));
            const vec3* cut = block.inCutLayer ? &normal : nullptr;
            return frame_.scaleInvariant ? shadeSegment<true>(frame_, batch_, j, accumulator, segments, fall, towards,
                                                              middles, place, cut)
                                         : shadeSegment<false>(frame_, batch_, j, accumulator, segments, fall, towards,
                                                               middles, place, cut);
        } else {
            return shadeSegment<ScaleInvariant>(frame_, batch_, j, accumulator, segments, fall, towards, middles,
                                                place);
        }
    }

    /// How much deeper than TileFrame::depthReference rays are at inverseDepth, scene lengths: from inverse depth,
    /// which holds it however far the eye is.
    HWY_INLINE real depthBeyond(std::size_t j, real inverseDepth) const {
        const real rayInverseDepth =
            real(batch_.rayInverseDepth[j]) + real(batch_.rayPerInverseDepth[j]) * inverseDepth;
        if (frame_.orthographic) return -rayInverseDepth;
        return real(-frame_.depthReference) * rayInverseDepth * reciprocal(real(1.0f) + rayInverseDepth);
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
        const real column = laneX_ + real(x0_ + x - frame_.centre.x), row = laneY_ + real(y0_ + y - frame_.centre.y);
        return {pixel * (column + real(frame_.rowLean) * row), pixel * (real(frame_.rowStretch) * row), real(1.0f)};
    }

    HWY_INLINE real inverseDepthOfRay(std::size_t j, real rayInverseDepth) const {
        return (rayInverseDepth - real(batch_.rayInverseDepth[j])) * real(1.0f / batch_.rayPerInverseDepth[j]);
    }

    /// Cuts the interval by the pixels' limits.
    HWY_INLINE void limit(std::size_t j, std::size_t at, real& in, real& out) const {
        out = max(out, inverseDepthOfRay(j, loadAt(limits_.farthest + at)));
        in = min(in, inverseDepthOfRay(j, loadAt(limits_.nearest + at)));
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
            ScaledDepthAccumulator accumulator{{t}, shown.scale};
            shown.integrate(shown.scale, accumulator);
            storeAt(accumulator.depth, px_.t + at);
            return;
        }
        ScaledSegmentAccumulator accumulator;
        accumulator.begin();
        shown.gather(accumulator);
        const ShadedSegment shaded = shade(block, accumulator, segments);
        storeAt(t + keep(segments.live, shaded.depth), px_.t + at);
    }

    /// Light of the segment, silhouettes and all: mean colour times depth, hidden by nothing.
    HWY_INLINE void drawAdditive(const Block& block, real t, std::size_t first, std::size_t last,
                                 const Segments& segments) {
        const std::size_t at = block.at;
        const EmissionAccumulator accumulator =
            classified(block, first, last, segments, loadAt(limits_.scale + block.at)).emission();
        real r = accumulator.r, g = accumulator.g, b = accumulator.b,
             depth = accumulator.smoothDepth + accumulator.otherDepth;
        if (frame_.shading->needsGradient()) {
            SegmentAccumulator whole;
            whole.r = r;
            whole.g = g;
            whole.b = b;
            whole.opacity = depth;  // what the colour is to be divided by
            whole.smoothDepth = accumulator.smoothDepth;
            whole.otherDepth = accumulator.otherDepth;
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
    /// the rounding of inverse depth (the batch's tolerance: 1e-6 of the mesh and what the cell's own numbers carry)
    /// are allowed for: slivers and faces seen edge-on round by more than they are long, and do not show.
    HWY_INLINE void checkOrder(std::size_t j, std::size_t at, mask live, real in, real out, Segments& segments) {
        const real last = loadAt(px_.last + at);
        const real perInverseDepth(batch_.rayPerInverseDepth[j]);
        const real inner = in - real(0.125f) * (in - out);
        const mask early = real(batch_.rayInverseDepthChecked[j]) + perInverseDepth * inner > last;
        if constexpr (Isosurfaces) {
            // one number for both cells of a face, so that an isosurface there is crossed exactly once
            const real before = loadAt(px_.lastScalar + at);
            const real gap = abs(real(batch_.rayInverseDepth[j]) + perInverseDepth * in - last);
            const real slack = real(batch_.rayInverseDepth[j] - batch_.rayInverseDepthChecked[j]) * real(4.0f);
            const mask joined = both(live, both(gap < slack, abs(before - segments.front) < real(scalarRounding)));
            segments.front = select(joined, before, segments.front);
            storeAt(select(live, segments.back, before), px_.lastScalar + at);
        }
        const real end = real(batch_.rayInverseDepth[j]) + perInverseDepth * out;
        storeAt(select(live, select(early, real(uncertain), end), last), px_.last + at);
    }

    const TileFrame& frame_;
    const int x0_, y0_;
    TileResult& result_;
    real laneX_, laneY_;
    bool layered_ = false;  // cuts have layers that show
    CellBatch batch_;
    CellVariant variant_;
    PreparedIsosurfaces preparedIsosurfaces_;
    TileRays rays_;
    TileBuffers px_;
    struct NoLimits {};
    std::conditional_t<Clipped, LimitBuffers<tilePixels>, NoLimits> limits_;
};

template <TileKind Kind, bool ScaleInvariant, bool Isosurfaces, bool Clipped = false,
          ShadingVariant variant = ShadingVariant::General>
void drawTileAs(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                TileResult& result) {
    TileDrawing<Kind, ScaleInvariant, Isosurfaces, Clipped, variant> drawing(frame, x0, y0, result);
    drawing.draw(entries);
    drawing.resolve(image);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
