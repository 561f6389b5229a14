// SPDX-License-Identifier: Apache-2.0
/// \file
/// What only the kernel with limits holds (drawClippedTile): pixel maps, other classifications, modes that hide
/// nothing. Included once per instruction set.
#include <projection/cpu/cpu_shading.h>

#include <projection/cpu/cpu_cell_rays.h>
#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_CLIPPED_SEGMENT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_CLIPPED_SEGMENT_H
#undef TETRALUX_CPU_CLIPPED_SEGMENT_H
#else
#define TETRALUX_CPU_CLIPPED_SEGMENT_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

constexpr float noLimit = 3e38f;

/// A tile's part of TileLimits, in the order of its accumulators.
template <std::size_t pixels>
struct LimitBuffers {
    alignas(64) float nearest[pixels], farthest[pixels], layerEnd[pixels], scale[pixels], normal[3][pixels];

    void clear() {
        std::fill_n(nearest, pixels, noLimit);
        std::fill_n(farthest, pixels, -noLimit);
        std::fill_n(layerEnd, pixels, noLimit);
        std::fill_n(scale, pixels, 1.0f);
        for (auto& axis : normal) std::fill_n(axis, pixels, 0.0f);
    }
    void set(const TileLimits& limits, std::size_t pixel, std::size_t at) {
        if (!limits.nearest.empty()) nearest[at] = limits.nearest[pixel];
        if (!limits.farthest.empty()) farthest[at] = limits.farthest[pixel];
        if (!limits.scale.empty()) scale[at] = limits.scale[pixel];
        if (limits.layerEnd.empty()) return;
        layerEnd[at] = limits.layerEnd[pixel];
        for (std::size_t axis = 0; axis < 3; ++axis) normal[axis][at] = limits.normal[pixel][axis];
    }
};

/// Opacity of an isosurface whose depth is multiplied.
HWY_INLINE real scaledIsosurfaceOpacity(const TransferIsosurface& isosurface, real scale) {
    const real depth = real(isosurface.depth) * scale;
    const real opacity = real(1.0f) - exp(-depth);
    return select(depth < pieceDepthLimit(), pieceOpacity(min(depth, pieceDepthLimit())), opacity);
}

/// SegmentAccumulator where extinction is scaled: paths are already, isosurfaces are here.
struct ScaledSegmentAccumulator : SegmentAccumulator {
    real scale;

    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        const real alpha = keep(crossed, scaledIsosurfaceOpacity(isosurface, scale)), ta = t * alpha;
        opacity += ta;
        r += real(isosurface.color[0]) * ta;
        g += real(isosurface.color[1]) * ta;
        b += real(isosurface.color[2]) * ta;
        t = t - ta;
        otherDepth = otherDepth + keep(crossed, real(isosurface.depth) * scale);
    }
    /// One colour stands for the segment: post- and pre-classification's sample, or the mean of what shows.
    HWY_INLINE void setMean(real meanR, real meanG, real meanB, real smooth, real other) {
        r = meanR;
        g = meanG;
        b = meanB;
        opacity = select(smooth + other > real(0.0f), real(1.0f), real(0.0f));
        smoothDepth = smooth;
        otherDepth = other;
    }
};

struct ScaledDepthAccumulator : DepthAccumulator {
    real scale;
    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        depth = depth + keep(crossed, real(isosurface.depth) * scale);
    }
};

/// ∫ c τ along one segment, nothing hidden, with smooth depth and the sum of isosurfaces' opacities.
struct EmissionAccumulator {
    static constexpr bool depthOnly = false, hides = false;
    real r, g, b, smoothDepth, otherDepth, scale;

    HWY_INLINE void add(const TransferPiece& piece, real depth, real weighted) {
        r += real(piece.color[0]) * depth + real(piece.colorSlope[0]) * weighted;
        g += real(piece.color[1]) * depth + real(piece.colorSlope[1]) * weighted;
        b += real(piece.color[2]) * depth + real(piece.colorSlope[2]) * weighted;
    }
    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        const real opacity = keep(crossed, scaledIsosurfaceOpacity(isosurface, scale));
        r += real(isosurface.color[0]) * opacity;
        g += real(isosurface.color[1]) * opacity;
        b += real(isosurface.color[2]) * opacity;
        otherDepth = otherDepth + opacity;
    }
    HWY_INLINE void addDepth(real depth) { smoothDepth = smoothDepth + depth; }
};

/// What ContributionWeights::perCell makes of one segment: the colours of its contributions, added up, and their
/// number.
struct CellContributions {
    real r, g, b, count;
};

/// ∫ c τ, ∫ τ, and the isosurfaces that are crossed.
struct ContributionAccumulator {
    static constexpr bool depthOnly = false, hides = false;
    real r, g, b, smoothDepth;
    CellContributions isosurfaces;

