// SPDX-License-Identifier: Apache-2.0
/// \file
/// From a segment of every pixel of a block to colour: along the pieces of the transfer function, front to back.
/// Included once per instruction set.
///
/// A thin segment within one piece needs neither table nor exponential (cpu_piece.glsl). One that crosses nodes is cut
/// there, exactly, and walks through its pieces; a cell's pixels do so together, those along which the scalar rises
/// upwards and the others downwards.
#include <projection/cpu/cpu_simd.h>

#include <hwy/contrib/math/math-inl.h>

#include <projection/cpu/cpu_tile.h>
#include <projection/cpu/cpu_transfer.h>

#if defined(TETRALUX_CPU_SEGMENT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_SEGMENT_H
#undef TETRALUX_CPU_SEGMENT_H
#else
#define TETRALUX_CPU_SEGMENT_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

#undef TETRALUX_GLSL_FUNCTION
#define TETRALUX_GLSL_FUNCTION HWY_INLINE
#include <projection/cells/cell_interval.glsl>
HWY_INLINE real exp(real a) {
    return hn::Exp(FloatTag(), a.v);
}
#include <projection/cpu/cpu_piece.glsl>
#undef TETRALUX_GLSL_BOOL
#define TETRALUX_GLSL_BOOL mask
#define TETRALUX_LANES
#include <preint/value_from_above.glsl>
#undef TETRALUX_LANES

/// Premultiplied colour and transmittance, gathered front to back.
struct ColorAccumulator {
    static constexpr bool depthOnly = false, hides = true;
    real r, g, b, t;

    /// Adds t·(c₀·α + c₁·q) where the colour is c₀ + c₁·(s − middle) and q the α-weighted s − middle.
    HWY_INLINE void add(const TransferPiece& piece, real opacity, real weighted) {
        const real ta = t * opacity, tq = t * weighted;
        r += real(piece.color[0]) * ta + real(piece.colorSlope[0]) * tq;
        g += real(piece.color[1]) * ta + real(piece.colorSlope[1]) * tq;
        b += real(piece.color[2]) * ta + real(piece.colorSlope[2]) * tq;
        t = t - ta;
    }
    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        const real ta = keep(crossed, t * real(isosurface.opacity));
        r += real(isosurface.color[0]) * ta;
        g += real(isosurface.color[1]) * ta;
        b += real(isosurface.color[2]) * ta;
        t = t - ta;
    }
    HWY_INLINE void addDepth(real) {}
};

/// The same for one segment that silhouettes and light will change: its opacity (1 − t would lose thin ones) and
/// optical depths are wanted too.
struct SegmentAccumulator : ColorAccumulator {
    real opacity, smoothDepth, otherDepth;

    HWY_INLINE void begin() {
        r = g = b = opacity = smoothDepth = otherDepth = real(0.0f);
        t = real(1.0f);
    }
    HWY_INLINE void add(const TransferPiece& piece, real pieceOpacity, real weighted) {
        opacity += t * pieceOpacity;
        ColorAccumulator::add(piece, pieceOpacity, weighted);
    }
    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        opacity += keep(crossed, t * real(isosurface.opacity));
        ColorAccumulator::addIsosurface(isosurface, crossed);
        otherDepth = otherDepth + keep(crossed, real(isosurface.depth));
    }
    HWY_INLINE void addDepth(real depth) { smoothDepth = smoothDepth + depth; }
};

/// Optical depth alone.
struct DepthAccumulator {
    static constexpr bool depthOnly = true;
    real depth;

    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        depth = depth + keep(crossed, real(isosurface.depth));
    }
    HWY_INLINE void addDepth(real more) { depth = depth + more; }
};

