// SPDX-License-Identifier: Apache-2.0
/// \file
/// Silhouettes and light as most scenes ask for them: Kraus 2005, Equations 15 and 17, and Equation 19. The same
/// numbers as shading/cell_shading.glsl, rearranged so that a block of pixels finds only what changes from pixel to
/// pixel. Included once per instruction set.
///
/// - 1/|n·d| of Equation 15 is |g|·|z_c|·|ray per depth|/|scalarFall|, where all but the last two belong to the cell.
/// - A segment's light is C·A + α·B (cpu_local_lights.h).
#include <projection/cpu/cpu_segment.h>

#include <cmath>

#include <projection/cpu/cpu_isosurface_variant.h>
#include <projection/cpu/cpu_local_lights.h>
#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_VARIANT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_VARIANT_H
#undef TETRALUX_CPU_VARIANT_H
#else
#define TETRALUX_CPU_VARIANT_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// 1 − exp(−depth).
HWY_INLINE real anyOpacity(real depth) {
    const mask thick = depth > pieceDepthLimit();
    if (HWY_LIKELY(none(thick))) return pieceOpacity(depth);
    return select(thick, real(1.0f) - fadeOf(min(depth, real(80.0f))), pieceOpacity(min(depth, pieceDepthLimit())));
}

/// 1/|n·d|, finite. Gradients of any size: what is bounded is a share of theirs.
HWY_INLINE real silhouetteFactor(const CellVariant& cell, const BlockVariant& block) {
    return block.rayLength * reciprocal(max(abs(block.fall * real(cell.perSteepness)), real(1e-18f)));
}

/// What floats make n·d err by, and so, times 1/|n·d|, a silhouette's depth relative to itself; and how much of
/// opacity, or of light that adds up, it may change.
constexpr float cosineRounding = 2e-7f, largestSilhouetteError = 1e-4f;

/// Rays so nearly along level sets that the former may come to more than the latter.
HWY_INLINE mask grazes(const CellVariant& cell, const BlockVariant& block, mask live) {
    const real steepness = abs(block.fall * real(cell.perSteepness));
    return both(live, steepness * real(largestSilhouetteError / cosineRounding) < block.rayLength);
}

/// `after`: optical depth behind a segment, `before` it; no number where silhouettes make it err.
HWY_INLINE real vouchedDepth(const CellVariant& cell, const BlockVariant& block, mask live, real before, real after) {
    const mask grazing = grazes(cell, block, live);
    if (HWY_LIKELY(none(grazing))) return after;
    const real error = (after - before) * exp(-min(after, real(80.0f))) * silhouetteFactor(cell, block);
    return select(both(grazing, error * real(cosineRounding) > real(largestSilhouetteError)), unsure(), after);
}

/// The same of transmittance.
HWY_INLINE real vouchedTransmittance(const CellVariant& cell, const BlockVariant& block, mask live, real before,
                                     real after) {
    const mask grazing = grazes(cell, block, live);
    if (HWY_LIKELY(none(grazing))) return after;
    const real left = after / max(before, real(1e-30f)), absorbedShare = real(1.0f) - left;
    // x·exp(−x) of the depth x, within a factor of 1.6
    const real error = real(2.0f) * absorbedShare * max(left, real(0.05f)) * before * silhouetteFactor(cell, block);
    return select(both(grazing, error * real(cosineRounding) > real(largestSilhouetteError)), unsure(), after);
}

/// Optical depth alone, with silhouettes: isosurfaces by 1/|n·d|, what lies between over paths that hold it already.
struct EnhancedDepthAccumulator {
    static constexpr bool depthOnly = true;
    const CellVariant& cell;
    const BlockVariant& block;
    real depth;

    HWY_INLINE void addIsosurface(const TransferIsosurface& isosurface, mask crossed) {
        const real factor = cell.gradient > 0 ? silhouetteFactor(cell, block) : real(1.0f);
        depth = depth + keep(crossed, real(isosurface.depth) * factor);
    }
    HWY_INLINE void addDepth(real more) { depth = depth + more; }
};

