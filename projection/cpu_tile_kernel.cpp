// SPDX-License-Identifier: Apache-2.0
/// \file
/// Draws one tile: its cells front to back into accumulators that stay in the first cache.
///
/// A tile's pixels lie in columns four wide, row by row within a column, so that a vector of 4·n pixels covers n rows
/// of a column and may begin at any row: a cell of a few pixels takes fewer blocks than with blocks on a grid.
#include <projection/cpu_targets.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "projection/cpu_tile_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>

#include <projection/cpu_cell_batch.h>
#include <projection/cpu_segment.h>
#include <projection/cpu_shading.h>
#include <projection/cpu_tile.h>

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

constexpr int columnWidth = 4;
constexpr int columns = cpuTileSize / columnWidth;
constexpr int paddedRows = cpuTileSize + 4;  // a block may begin in the last row
constexpr std::size_t tilePixels = static_cast<std::size_t>(columns) * paddedRows * columnWidth;

/// Accumulators of a tile. What they hold depends on the kind:
///   Composite, Shaded: premultiplied colour r g b, transmittance t, nearness `last` at which the last segment ended,
///   and its scalar FirstHit: colour of the hit, t = 1 until then Absorption: depth in t      Mip: largest scalar in t
///   Average: Σ scalar·length in r, Σ length in t
struct TileBuffers {
    alignas(64) float r[tilePixels], g[tilePixels], b[tilePixels], t[tilePixels], last[tilePixels],
        lastScalar[tilePixels], rayLength[tilePixels];
};

/// Faces of a cell, those that bound rho from above first.
struct FaceOrder {
    int face[4], fronts;
};
constexpr std::array<FaceOrder, 16> makeFaceOrders() {
    std::array<FaceOrder, 16> orders{};
    for (unsigned fronts = 0; fronts < 16; ++fronts) {
        FaceOrder& order = orders[fronts];
        int backs = 4;
        for (unsigned k = 0; k < 4; ++k) {
            if (fronts >> k & 1u)
                order.face[order.fronts++] = static_cast<int>(k);
            else
                order.face[--backs] = static_cast<int>(k);
        }
    }
    return orders;
}
constexpr std::array<FaceOrder, 16> faceOrders = makeFaceOrders();

constexpr float unset = -1e30f;      // no scalar yet
constexpr float nothingYet = 3e38f;  // nearness before the first segment
constexpr float doubtful = -3e38f;   // every later segment is nearer: once out of order, a pixel stays so
constexpr float absorbed = 13.8f;    // −ln(leastTransmittance)