/// Segments some of which are too deep for the polynomials.
template <class Accumulator>
HWY_NOINLINE void addDeepPiece(const TransferPiece& piece, real middle, real half, real depth, real halfStep,
                               Accumulator& accumulator) {
    const real most(1e30f), zero(0.0f), one(1.0f);
    const real thin = min(depth, pieceDepthLimit()), slope = clamp(halfStep, -pieceSlopeLimit(), pieceSlopeLimit());
    const mask deep = either(depth > pieceDepthLimit(), abs(halfStep) > pieceSlopeLimit());
    depth = min(depth, most);
    halfStep = clamp(halfStep, -most, most);
    const real fade = exp(-min(depth, real(80.0f))), perRoot = one / deepPieceRoot(halfStep);
    const real front = real(0.5f) * max(depth - halfStep, zero) * perRoot,
               back = real(0.5f) * max(depth + halfStep, zero) * perRoot;
    const mask rising = halfStep > zero;
    real gFront = zero, gBack = zero;
    if (!none(rising)) {
        gFront = scaledComplement(front);
        gBack = scaledComplement(back);
    }
    if (!none(both(deep, halfStep < real(1e-30f)))) {
        gFront = select(rising, gFront, dawsonIntegral(front));
        gBack = select(rising, gBack, dawsonIntegral(back));
    }
    const real opacity = select(deep, one - fade, pieceOpacity(thin));
    const real skew = select(deep, deepPieceSkew(gFront, gBack, perRoot, fade), pieceSkew(thin, slope));
    accumulator.add(piece, opacity, middle * opacity + half * skew);
}

/// Adds a segment within one piece: `middle` and `half` are its mean scalar less the piece's own middle and half its
/// scalar step, `path` its length or its variation of the scalar (0 where there is nothing to add).
template <bool Fine = false, class Accumulator>
HWY_INLINE void addPiece(const TransferPiece& piece, real middle, real half, real path, Accumulator& accumulator) {
    const real slope(piece.extinctionSlope);
    const real depth = max(path * (real(piece.extinction) + slope * middle), real(0.0f));
    accumulator.addDepth(depth);
    if constexpr (!Accumulator::depthOnly) {
        const real halfStep = path * slope * half;
        if constexpr (!Accumulator::hides) {
            accumulator.add(piece, depth, middle * depth + halfStep * half * real(1.0f / 3.0f));
        } else if (Fine && HWY_LIKELY(none(depth > finePieceLimit()))) {
            const real opacity = finePieceOpacity(depth);
            accumulator.add(piece, opacity, middle * opacity + half * finePieceSkew(depth, halfStep));
        } else {
            const mask deep = either(depth > pieceDepthLimit(), abs(halfStep) > pieceSlopeLimit());
            if (HWY_LIKELY(none(deep))) {
                const real opacity = pieceOpacity(depth);
                accumulator.add(piece, opacity, middle * opacity + half * pieceSkew(depth, halfStep));
            } else {
                addDeepPiece(piece, middle, half, depth, halfStep, accumulator);
            }
        }
    }
}

/// A segment of every pixel of a block. Where a pixel has none, `length` is 0 and both scalars are equal.
struct Segments {
    real front, back;  ///< scalars
    real length;       ///< scene lengths; for the scale-invariant integral with a variant times |g| (cpu_variant.h)
    mask live;
};

/// Scalar steps that paths of the scale-invariant integral have at least where silhouettes make them longer: the limit
/// of a ray along a level set (Kraus 2005, Equation 17).
constexpr float leastVariation = 1e-18f;

/// The scale-invariant path of segments that silhouettes will make longer.
HWY_INLINE real variationOf(const Segments& segments) {
    return max(abs(segments.back - segments.front), real(leastVariation));
}

template <bool ScaleInvariant, class Accumulator>
HWY_INLINE void addWithinPiece(const TransferPiece& piece, const Segments& segments, Accumulator& accumulator) {
    const real half = real(0.5f) * (segments.back - segments.front);
    const real middle = segments.front + half - real(piece.origin);
    addPiece(piece, middle, half, ScaleInvariant ? abs(half + half) : segments.length, accumulator);
}

/// The part within one of several pieces of the segments along which the scalar rises, or falls. `perScalar`: path per
/// unit of scalar.
template <bool Rises, bool ScaleInvariant, class Accumulator>
HWY_INLINE void addPart(const TransferPiece& piece, const Segments& segments, real perScalar,
                        Accumulator& accumulator) {
    if (!piece.visible) return;
    const real low(piece.low), high(piece.high), zero(0.0f);
    const real begin = Rises ? max(segments.front, low) : min(segments.front, high);
    const real end = Rises ? min(segments.back, high) : max(segments.back, low);
    const real step = Rises ? max(end - begin, zero) : min(end - begin, zero);
    const real half = real(0.5f) * step, length = Rises ? step : -step;
    real path = length;
    if constexpr (!ScaleInvariant) path = length * perScalar;
    const real middle = begin + half - real(piece.origin);
    if (piece.fine)
        addPiece<true>(piece, middle, half, path, accumulator);
    else if (!none(path > zero))
        addPiece(piece, middle, half, path, accumulator);
}