/// The depth of one block's segments with silhouettes, behind `depth`: either integral is the standard one over another
/// path.
template <bool ScaleInvariant>
HWY_INLINE real enhancedDepth(const CpuTransfer& transfer, const CellVariant& cell, const BlockVariant& block,
                              std::size_t first, std::size_t last, const Segments& segments, real depth) {
    Segments longer = segments;
    if (!ScaleInvariant && cell.gradient > 0) longer.length = segments.length * silhouetteFactor(cell, block);
    EnhancedDepthAccumulator accumulator{cell, block, depth};
    addAlong<false>(transfer, first, last, longer, accumulator);
    if (ScaleInvariant || !(cell.gradient > 0)) return accumulator.depth;
    return vouchedDepth(cell, block, segments.live, depth, accumulator.depth);
}

/// Segments of one block with a variant, composited into `accumulator`.
template <ShadingVariant variant, bool ScaleInvariant, bool Isosurfaces, CellShows shows>
struct VariantSegments {
    static constexpr bool Lit = variant != ShadingVariant::Silhouettes;
    const TileFrame& frame;
    const PreparedIsosurfaces& isosurfaces;
    const CellVariant& cell;
    const BlockVariant& block;
    const Segments& segments;

    HWY_INLINE bool silhouettes() const {
        return shows != CellShows::Anything || ((!Lit || frame.variant.silhouettes) && cell.gradient > 0);
    }
    /// Without a gradient the scale-invariant integral shows nothing within a piece, one way or the other.
    HWY_INLINE bool silhouettesWithin() const {
        return (ScaleInvariant && (!Lit || frame.variant.silhouettes)) || silhouettes();
    }

    HWY_INLINE void add(std::size_t first, std::size_t last, ColorAccumulator& accumulator) const {
        const real before = accumulator.t;
        addSegments(first, last, accumulator);
        if (!ScaleInvariant && silhouettes())
            accumulator.t = vouchedTransmittance(cell, block, segments.live, before, accumulator.t);
    }

private:
    HWY_INLINE void addSegments(std::size_t first, std::size_t last, ColorAccumulator& accumulator) const {
        if constexpr (shows == CellShows::NarrowIsosurface || shows == CellShows::WideIsosurface)
            return addOnlyIsosurface(*isosurfaces.isosurface[cell.j], accumulator);
        const CpuTransfer& transfer = *frame.transfer;
        if constexpr (shows == CellShows::IsosurfaceInMedium) {
            if (HWY_LIKELY(addIsosurfaceInMedium(transfer.pieces()[first], transfer.pieces()[last],
                                                 *isosurfaces.isosurface[cell.j], accumulator)))
                return;
            return addAny(first, last, accumulator);
        }
        if (first == last && (!transfer.pieces()[first].visible || addThin(transfer.pieces()[first], accumulator)))
            return;
        if constexpr (Isosurfaces) {
            if (const TransferIsosurface* isosurface = isosurfaces.onlyIsosurface(cell.j))
                return addOnlyIsosurface(*isosurface, accumulator);
        }
        addAny(first, last, accumulator);
    }

private:
    HWY_INLINE void addAny(std::size_t first, std::size_t last, ColorAccumulator& accumulator) const {
        SegmentAccumulator whole;
        whole.begin();
        if (ScaleInvariant && silhouettes()) {
            Segments varied = segments;
            varied.length = keep(segments.live, variationOf(segments));
            addAlong<false>(*frame.transfer, first, last, varied, whole);
        } else {
            addAlong<ScaleInvariant>(*frame.transfer, first, last, segments, whole);
        }
        addWhole(whole, accumulator);
    }