    HWY_INLINE ContributionAccumulator() {
        r = g = b = smoothDepth = isosurfaces.r = isosurfaces.g = isosurfaces.b = isosurfaces.count = real(0.0f);
    }
    HWY_INLINE void add(const TransferPiece& piece, real depth, real weighted) {
        r += real(piece.color[0]) * depth + real(piece.colorSlope[0]) * weighted;
        g += real(piece.color[1]) * depth + real(piece.colorSlope[1]) * weighted;
        b += real(piece.color[2]) * depth + real(piece.colorSlope[2]) * weighted;
    }
    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        isosurfaces.r += keep(crossed, real(isosurface.color[0]));
        isosurfaces.g += keep(crossed, real(isosurface.color[1]));
        isosurfaces.b += keep(crossed, real(isosurface.color[2]));
        isosurfaces.count += keep(crossed, real(1.0f));
    }
    HWY_INLINE void addDepth(real depth) { smoothDepth = smoothDepth + depth; }

    HWY_INLINE CellContributions contributions() const {
        const mask shows = smoothDepth > real(0.0f);
        const real perDepth = keep(shows, real(1.0f) / select(shows, smoothDepth, real(1.0f)));
        return {r * perDepth + isosurfaces.r, g * perDepth + isosurfaces.g, b * perDepth + isosurfaces.b,
                keep(shows, real(1.0f)) + isosurfaces.count};
    }
};

/// Extinction and colour at one scalar per pixel, from above at jumps.
struct Sample {
    real extinction, r, g, b;
};
HWY_INLINE Sample sampleAt(const CpuTransfer& transfer, std::size_t first, std::size_t last, real s) {
    Sample sample;
    sample.extinction = sample.r = sample.g = sample.b = real(0.0f);
    for (std::size_t k = first; k <= last; ++k) {
        const TransferPiece& piece = transfer.pieces()[k];
        mask within = s < real(piece.high);
        if (k > first) within = both(within, either(s > real(piece.low), s == real(piece.low)));
        if (k == last) within = k > first ? either(s > real(piece.low), s == real(piece.low)) : s == s;
        const real offset = s - real(piece.origin);
        sample.extinction += keep(within, real(piece.extinction) + real(piece.extinctionSlope) * offset);
        sample.r += keep(within, real(piece.color[0]) + real(piece.colorSlope[0]) * offset);
        sample.g += keep(within, real(piece.color[1]) + real(piece.colorSlope[1]) * offset);
        sample.b += keep(within, real(piece.color[2]) + real(piece.colorSlope[2]) * offset);
    }
    sample.extinction = max(sample.extinction, real(0.0f));
    return sample;
}

/// Post-classification's sample, or what the vertices carry for pre-classification, in the middles of the segments.
HWY_INLINE Sample segmentSample(const TileFrame& frame, const CellBatch& batch, std::size_t j,
                                const SegmentMiddles& middles, std::size_t first, std::size_t last,
                                const Segments& segments) {
    const shading::VertexLight& kept = *frame.vertexLight;
    if (kept.sampleAt < 0) return sampleAt(*frame.transfer, first, last, real(0.5f) * (segments.front + segments.back));
    real weights[4];
    middleCoordinates(batch, j, middles, weights);
    const float* values[4];
    for (std::size_t k = 0; k < 4; ++k) values[k] = kept.of(static_cast<std::uint32_t>(batch.corner[k][j]));
    const vec3 color = vectorAt(values, kept.sampleAt, weights);
    return {attributeAt(values, kept.sampleAt + 3, weights), color.x, color.y, color.z};
}

/// What segments show by classification, contributions and the pixels' factor of extinction (`scale`).
struct ClassifiedSegments {
    const TileFrame& frame;
    const CellBatch& batch;
    const Block& block;
    std::size_t first, last;  ///< pieces
    const Segments& segments;
    real scale;

    /// Path that extinction is per unit of.
    HWY_INLINE real path() const {
        if (!frame.scaleInvariant) return segments.length;
        // not quite 0 along a level set where silhouettes multiply it by as much as it lacks
        return frame.shading->silhouette && !frame.contributions.perCell ? variationOf(segments)
                                                                         : abs(segments.back - segments.front);
    }

    /// Either integral with scaled extinction is the standard one over another path.
    template <class Accumulator>
    HWY_INLINE void integrate(real factor, Accumulator& accumulator) const {
        Segments scaled = segments;
        scaled.length = keep(segments.live, factor * path());
        addAlong<false>(*frame.transfer, first, last, scaled, accumulator);
    }

    HWY_INLINE Sample sample() const {
        const auto middles = segmentMiddles(block.dx, block.dy, block.in, block.out, frame.orthographic);
        return segmentSample(frame, batch, block.j, middles, first, last, segments);
    }