/// The isosurface between two pieces that show nothing else; nullptr: there is more to see, or less.
HWY_INLINE const TransferIsosurface* onlyIsosurface(const CpuTransfer& transfer, std::size_t first, std::size_t last) {
    const TransferPiece &a = transfer.pieces()[first], &b = transfer.pieces()[last];
    const bool only = last == first + 1 && !a.visible && !b.visible && a.isosurfaceEnd == a.isosurfaceBegin + 1;
    return only ? &transfer.isosurfaces()[a.isosurfaceBegin] : nullptr;
}

HWY_INLINE mask crossed(const TransferIsosurface& isosurface, const Segments& segments) {
    return both(segments.live, crossesValue(segments.front, segments.back, real(isosurface.value)));
}

/// Steps of the scalar that float tells: relative to it, and where it is 0, such that 1 over it is a float too.
constexpr float leastRelativeStep = 0x1p-22f, leastAbsoluteStep = 1e-34f;

/// More pieces than this and a block's own range of scalars is worth finding.
constexpr std::size_t fewPieces = 3;

/// Segments that cross nodes or isosurfaces: pieces first … last of the transfer function.
template <bool ScaleInvariant, class Accumulator>
HWY_INLINE void addAcrossPieces(const CpuTransfer& transfer, std::size_t first, std::size_t last,
                                const Segments& segments, Accumulator& accumulator) {
    const auto& pieces = transfer.pieces();
    const auto& isosurfaces = transfer.isosurfaces();
    if (const TransferIsosurface* isosurface = onlyIsosurface(transfer, first, last))
        return accumulator.addIsosurface(*isosurface, crossed(*isosurface, segments));
    // no step, or one too small to be divided by, becomes a step upwards that float just tells: the value from above
    Segments cut = segments;
    if constexpr (!ScaleInvariant) {
        const real leastStep = max(real(leastRelativeStep) * abs(segments.front), real(leastAbsoluteStep));
        cut.back = select(abs(segments.back - segments.front) < leastStep, segments.front + leastStep, segments.back);
    }
    const real step = cut.back - cut.front;
    const mask rising = both(step > real(0.0f), segments.live), falling = both(step < real(0.0f), segments.live);
    const real perScalar = ScaleInvariant ? real(1.0f) : segments.length / abs(step);
    if (last > first + fewPieces) {
        const real unmet(1e30f);
        first = std::max(first,
                         transfer.pieceFromAbove(-largest(select(segments.live, -min(cut.front, cut.back), -unmet))));
        last =
            std::min(last, transfer.pieceFromAbove(largest(select(segments.live, max(cut.front, cut.back), -unmet))));
    }
    if (!none(rising)) {
        for (std::size_t k = first; k <= last; ++k) {
            addPart<true, ScaleInvariant>(pieces[k], cut, perScalar, accumulator);
            if (k == last) break;
            for (std::uint32_t i = pieces[k].isosurfaceBegin; i < pieces[k].isosurfaceEnd; ++i) {
                accumulator.addIsosurface(isosurfaces[i], both(rising, crossed(isosurfaces[i], segments)));
            }
        }
    }
    if (!none(falling)) {
        for (std::size_t k = last + 1; k-- > first;) {
            addPart<false, ScaleInvariant>(pieces[k], cut, perScalar, accumulator);
            if (k == first) break;
            for (std::uint32_t i = pieces[k - 1].isosurfaceEnd; i-- > pieces[k - 1].isosurfaceBegin;) {
                accumulator.addIsosurface(isosurfaces[i], both(falling, crossed(isosurfaces[i], segments)));
            }
        }
    }
}

/// Segments along pieces first … last.
template <bool ScaleInvariant, class Accumulator>
HWY_INLINE void addAlong(const CpuTransfer& transfer, std::size_t first, std::size_t last, const Segments& segments,
                         Accumulator& accumulator) {
    if (first != last) return addAcrossPieces<ScaleInvariant>(transfer, first, last, segments, accumulator);
    if (transfer.pieces()[first].visible)
        addWithinPiece<ScaleInvariant>(transfer.pieces()[first], segments, accumulator);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