    /// Segments within one piece, thin before silhouettes; false if some are not.
    HWY_INLINE bool addThin(const TransferPiece& piece, ColorAccumulator& accumulator) const {
        const real half = real(0.5f) * (segments.back - segments.front);
        const real middle = segments.front + half - real(piece.origin);
        const real path = ScaleInvariant ? abs(half + half) : segments.length;
        const real step = real(piece.extinctionSlope) * half;
        const real extinction = max(real(piece.extinction) + real(piece.extinctionSlope) * middle, real(0.0f));
        const real depth = path * extinction, halfStep = path * step;
        const mask steep = abs(halfStep) > pieceSlopeLimit();
        real opacity, skew;
        if (silhouettesWithin()) {
            // α′/α = D′/D·(α′/D′)/(α/D), where D′/D is that of the paths
            const real longer = ScaleInvariant ? segments.length : path * silhouetteFactor(cell, block);
            const real longerDepth = longer * extinction;
            real perExtinction = longer * pieceOpacityPerDepth(longerDepth);  // α′/extinction
            if (HWY_UNLIKELY(!none(either(max(depth, longerDepth) > pieceDepthLimit(), steep)))) {
                if (!none(either(depth > pieceDepthLimit(), steep))) return false;
                const real fade = fadeOf(min(longerDepth, real(80.0f)));
                perExtinction = select(longerDepth > pieceDepthLimit(),
                                       (real(1.0f) - fade) * reciprocal(max(extinction, real(1e-37f))), perExtinction);
            }
            opacity = extinction * perExtinction;
            skew = half * perExtinction * pieceLean(extinction, step, depth, halfStep);
        } else {
            if (HWY_UNLIKELY(!none(either(depth > pieceDepthLimit(), steep)))) return false;
            opacity = pieceOpacity(depth);
            skew = half * pieceSkew(depth, halfStep);
        }
        const real weighted = middle * opacity + skew;
        if constexpr (Lit)
            addLit(piece, opacity, weighted, accumulator);
        else
            accumulator.add(piece, opacity, weighted);
        return true;
    }

    HWY_INLINE void addLit(const TransferPiece& piece, real opacity, real weighted,
                           ColorAccumulator& accumulator) const {
        const auto light = lightShares<variant>(frame.variant, cell, block, segments.live, opacity);
        const real ta = accumulator.t * opacity, tq = accumulator.t * weighted;
        const auto channel = [&](std::size_t c, real& sum) HWY_ATTR {
            sum += (real(piece.color[c]) * ta + real(piece.colorSlope[c]) * tq) * light.color(c) + ta * light.white(c);
        };
        channel(0, accumulator.r);
        channel(1, accumulator.g);
        channel(2, accumulator.b);
        accumulator.t = accumulator.t - ta;
    }

    /// α′ of an isosurface.
    HWY_INLINE real enhancedOpacity(const TransferIsosurface& isosurface) const {
        if (shows == CellShows::NarrowIsosurface || (shows != CellShows::WideIsosurface && isosurfaces.narrow(cell.j)))
            return isosurfaces.opacity(cell.j, block.fall, block.inverse);
        return real(1.0f) - fadeOf(min(real(isosurface.depth) * silhouetteFactor(cell, block), real(80.0f)));
    }

    HWY_INLINE void addOnlyIsosurface(const TransferIsosurface& isosurface, ColorAccumulator& accumulator) const {
        const mask hits = crossed(isosurface, segments);
        if (Lit && none(hits)) return;
        const real opacity = silhouettes() ? enhancedOpacity(isosurface) : real(isosurface.opacity);
        const real ta = keep(hits, accumulator.t * opacity);
        if constexpr (Lit) {
            const auto light = lightShares<variant>(frame.variant, cell, block, hits, opacity);
            accumulator.r += ta * (real(isosurface.color[0]) * light.color(0) + light.white(0));
            accumulator.g += ta * (real(isosurface.color[1]) * light.color(1) + light.white(1));
            accumulator.b += ta * (real(isosurface.color[2]) * light.color(2) + light.white(2));
        } else {
            accumulator.r += real(isosurface.color[0]) * ta;
            accumulator.g += real(isosurface.color[1]) * ta;
            accumulator.b += real(isosurface.color[2]) * ta;
        }
        accumulator.t = accumulator.t - ta;
    }

    /// What a segment has of the piece below an isosurface, or of the one above.
    struct Side {
        real middle, half, step, depth, halfStep, opacity, weighted;

        HWY_INLINE Side(const TransferPiece& piece, real front, real back) {
            half = real(0.5f) * (back - front);
            middle = front + half - real(piece.origin);
            step = real(piece.extinctionSlope) * half;
            depth = abs(half + half) * max(real(piece.extinction) + real(piece.extinctionSlope) * middle, real(0.0f));
            halfStep = abs(half + half) * step;
        }
        HWY_INLINE void setFine() {
            opacity = finePieceOpacity(depth);
            weighted = middle * opacity + half * finePieceSkew(depth, halfStep);
        }
        HWY_INLINE void setThin() {
            opacity = pieceOpacity(depth);
            weighted = middle * opacity + half * pieceSkew(depth, halfStep);
        }
    };

