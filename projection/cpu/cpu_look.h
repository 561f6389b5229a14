// SPDX-License-Identifier: Apache-2.0
/// \file
/// Silhouettes and light as most scenes ask for them: Kraus 2005, Equations 15 and 17, and Equation 19. The same
/// numbers as shading/cell_shading.glsl, rearranged so that a block of pixels finds only what changes from pixel to
/// pixel. Included once per instruction set.
///
/// - 1/|n·d| of Equation 15 is |g|·|z_c|·|ray per depth|/|scalarFall|, where all but the last two belong to the cell.
/// - A segment's light is C·A + α·B (cpu_lamps.h).
#include <projection/cpu/cpu_segment.h>

#include <cmath>

#include <projection/cpu/cpu_lamps.h>
#include <projection/cpu/cpu_peak_look.h>
#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_LOOK_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_LOOK_H
#undef TETRALUX_CPU_LOOK_H
#else
#define TETRALUX_CPU_LOOK_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// 1 − exp(−depth).
HWY_INLINE real anyOpacity(real depth) {
    const mask thick = depth > pieceDepthLimit();
    if (HWY_LIKELY(none(thick))) return pieceOpacity(depth);
    return select(thick, real(1.0f) - fadeOf(min(depth, real(80.0f))), pieceOpacity(min(depth, pieceDepthLimit())));
}

/// 1/|n·d|, finite.
HWY_INLINE real silhouetteFactor(const CellLook& cell, const BlockLook& block) {
    return (real(cell.steepness) * block.rayLength) * reciprocal(max(abs(block.fall), real(1e-18f)));
}

/// Segments of one block with a look, composited into `sink`.
template <Look look, bool Orthographic, bool ScaleInvariant, bool Peaks, CellShows shows>
struct LookedSegments {
    static constexpr bool Lit = look != Look::Silhouettes;
    const TileFrame& frame;
    const PeakLooks& peaks;
    const CellLook& cell;
    const BlockLook& block;
    const Segments& segments;

    HWY_INLINE bool silhouettes() const {
        // without a gradient the scale-invariant integral shows nothing
        return shows == CellShows::NarrowPeak ||
               ((!Lit || frame.look.silhouettes) && (ScaleInvariant || cell.gradient > 0));
    }

    HWY_INLINE void add(std::size_t first, std::size_t last, ColorSink& sink) const {
        if constexpr (shows == CellShows::NarrowPeak) return addOnlyPeak(*peaks.peak[cell.j], sink);
        const CpuTransfer& transfer = *frame.transfer;
        if (first == last && (!transfer.pieces()[first].visible || addThin(transfer.pieces()[first], sink))) return;
        if constexpr (Peaks) {
            if (const TransferPeak* peak = peaks.peak[cell.j]) return addOnlyPeak(*peak, sink);
        }
        SegmentSink whole;
        whole.begin();
        if (first == last)
            addWithinPiece<ScaleInvariant>(transfer.pieces()[first], segments, whole);
        else
            addAcrossPieces<ScaleInvariant>(transfer, first, last, segments, whole);
        addWhole(whole, sink);
    }

private:
    /// Segments within one piece, thin before silhouettes; false if some are not.
    HWY_INLINE bool addThin(const TransferPiece& piece, ColorSink& sink) const {
        const real half = real(0.5f) * (segments.back - segments.front);
        const real middle = segments.front + half - real(piece.middle);
        const real path = ScaleInvariant ? abs(half + half) : segments.length;
        const real step = real(piece.extinctionSlope) * half;
        const real extinction = max(real(piece.extinction) + real(piece.extinctionSlope) * middle, real(0.0f));
        const real depth = path * extinction, halfStep = path * step;
        const mask steep = abs(halfStep) > pieceSlopeLimit();
        real opacity, skew;
        if (silhouettes()) {
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
            addLit(piece, opacity, weighted, sink);
        else
            sink.add(piece, opacity, weighted);
        return true;
    }

    HWY_INLINE void addLit(const TransferPiece& piece, real opacity, real weighted, ColorSink& sink) const {
        const auto light = lightShares<look, Orthographic>(frame.look, cell, block, segments.live, opacity);
        const real ta = sink.t * opacity, tq = sink.t * weighted;
        const auto channel = [&](std::size_t c, real& sum) HWY_ATTR {
            sum += (real(piece.color[c]) * ta + real(piece.colorSlope[c]) * tq) * light.color(c) + ta * light.white(c);
        };
        channel(0, sink.r);
        channel(1, sink.g);
        channel(2, sink.b);
        sink.t = sink.t - ta;
    }

    HWY_INLINE void addOnlyPeak(const TransferPeak& peak, ColorSink& sink) const {
        const mask hits = crossed(peak, segments);
        if (Lit && none(hits)) return;
        real opacity(peak.opacity);
        if (silhouettes()) {
            if (shows == CellShows::NarrowPeak || peaks.narrow(cell.j)) {
                opacity = peaks.opacity(cell.j, block.fall * block.inverse);
            } else {
                const real depth = real(peak.depth) * silhouetteFactor(cell, block);
                opacity = real(1.0f) - fadeOf(min(depth, real(80.0f)));
            }
        }
        const real ta = keep(hits, sink.t * opacity);
        if constexpr (Lit) {
            const auto light = lightShares<look, Orthographic>(frame.look, cell, block, hits, opacity);
            sink.r += ta * (real(peak.color[0]) * light.color(0) + light.white(0));
            sink.g += ta * (real(peak.color[1]) * light.color(1) + light.white(1));
            sink.b += ta * (real(peak.color[2]) * light.color(2) + light.white(2));
        } else {
            sink.r += real(peak.color[0]) * ta;
            sink.g += real(peak.color[1]) * ta;
            sink.b += real(peak.color[2]) * ta;
        }
        sink.t = sink.t - ta;
    }

    /// What was gathered along several pieces.
    HWY_INLINE void addWhole(const SegmentSink& whole, ColorSink& sink) const {
        real opacity = whole.opacity, share = sink.t;  // share: of C that is seen
        if (none(opacity > real(0.0f))) return;
        if (silhouettes()) {
            const real least(1e-37f);
            real depth(0.0f);
            if constexpr (ScaleInvariant)
                depth =
                    whole.smoothDepth * reciprocal(max(abs(segments.back - segments.front), least)) * segments.length;
            if constexpr (Peaks || !ScaleInvariant) {
                const real other = ScaleInvariant ? whole.otherDepth : whole.smoothDepth + whole.otherDepth;
                depth += other * silhouetteFactor(cell, block);
            }
            const real thin = max(opacity, least);
            opacity = anyOpacity(depth);
            share = share * (opacity * reciprocal(thin));
        }
        const real ta = sink.t * opacity;
        if constexpr (Lit) {
            const auto light = lightShares<look, Orthographic>(frame.look, cell, block, segments.live, opacity);
            sink.r += whole.r * share * light.color(0) + ta * light.white(0);
            sink.g += whole.g * share * light.color(1) + ta * light.white(1);
            sink.b += whole.b * share * light.color(2) + ta * light.white(2);
        } else {
            sink.r += whole.r * share;
            sink.g += whole.g * share;
            sink.b += whole.b * share;
        }
        sink.t = sink.t - ta;
    }
};

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
