// SPDX-License-Identifier: Apache-2.0
/// \file
/// Isosurfaces with silhouettes where they are all that a cell shows: α′ = 1 − (1 − α)^k (Kraus 2005, Equation 15) as a
/// polynomial over the cell's pixels. Included once per instruction set.
///
/// k = steepness/|z| with z = scalarFall/(ray per depth), and a cell's pixels see it from so nearly the same direction
/// that z = z₀(1 + ε) with a small ε. With D the depth of the isosurface and q = D·steepness/|z₀|,
///
///     α′ = 1 − exp(−q)·exp(qε/(1 + ε)),   exp(qε/(1 + ε)) = 1 + Σ_n εⁿ Σ_k (−1)^(n − k)·C(n − 1, k − 1)·q^k/k!:
///
/// no division and no exponential per pixel. With four terms the error is below 5e-8 for |ε| ≤ 1/20, whatever q.
#include <projection/cpu/cpu_cell_batch.h>
#include <projection/cpu/cpu_segment.h>
#include <projection/cpu/cpu_tile_buffers.h>

#include <algorithm>
#include <cmath>

#if defined(TETRALUX_CPU_ISOSURFACE_VARIANT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_ISOSURFACE_VARIANT_H
#undef TETRALUX_CPU_ISOSURFACE_VARIANT_H
#else
#define TETRALUX_CPU_ISOSURFACE_VARIANT_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

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

/// What a block of pixels need not ask about its cell, with silhouettes.
enum class CellShows {
    Anything,
    NarrowIsosurface,   ///< one isosurface and nothing else, and the polynomial holds
    WideIsosurface,     ///< the same where it does not
    IsosurfaceInMedium  ///< one isosurface and the pieces of the transfer function beside it, scale-invariant
};

/// Of the cells of one batch: what each shows, and the polynomials.
struct PreparedIsosurfaces {
    static constexpr std::size_t room = std::max(CellBatch::capacity, laneCount());
    static constexpr float mostSpread = 0.048f;  // and what products of spreads add

    std::size_t first[CellBatch::capacity],
        last[CellBatch::capacity];                              ///< pieces of the transfer function
    const TransferIsosurface* isosurface[CellBatch::capacity];  ///< the only one; nullptr: none, or more
    bool inMedium[CellBatch::capacity];                         ///< there is more to see than the isosurface
    /// The largest |ε|, z₀, and Σ power[i]·(z − z₀)^i. The polynomial does not hold where spread is not below
    /// mostSpread.
    alignas(64) float spread[room], centre[room], power[5][room];

    bool narrow(std::size_t j) const { return spread[j] < mostSpread; }

    const TransferIsosurface* onlyIsosurface(std::size_t j) const { return inMedium[j] ? nullptr : isosurface[j]; }

    /// Of pixels of cell j: scalarFall, and one over the ray per depth.
    HWY_INLINE real opacity(std::size_t j, real fall, real inverse) const {
        const real x = fall * inverse - real(centre[j]);
        real p = real(power[4][j]) * x + real(power[3][j]);
        for (std::size_t i = 3; i-- > 0;) p = p * x + real(power[i][j]);
        return p;
    }
};

/// One over the rays' length per depth: some value amid those of a tile, and by what share they differ from it at most.
struct TileRays {
    float inverse = 1, spread = 0;
};

using CellTag = hn::CappedTag<float, CellBatch::capacity>;

/// What the polynomials follow from, one lane per cell of a batch: scalarFall amid the cell's pixels, and by how much
/// it differs from that over them at most.
struct IsosurfaceView {
    hn::Vec<CellTag> fall, spread;
};

HWY_INLINE IsosurfaceView isosurfaceView(const CellBatch& batch, std::size_t j, bool orthographic) {
    const CellTag tag;
    const auto perInverseDepth = hn::LoadU(tag, batch.scalarPerInverseDepth + j);
    if (orthographic) return {perInverseDepth, hn::Zero(tag)};
    const hn::RebindToSigned<CellTag> whole;
    hn::Vec<decltype(whole)> beginX, beginY, endX, endY;
    hn::LoadInterleaved2(whole, &batch.begin[j][0], beginX, beginY);
    hn::LoadInterleaved2(whole, &batch.end[j][0], endX, endY);
    const auto half = hn::Set(tag, 0.5f);
    const auto extent = [&](auto begin, auto end)
                            HWY_ATTR { return hn::Mul(half, hn::ConvertTo(tag, hn::Sub(end, begin))); };
    const auto middle = [&](const float* offset, auto begin, auto end) HWY_ATTR {
        return hn::MulAdd(half, hn::ConvertTo(tag, hn::Add(begin, end)), hn::LoadU(tag, offset + j));
    };
    const auto perX = hn::LoadU(tag, batch.scalarPerX + j), perY = hn::LoadU(tag, batch.scalarPerY + j);
    const auto across =
        hn::MulAdd(perX, middle(batch.offsetX, beginX, endX), hn::Mul(perY, middle(batch.offsetY, beginY, endY)));
    return {hn::Sub(perInverseDepth, across),
            hn::MulAdd(hn::Abs(perX), extent(beginX, endX), hn::Mul(hn::Abs(perY), extent(beginY, endY)))};
}