template <TileKind Kind, bool Orthographic, bool ScaleInvariant, bool Peaks>
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
        clear();
    }

    void draw(std::span<const TileEntry> entries) {
        constexpr std::size_t ahead = 3 * CellBatch::capacity;
        std::size_t sinceCheck = 0;
        for (std::size_t i = 0; i < entries.size(); i += CellBatch::capacity) {
            for (std::size_t k = i + ahead; k < std::min(entries.size(), i + ahead + CellBatch::capacity); ++k)
                __builtin_prefetch(&frame_.cells[entries[k].cell]);
            const std::size_t cells = setUpBatch < Orthographic,
                              Kind == TileKind::Shaded ||
                                  Kind == TileKind::FirstHit > (frame_, x0_, y0_, entries.subspan(i), batch_);
            result_.cellsSetUp += cells;
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

    void resolve(Image& image) const;

private:
    static constexpr bool colors =
        Kind == TileKind::Composite || Kind == TileKind::Shaded || Kind == TileKind::FirstHit;
    static constexpr bool integrates = colors || Kind == TileKind::Absorption;
    static constexpr int rows = static_cast<int>(laneCount()) / columnWidth;

    static std::size_t indexOf(int x, int y) {
        return static_cast<std::size_t>(((x / columnWidth) * paddedRows + y) * columnWidth + x % columnWidth);
    }

    void clear() {
        for (int x = 0; x < cpuTileSize; ++x)
            for (int y = 0; y < paddedRows; ++y) {
                const std::size_t i = indexOf(x, y);
                const bool inside = y < cpuTileSize && x0_ + x < frame_.width && y0_ + y < frame_.height;
                px_.r[i] = px_.g[i] = px_.b[i] = 0;
                if constexpr (colors)
                    px_.t[i] = inside ? 1.0f : 0.0f;
                else if constexpr (Kind == TileKind::Absorption)
                    px_.t[i] = inside ? 0.0f : 1e30f;
                else
                    px_.t[i] = Kind == TileKind::Mip ? unset : 0.0f;
                px_.last[i] = nothingYet;
                px_.lastScalar[i] = unset;
                const double dx = x0_ + x - frame_.centre.x, dy = y0_ + y - frame_.centre.y;
                px_.rayLength[i] =
                    Orthographic ? 1.0f
                                 : static_cast<float>(std::sqrt(1 + frame_.pixel * frame_.pixel * (dx * dx + dy * dy)));
            }
    }

    bool finished() const {
        if constexpr (colors) {
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

    /// Entering and leaving nearness ratio of the block's rays; the cell's front faces stand first in `face`.
    HWY_INLINE void interval(std::size_t j, const int* face, int fronts, real dx, real dy, real& in, real& out) const {
        auto rho = [&](int k) HWY_ATTR {
            const auto& plane = batch_.plane[face[k]];
            return planeRho(cell_real{plane[0][j]}, cell_real{plane[1][j]}, cell_real{plane[2][j]}, dx, dy);
        };
        in = real(batch_.rhoNear[j]);
        out = real(batch_.rhoFar[j]);
        const real r0 = rho(0), r1 = rho(1), r2 = rho(2), r3 = rho(3);
        switch (fronts) {
            case 1:
                in = min(in, r0);
                out = max(max(out, r1), max(r2, r3));
                return;
            case 2:
                in = min(min(in, r0), r1);
                out = max(max(out, r2), r3);
                return;
            case 3:
                in = min(min(in, r0), min(r1, r2));
                out = max(out, r3);
                return;
            case 0:
                out = max(max(out, r0), max(r1, max(r2, r3)));
                return;
            default:
                in = real(-1e30f);  // seen from nowhere outside: a flat cell
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
        const int* face = order.face;
        const int fronts = order.fronts;
        std::size_t first = 0, last = 0;
        if constexpr (integrates) {
            const CpuTransfer& transfer = *frame_.transfer;
            if constexpr (Peaks) {  // a neighbour's end of a segment may lie beyond by rounding
                first = transfer.pieceFromAbove(batch_.scalarLow[j] - scalarRounding);
                last = transfer.pieceFromAbove(batch_.scalarHigh[j] + scalarRounding);
            } else {
                first = transfer.pieceFromAbove(batch_.scalarLow[j]);
                last = std::max(first, transfer.pieceFromBelow(batch_.scalarHigh[j]));
            }
        }
        for (int x = xBegin; x < x1; x += columnWidth) {
            const real dx = laneX_ + real(batch_.offsetX[j] + static_cast<float>(x));
            for (int y = yBegin; y < y1; y += rows) {
                const real dy = laneY_ + real(batch_.offsetY[j] + static_cast<float>(y));
                real in, out;
                interval(j, face, fronts, dx, dy, in, out);
                drawBlock(j, indexOf(x, y), x, y, dx, dy, in, out, first, last);
            }
        }
    }

    HWY_INLINE void drawBlock(std::size_t j, std::size_t at, int x, int y, real dx, real dy, real in, real out,
                              std::size_t first, std::size_t last) {
        mask live = in > out;
        const real t = loadAt(px_.t + at);
        if constexpr (colors) live = both(live, t > real(frame_.earlyTermination ? leastTransmittance : -1.0f));
        if constexpr (Kind == TileKind::Absorption)
            live = both(live, t < real(frame_.earlyTermination ? absorbed : 1e29f));
        if (none(live)) return;
        result_.fragments += count(live);
        in = keep(live, in);
        out = keep(live, out);

        Segments segments;
        segments.live = live;
        const cell_real scalar{batch_.scalar[j]}, perX{batch_.scalarPerX[j]}, perY{batch_.scalarPerY[j]},
            perRho{batch_.scalarPerRho[j]}, low{batch_.scalarLow[j]}, high{batch_.scalarHigh[j]},
            scale{batch_.scale[j]};
        const real rayLength = loadAt(px_.rayLength + at);
        if constexpr (Orthographic) {
            segments.front = scalarOrthographic(scalar, perX, perY, perRho, dx, dy, in, low, high);
            segments.back = scalarOrthographic(scalar, perX, perY, perRho, dx, dy, out, low, high);
            segments.length = segmentLengthOrthographic(scale, in, out);
        } else {
            const real towardsIn = real(1.0f) + in, towardsOut = real(1.0f) + out;
            const real inverse = reciprocal(towardsIn * towardsOut);
            const real ratioIn = inverse * towardsOut, ratioOut = inverse * towardsIn;
            const real across = perX * dx + perY * dy;
            segments.front = scalarOfRatio(scalar, across, perRho, in, ratioIn, low, high);
            segments.back = scalarOfRatio(scalar, across, perRho, out, ratioOut, low, high);
            segments.length = segmentLengthOfRatios(scale, in, out, ratioIn, ratioOut, rayLength);
        }
        if constexpr (colors) checkOrder(j, at, live, in, out, segments);

        if constexpr (Kind == TileKind::Composite) {
            ColorSink sink{loadAt(px_.r + at), loadAt(px_.g + at), loadAt(px_.b + at), t};
            integrate(first, last, segments, sink);
            storeAt(sink.r, px_.r + at);
            storeAt(sink.g, px_.g + at);
            storeAt(sink.b, px_.b + at);
            storeAt(sink.t, px_.t + at);
        } else if constexpr (Kind == TileKind::Absorption) {
            DepthSink sink{t};
            integrate(first, last, segments, sink);
            storeAt(sink.depth, px_.t + at);
        } else if constexpr (Kind == TileKind::Mip) {
            storeAt(select(live, max(t, max(segments.front, segments.back)), t), px_.t + at);
        } else if constexpr (Kind == TileKind::Average) {
            const real mean = real(0.5f) * (segments.front + segments.back);
            storeAt(loadAt(px_.r + at) + mean * segments.length, px_.r + at);
            storeAt(t + segments.length, px_.t + at);
        } else {
            drawShaded(j, at, x, y, dx, dy, in, out, rayLength, t, first, last, segments);
        }
    }

    template <class Sink>
    HWY_INLINE void integrate(std::size_t first, std::size_t last, const Segments& segments, Sink& sink) const {
        const CpuTransfer& transfer = *frame_.transfer;
        if (first == last) {
            if (transfer.pieces()[first].visible)
                addWithinPiece<ScaleInvariant>(transfer.pieces()[first], segments, sink);
        } else {
            addAcrossPieces<ScaleInvariant>(transfer, first, last, segments, sink);
        }
    }

    HWY_INLINE void drawShaded(std::size_t j, std::size_t at, int x, int y, real dx, real dy, real in, real out,
                               real rayLength, real t, std::size_t first, std::size_t last, const Segments& segments) {
        SegmentSink sink;
        sink.r = sink.g = sink.b = sink.opacity = sink.smoothDepth = sink.otherDepth = real(0.0f);
        sink.t = real(1.0f);
        integrate(first, last, segments, sink);
        vec3 towards(real(0.0f), real(0.0f), real(1.0f));
        if constexpr (!Orthographic) {
            const real inverse = reciprocal(rayLength), pixel(frame_.pixel);
            const real fromAxisX = laneX_ + real(x0_ + x - frame_.centre.x),
                       fromAxisY = laneY_ + real(y0_ + y - frame_.centre.y);
            towards = inverse * vec3(fromAxisX * pixel, fromAxisY * pixel, real(1.0f));
        }
        const auto middles = [&]() HWY_ATTR { return segmentMiddles(dx, dy, in, out); };
        const auto place = [&]() HWY_ATTR { return middlePlace(j, x, y, in, out, towards, rayLength); };
        real across(0.0f);
        if constexpr (!Orthographic) across = real(batch_.scalarPerX[j]) * dx + real(batch_.scalarPerY[j]) * dy;
        const real fall = scalarFall(across, cell_real{batch_.scalarPerRho[j]});
        const ShadedSegment shaded =
            shadeSegment<ScaleInvariant>(frame_, batch_, j, sink, segments, fall, towards, middles, place);
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

    HWY_INLINE static SegmentMiddles segmentMiddles(real dx, real dy, real in, real out) {
        const real half(0.5f);
        if constexpr (Orthographic) return {dx, dy, real(1.0f), half * (in + out)};
        const real ratioIn = reciprocal(real(1.0f) + in), ratioOut = reciprocal(real(1.0f) + out);
        return {dx, dy, half * (ratioIn + ratioOut), half * (ratioIn * in + ratioOut * out)};
    }

    /// The segments' middles from the eye: (right, down, forward), scene lengths.
    HWY_INLINE vec3 middlePlace(std::size_t j, int x, int y, real in, real out, vec3 towards, real rayLength) const {
        const real half(0.5f), scale(batch_.scale[j]);
        if constexpr (Orthographic) {
            const real pixel(frame_.pixel);
            return {pixel * (laneX_ + real(x0_ + x - frame_.centre.x)),
                    pixel * (laneY_ + real(y0_ + y - frame_.centre.y)), scale - abs(scale) * (half * (in + out))};
        } else {
            const real depth = scale * (half * (reciprocal(real(1.0f) + in) + reciprocal(real(1.0f) + out)));
            return (depth * rayLength) * towards;
        }
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

    static constexpr float scalarRounding = 2e-6f;

    const TileFrame& frame_;
    const int x0_, y0_;
    TileResult& result_;
    real laneX_, laneY_;
    CellBatch batch_;
    TileBuffers px_;
};

template <TileKind Kind, bool Orthographic, bool ScaleInvariant, bool Peaks>
void TileDrawing<Kind, Orthographic, ScaleInvariant, Peaks>::resolve(Image& image) const {
    const int width = std::min(cpuTileSize, frame_.width - x0_), height = std::min(cpuTileSize, frame_.height - y0_);
    const glm::vec3 constant(frame_.transfer->color());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = indexOf(x, y);
            glm::vec4& pixel = image.at(x0_ + x, y0_ + y);
            if constexpr (Kind == TileKind::FirstHit) {
                pixel = px_.t[i] == 0 ? glm::vec4(px_.r[i], px_.g[i], px_.b[i], 1.0f) : glm::vec4(0.0f);
            } else if constexpr (colors) {
                pixel = {px_.r[i], px_.g[i], px_.b[i], 1.0f - px_.t[i]};
            } else if constexpr (Kind == TileKind::Absorption) {
                const float opacity = -std::expm1(-px_.t[i]);
                pixel = {constant.x * opacity, constant.y * opacity, constant.z * opacity, opacity};
            } else {
                const bool met = Kind == TileKind::Mip ? px_.t[i] > unset : px_.t[i] > 0;
                const float s = Kind == TileKind::Mip ? px_.t[i] : px_.r[i] / px_.t[i];
                pixel = met ? glm::vec4(glm::vec3(frame_.transfer->colorAt(s)), 1.0f) : glm::vec4(0.0f);
            }
            if (colors && frame_.ordered && px_.last[i] == doubtful)
                result_.doubtfulPixels.push_back(static_cast<std::uint32_t>(y0_ + y) *
                                                     static_cast<std::uint32_t>(frame_.width) +
                                                 static_cast<std::uint32_t>(x0_ + x));
        }
}

template <TileKind Kind, bool Orthographic, bool ScaleInvariant, bool Peaks>
void drawTileAs(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                TileResult& result) {
    TileDrawing<Kind, Orthographic, ScaleInvariant, Peaks> drawing(frame, x0, y0, result);
    drawing.draw(entries);
    drawing.resolve(image);
}

template <bool Orthographic>
void drawTileIn(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                TileResult& result) {
    const bool peaks = !frame.transfer->peaks().empty();
    switch (frame.kind) {
        case TileKind::Mip:
            return drawTileAs<TileKind::Mip, Orthographic, false, false>(frame, x0, y0, entries, image, result);
        case TileKind::Average:
            return drawTileAs<TileKind::Average, Orthographic, false, false>(frame, x0, y0, entries, image, result);
        case TileKind::Absorption:
            if (frame.scaleInvariant)
                return drawTileAs<TileKind::Absorption, Orthographic, true, true>(frame, x0, y0, entries, image,
                                                                                  result);
            return drawTileAs<TileKind::Absorption, Orthographic, false, true>(frame, x0, y0, entries, image, result);
        case TileKind::Composite:
            if (frame.scaleInvariant)
                return peaks ? drawTileAs<TileKind::Composite, Orthographic, true, true>(frame, x0, y0, entries, image,
                                                                                         result)
                             : drawTileAs<TileKind::Composite, Orthographic, true, false>(frame, x0, y0, entries, image,
                                                                                          result);
            return peaks ? drawTileAs<TileKind::Composite, Orthographic, false, true>(frame, x0, y0, entries, image,
                                                                                      result)
                         : drawTileAs<TileKind::Composite, Orthographic, false, false>(frame, x0, y0, entries, image,
                                                                                       result);
        case TileKind::Shaded:
            if (frame.scaleInvariant)
                return drawTileAs<TileKind::Shaded, Orthographic, true, true>(frame, x0, y0, entries, image, result);
            return drawTileAs<TileKind::Shaded, Orthographic, false, true>(frame, x0, y0, entries, image, result);
        case TileKind::FirstHit:
            return drawTileAs<TileKind::FirstHit, Orthographic, false, true>(frame, x0, y0, entries, image, result);
    }
}

void drawTileHere(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                  TileResult& result) {
    if (frame.orthographic)
        drawTileIn<true>(frame, x0, y0, entries, image, result);
    else
        drawTileIn<false>(frame, x0, y0, entries, image, result);
}

const char* instructionSet() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetralux::projection {

HWY_EXPORT(drawTileHere);
HWY_EXPORT(instructionSet);

void drawTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
              TileResult& result) {
    HWY_DYNAMIC_DISPATCH(drawTileHere)(frame, x0, y0, entries, image, result);
}

const char* tileInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(instructionSet)();
}

}  // namespace tetralux::projection
#endif
