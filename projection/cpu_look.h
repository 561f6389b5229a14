// SPDX-License-Identifier: Apache-2.0
/// \file
/// Silhouettes and light as most scenes ask for them: Kraus 2005, Equations 15 and 17, and Equation 19 with plain
/// lights (ShadingSettings::plain). The same numbers as shading/cell_shading.glsl, rearranged so that a block of pixels
/// finds only what changes from pixel to pixel. Included once per instruction set.
///
/// - 1/|n·d| of Equation 15 is |g|·|z_c|·|ray per depth|/|scalarFall|, where all but the last two belong to the cell.
/// - A segment's light is C·A + α·B, where A gathers ambient and diffuse and B specular light. A lobe about the
/// reflected
///   direction r = 2n(n·l) − l or about −l is looked at along v = −d, so that it is a product of the pixel's ray with
///   one of two directions that the cell knows.
#include <projection/cpu_segment.h>

#include <cmath>

#include <projection/cpu_special_cell.h>
#include <projection/cpu_tile.h>

#if defined(TETRALUX_CPU_LOOK_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_LOOK_H
#undef TETRALUX_CPU_LOOK_H
#else
#define TETRALUX_CPU_LOOK_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// What a look needs of one cell.
struct CellLook {
    float gradient;                          ///< |g|, scene scalars per scene length
    float steepness;                         ///< |g|·|z_c|
    float lightSide[QuickLook::mostLights];  ///< n·l
    /// −r, (right, down, forward): its product with the pixel's unit direction is r·v.
    float reflected[QuickLook::mostLights][3];
};

template <bool Lit>
HWY_INLINE void setLook(const QuickLook& look, const CellBatch& batch, std::size_t j, CellLook& cell) {
    cell.gradient = batch.gradient[j];
    cell.steepness = batch.gradient[j] * std::abs(batch.scale[j]);
    if constexpr (!Lit) return;
    const float n[3] = {batch.normal[0][j], batch.normal[1][j], batch.normal[2][j]};
    for (std::size_t i = 0; i < look.lights; ++i) {
        const auto& light = look.towards[i];
        const float side = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
        cell.lightSide[i] = side;
        for (std::size_t axis = 0; axis < 3; ++axis) cell.reflected[i][axis] = light[axis] - 2 * side * n[axis];
    }
}

/// What a look needs of a block's pixels.
struct BlockLook {
    real fall;           ///< scalarFall: its sign is that of s_f − s_b, which is that of v·n
    real rayLength;      ///< per unit depth
    real inverse, x, y;  ///< unit direction of a ray: inverse·(x, y, 1), (right, down, forward)
};

/// For a ≥ 0. Whole exponents by squaring.
HWY_INLINE real lobeOf(const QuickLook& look, real cosine) {
    if (none(cosine > real(look.leastCosine))) return real(0.0f);
    const real base = max(cosine, real(0.0f));
    if (HWY_UNLIKELY(look.wholeExponent == 0))
        return exp(real(look.exponent) * real(hn::Log(FloatTag(), max(base, real(1e-30f)).v)));
    real power(1.0f), square = base;
    for (unsigned rest = look.wholeExponent;;) {
        if (rest & 1u) power = power * square;
        if ((rest >>= 1) == 0) return power;
        square = square * square;
    }
}

template <bool Orthographic>
HWY_INLINE real cosineTo(const float (&direction)[3], const BlockLook& block) {
    if constexpr (Orthographic) return real(direction[2]);
    return block.inverse * (real(direction[0]) * block.x + (real(direction[1]) * block.y + real(direction[2])));
}

/// A and B of the segment's light.
struct LightShares {
    real color, white;
};

template <bool Orthographic>
HWY_INLINE LightShares lightShares(const QuickLook& look, const CellLook& cell, const BlockLook& block, mask live,
                                   real opacity) {
    LightShares shares{real(look.ambient), real(0.0f)};
    const real zero(0.0f), through = look.transmission ? real(1.0f) - opacity : zero;
    for (std::size_t i = 0; i < look.lights; ++i) {
        const real facing = block.fall * real(cell.lightSide[i]), amount(std::abs(cell.lightSide[i]));
        const mask reflects = both(live, facing > zero), transmits = both(live, facing < zero);
        if (!none(reflects)) {
            shares.color += keep(reflects, amount);
            shares.white =
                shares.white + keep(reflects, lobeOf(look, cosineTo<Orthographic>(cell.reflected[i], block)));
        }
        if (look.transmission && !none(transmits)) {
            const real weight = keep(transmits, through);
            shares.color += weight * amount;
            shares.white += weight * lobeOf(look, cosineTo<Orthographic>(look.towards[i], block));
        }
    }
    return shares;
}