    HWY_INLINE CellContributions contributions() const {
        if (frame.classification != Classification::Preintegrated) {
            const Sample taken = sample();
            const mask shows = both(segments.live, taken.extinction * path() > real(0.0f));
            return {keep(shows, taken.r), keep(shows, taken.g), keep(shows, taken.b), keep(shows, real(1.0f))};
        }
        ContributionAccumulator accumulator;
        integrate(real(1.0f), accumulator);
        return accumulator.contributions();
    }

    /// What hides what lies behind it, before silhouettes and light.
    HWY_INLINE void gather(ScaledSegmentAccumulator& accumulator) const {
        accumulator.scale = scale;
        if (HWY_UNLIKELY(frame.contributions.perCell)) {
            const CellContributions sum = contributions();
            const real each = real(1.0f) / max(sum.count, real(1.0f));
            return accumulator.setMean(each * sum.r, each * sum.g, each * sum.b, real(0.0f), sum.count * scale);
        }
        if (frame.classification == Classification::Preintegrated) return integrate(scale, accumulator);
        const Sample taken = sample();
        accumulator.setMean(taken.r, taken.g, taken.b, taken.extinction * (scale * path()), real(0.0f));
    }

    /// The same where nothing is hidden.
    HWY_INLINE EmissionAccumulator emission() const {
        EmissionAccumulator accumulator;
        accumulator.r = accumulator.g = accumulator.b = accumulator.smoothDepth = accumulator.otherDepth = real(0.0f);
        accumulator.scale = scale;
        if (HWY_UNLIKELY(frame.contributions.perCell)) {
            const CellContributions sum = contributions();
            accumulator.r = sum.r * scale;
            accumulator.g = sum.g * scale;
            accumulator.b = sum.b * scale;
            accumulator.otherDepth = sum.count * scale;
        } else if (frame.classification == Classification::Preintegrated) {
            integrate(scale, accumulator);
        } else {
            const Sample taken = sample();
            accumulator.smoothDepth = taken.extinction * (scale * path());
            accumulator.r = taken.r * accumulator.smoothDepth;
            accumulator.g = taken.g * accumulator.smoothDepth;
            accumulator.b = taken.b * accumulator.smoothDepth;
        }
        return accumulator;
    }
};

/// Where along the segments (scalars) something first shows; `shown` tells where anything does.
struct FirstShown {
    real scalar;
    mask shown;

    HWY_INLINE void meet(mask here, real at) {
        scalar = select(hn::AndNot(shown, here), at, scalar);
        shown = either(shown, here);
    }
};

HWY_INLINE void meetPiece(const TransferPiece& piece, const Segments& segments, mask lanes, FirstShown& first) {
    if (!piece.visible) return;
    const real low(piece.low), high(piece.high);
    const real begin = clamp(segments.front, low, high), end = clamp(segments.back, low, high);
    first.meet(both(lanes, abs(end - begin) > real(0.0f)), begin);
}

HWY_INLINE FirstShown firstShown(const CpuTransfer& transfer, std::size_t first, std::size_t last,
                                 const Segments& segments) {
    const auto& pieces = transfer.pieces();
    const auto& isosurfaces = transfer.isosurfaces();
    const mask rising = both(segments.back > segments.front, segments.live),
               falling = both(segments.back < segments.front, segments.live);
    auto meetIsosurface = [&](const TransferIsosurface& isosurface, mask lanes, FirstShown& shown) HWY_ATTR {
        shown.meet(both(lanes, crossed(isosurface, segments)), real(isosurface.value));
    };
    FirstShown result{segments.front, segments.front < segments.front};
    for (std::size_t k = first; k <= last && !none(rising); ++k) {
        meetPiece(pieces[k], segments, rising, result);
        if (k == last) break;
        for (std::uint32_t i = pieces[k].isosurfaceBegin; i < pieces[k].isosurfaceEnd; ++i)
            meetIsosurface(isosurfaces[i], rising, result);
    }
    for (std::size_t k = last + 1; k-- > first && !none(falling);) {
        meetPiece(pieces[k], segments, falling, result);
        if (k == first) break;
        for (std::uint32_t i = pieces[k - 1].isosurfaceEnd; i-- > pieces[k - 1].isosurfaceBegin;)
            meetIsosurface(isosurfaces[i], falling, result);
    }
    // constant along the ray: about the origin of a piece extinction is a sum of what is not negative, and 0 exactly
    const mask constant = both(segments.back == segments.front, segments.live);
    if (!none(constant)) {
        const Sample sample = sampleAt(transfer, first, last, segments.front);
        result.meet(both(constant, sample.extinction > real(0.0f)), segments.front);
    }
    return result;
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