    /// Segments that may cross an isosurface from one piece to the next, scale-invariant; false if some are deep.
    /// Either side is empty where they do not cross it, so that nobody needs to know which way the scalar goes but to
    /// tell what hides what.
    HWY_INLINE bool addIsosurfaceInMedium(const TransferPiece& a, const TransferPiece& b,
                                          const TransferIsosurface& isosurface, ColorAccumulator& accumulator) const {
        const real value(isosurface.value), one(1.0f), least(1e-37f);
        Side low(a, min(segments.front, value), min(segments.back, value)),
            high(b, max(segments.front, value), max(segments.back, value));
        const real depth =
            (low.depth + high.depth) * (segments.length * reciprocal(max(abs(segments.back - segments.front), least)));
        if (HWY_UNLIKELY(!none(both(segments.live, abs(segments.back - segments.front) < real(leastVariation)))))
            return false;  // along a level set
        const real deepest = max(low.depth, high.depth);
        // V errs by D³/16 there, 1.2e-7 at 1/80: enough for any colour
        const real fineLimit = a.fine && b.fine ? finePieceLimit() : real(0.0125f);
        if (HWY_LIKELY(none(deepest > fineLimit))) {
            low.setFine();
            high.setFine();
        } else {
            const mask steep = max(abs(low.halfStep), abs(high.halfStep)) > pieceSlopeLimit();
            if (HWY_UNLIKELY(!none(either(deepest > pieceDepthLimit(), steep)))) return false;
            low.setThin();
            high.setThin();
        }
        const mask below = segments.front < value, hits = crossed(isosurface, segments);
        // what the side in front lets through
        const real before = one - select(below, low.opacity, high.opacity);
        const real shown = keep(hits, before * real(isosurface.opacity)), behind = before - shown;
        const real lowWeight = select(below, one, behind), highWeight = select(below, behind, one);
        const real opacity = low.opacity * lowWeight + high.opacity * highWeight + shown;
        const real enhanced = keep(hits, enhancedOpacity(isosurface)), mediumOpacity = anyOpacity(depth);
        const real ta = accumulator.t * (mediumOpacity + enhanced * (one - mediumOpacity)),
                   share = ta * reciprocal(max(opacity, least));
        const real lowShare = share * lowWeight, highShare = share * highWeight, isosurfaceShare = share * shown;
        const real alphaLow = low.opacity * lowShare, leanLow = low.weighted * lowShare,
                   alphaHigh = high.opacity * highShare, leanHigh = high.weighted * highShare;
        const auto channel = [&](std::size_t c, real& sum) HWY_ATTR {
            sum += real(a.color[c]) * alphaLow + real(a.colorSlope[c]) * leanLow;
            sum += real(b.color[c]) * alphaHigh + real(b.colorSlope[c]) * leanHigh;
            sum += real(isosurface.color[c]) * isosurfaceShare;
        };
        channel(0, accumulator.r);
        channel(1, accumulator.g);
        channel(2, accumulator.b);
        accumulator.t = accumulator.t - ta;
        return true;
    }

    /// What was gathered along several pieces.
    HWY_INLINE void addWhole(const SegmentAccumulator& whole, ColorAccumulator& accumulator) const {
        real opacity = whole.opacity, share = accumulator.t;  // share: of C that is seen
        if (none(opacity > real(0.0f))) return;
        if (silhouettes()) {
            const real least(1e-37f);
            real depth(0.0f);
            if constexpr (ScaleInvariant)
                depth = whole.smoothDepth * reciprocal(variationOf(segments)) * segments.length;
            if constexpr (Isosurfaces || !ScaleInvariant) {
                const real other = ScaleInvariant ? whole.otherDepth : whole.smoothDepth + whole.otherDepth;
                depth += other * silhouetteFactor(cell, block);
            }
            const real thin = max(opacity, least);
            opacity = anyOpacity(depth);
            share = share * (opacity * reciprocal(thin));
        }
        const real ta = accumulator.t * opacity;
        if constexpr (Lit) {
            const auto light = lightShares<variant>(frame.variant, cell, block, segments.live, opacity);
            accumulator.r += whole.r * share * light.color(0) + ta * light.white(0);
            accumulator.g += whole.g * share * light.color(1) + ta * light.white(1);
            accumulator.b += whole.b * share * light.color(2) + ta * light.white(2);
        } else {
            accumulator.r += whole.r * share;
            accumulator.g += whole.g * share;
            accumulator.b += whole.b * share;
        }
        accumulator.t = accumulator.t - ta;
    }
};

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