/// exp(−depth), 0 ≤ depth ≤ 80: 2ⁿ·2ᶠ with a polynomial for |f| ≤ 1/2. Exactly 1 at 0, relative error 2e-7·max(1,
/// depth).
HWY_INLINE real fadeOf(real depth) {
    const real power = depth * real(-1.44269504f), whole = hn::Round(power.v), f = power - whole;
    real p = real(0.00132647227) * f + real(0.00967151299);
    p = p * f + real(0.0555073358);
    p = p * f + real(0.240222424);
    p = p * f + real(0.693147004);
    p = p * f + real(1.0f);
    const auto exponent = hn::ShiftLeft<23>(hn::ConvertTo(IntTag(), whole.v));
    return hn::BitCast(FloatTag(), hn::Add(hn::BitCast(IntTag(), p.v), exponent));
}

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
template <bool Lit, bool Orthographic, bool ScaleInvariant, bool Peaks>
struct LookedSegments {
    const TileFrame& frame;
    const CellLook& cell;
    const BlockLook& block;
    const Segments& segments;

    HWY_INLINE bool silhouettes() const { return (!Lit || frame.look.silhouettes) && cell.gradient > 0; }

    HWY_INLINE void add(std::size_t first, std::size_t last, ColorSink& sink) const {
        const CpuTransfer& transfer = *frame.transfer;
        if (first == last && (!transfer.pieces()[first].visible || addThin(transfer.pieces()[first], sink))) return;
        if constexpr (Peaks) {
            if (const TransferPeak* peak = onlyPeak(transfer, first, last)) return addOnlyPeak(*peak, sink);
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
        const real slope(piece.extinctionSlope);
        const real extinction = max(real(piece.extinction) + slope * middle, real(0.0f));
        const real depth = path * extinction, halfStep = path * slope * half;
        if (HWY_UNLIKELY(!none(either(depth > pieceDepthLimit(), abs(halfStep) > pieceSlopeLimit())))) return false;
        real opacity = pieceOpacity(depth), skew = half * pieceSkew(depth, halfStep);
        if (silhouettes()) {
            const real thin = max(opacity, real(1e-37f));
            opacity = anyOpacity(ScaleInvariant ? real(cell.gradient) * segments.length * extinction
                                                : depth * silhouetteFactor(cell, block));
            skew = skew * (opacity * reciprocal(thin));
        }
        const real weighted = middle * opacity + skew;
        if constexpr (Lit)
            addLit(piece, opacity, weighted, sink);
        else
            sink.add(piece, opacity, weighted);
        return true;
    }

    HWY_INLINE void addLit(const TransferPiece& piece, real opacity, real weighted, ColorSink& sink) const {
        const LightShares light = lightShares<Orthographic>(frame.look, cell, block, segments.live, opacity);
        const real ta = sink.t * opacity, white = ta * light.white, color = ta * light.color,
                   tq = sink.t * weighted * light.color;
        sink.r += real(piece.color[0]) * color + (real(piece.colorSlope[0]) * tq + white);
        sink.g += real(piece.color[1]) * color + (real(piece.colorSlope[1]) * tq + white);
        sink.b += real(piece.color[2]) * color + (real(piece.colorSlope[2]) * tq + white);
        sink.t = sink.t - ta;
    }

    HWY_INLINE void addOnlyPeak(const TransferPeak& peak, ColorSink& sink) const {
        const mask hits = crossed(peak, segments);
        if (Lit && none(hits)) return;
        real opacity(peak.opacity);
        if (silhouettes()) {
            const real depth = real(peak.depth) * silhouetteFactor(cell, block);
            opacity = real(1.0f) - fadeOf(min(depth, real(80.0f)));
        }
        const real ta = keep(hits, sink.t * opacity);
        real color = ta, white(0.0f);
        if constexpr (Lit) {
            const LightShares light = lightShares<Orthographic>(frame.look, cell, block, hits, opacity);
            color = ta * light.color;
            white = ta * light.white;
        }
        sink.r += real(peak.color[0]) * color + white;
        sink.g += real(peak.color[1]) * color + white;
        sink.b += real(peak.color[2]) * color + white;
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
                depth = whole.smoothDepth * reciprocal(max(abs(segments.back - segments.front), least)) *
                        (real(cell.gradient) * segments.length);
            if constexpr (Peaks || !ScaleInvariant) {
                const real other = ScaleInvariant ? whole.otherDepth : whole.smoothDepth + whole.otherDepth;
                depth += other * silhouetteFactor(cell, block);
            }
            const real thin = max(opacity, least);
            opacity = anyOpacity(depth);
            share = share * (opacity * reciprocal(thin));
        }
        const real ta = sink.t * opacity;
        real white(0.0f);
        if constexpr (Lit) {
            const LightShares light = lightShares<Orthographic>(frame.look, cell, block, segments.live, opacity);
            share = share * light.color;
            white = ta * light.white;
        }
        sink.r += whole.r * share + white;
        sink.g += whole.g * share + white;
        sink.b += whole.b * share + white;
        sink.t = sink.t - ta;
    }
};

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