/// Lanes of cells as lanes of pixels: nothing beyond the batch.
template <class Lanes>
HWY_INLINE real pixelLanes(Lanes cells) {
    if constexpr (laneCount() > CellBatch::capacity)
        return hn::ZeroExtendVector(FloatTag(), cells);
    else
        return cells;
}

/// The polynomials of a batch. `depth`: D of each cell's isosurface.
HWY_INLINE void setPolynomials(const CellBatch& batch, const float* depth, const TileRays& rays, bool orthographic,
                               PreparedIsosurfaces& prepared) {
    const CellTag tag;
    const real one(1.0f);
    for (std::size_t j = 0; j < CellBatch::capacity; j += hn::Lanes(tag)) {
        const IsosurfaceView view = isosurfaceView(batch, j, orthographic);
        const real fall = pixelLanes(view.fall), perFall = one / fall, perCentre = perFall * real(1.0f / rays.inverse);
        const real steepness =
            abs(pixelLanes(hn::LoadU(tag, batch.scale + j))) * pixelLanes(hn::LoadU(tag, batch.gradient + j));
        // the powers of 1/fall are to stay within float: gradients may be rounding's
        storeAt(select(abs(fall) < real(1e-7f), one, abs(perFall) * pixelLanes(view.spread) + real(rays.spread)),
                prepared.spread + j);
        storeAt(fall * real(rays.inverse), prepared.centre + j);
        const real q = min(abs(perCentre) * steepness * pixelLanes(hn::LoadU(tag, depth + j)), real(80.0f)),
                   fade = fadeOf(q);
        const real terms[4] = {q, q * (real(0.5f) * q - one), q * (q * (real(1.0f / 6.0f) * q - one) + one),
                               q * (q * (q * (real(1.0f / 24.0f) * q - real(0.5f)) + real(1.5f)) - one)};
        storeAt(one - fade, prepared.power[0] + j);
        real scale = -fade;
        for (std::size_t i = 0; i < 4; ++i) {
            scale = scale * perCentre;
            storeAt(scale * terms[i], prepared.power[i + 1] + j);
        }
    }
}

/// A neighbour's end of a segment may lie beyond a cell's scalars by rounding; scene units.
constexpr float scalarRounding = 2e-6f;

/// The pieces of the transfer function that the scalars of cell j lie in.
template <bool Isosurfaces>
HWY_INLINE void findPieces(const CpuTransfer& transfer, const CellBatch& batch, std::size_t j, std::size_t& first,
                           std::size_t& last) {
    if constexpr (Isosurfaces) {
        first = transfer.pieceFromAbove(batch.scalarLow[j] - scalarRounding);
        last = transfer.pieceFromAbove(batch.scalarHigh[j] + scalarRounding);
    } else {
        first = transfer.pieceFromAbove(batch.scalarLow[j]);
        last = std::max(first, transfer.pieceFromBelow(batch.scalarHigh[j]));
    }
}

/// The pieces that the batch's cells meet, their isosurface where there is just one, and its polynomial where there are
/// silhouettes.
inline HWY_NOINLINE void prepareIsosurfaces(const TileFrame& frame, const CellBatch& batch, std::size_t cells,
                                            const TileRays& rays, PreparedIsosurfaces& prepared) {
    alignas(64) float depth[CellBatch::capacity] = {};
    bool any = false;
    for (std::size_t j = 0; j < cells; ++j) {
        findPieces<true>(*frame.transfer, batch, j, prepared.first[j], prepared.last[j]);
        const TransferPiece &a = frame.transfer->pieces()[prepared.first[j]],
                            &b = frame.transfer->pieces()[prepared.last[j]];
        prepared.isosurface[j] = nullptr;
        if (prepared.last[j] != prepared.first[j] + 1 || a.isosurfaceEnd != a.isosurfaceBegin + 1) continue;
        prepared.isosurface[j] = &frame.transfer->isosurfaces()[a.isosurfaceBegin];
        prepared.inMedium[j] = a.visible || b.visible;
        depth[j] = prepared.isosurface[j]->depth;
        any = true;
    }
    if (!any || !frame.variant.silhouettes) return;
    setPolynomials(batch, depth, rays, frame.orthographic, prepared);
}

/// Fills the tile's inverse ray lengths.
inline HWY_NOINLINE TileRays inverseRayLengths(TileBuffers& px) {
    const real least(-3e38f);
    real most = least, mostNegated = least;
    for (std::size_t i = 0; i < tilePixels; i += laneCount()) {
        const real inverse = reciprocal(loadAligned(px.rayLength + i));
        storeAt(inverse, px.inverseLength + i);
        most = max(most, inverse);
        mostNegated = max(mostNegated, -inverse);
    }
    const float high = largest(most), low = -largest(mostNegated);
    return {0.5f * (high + low), (high - low) / (high + low)};
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
