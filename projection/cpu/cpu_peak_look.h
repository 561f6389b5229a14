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

#if defined(TETRALUX_CPU_PEAK_LOOK_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_PEAK_LOOK_H
#undef TETRALUX_CPU_PEAK_LOOK_H
#else
#define TETRALUX_CPU_PEAK_LOOK_H
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

/// What a block of pixels need not ask about its cell. NarrowPeak: one isosurface and nothing else, with silhouettes,
/// whose polynomial holds.
enum class CellShows { Anything, NarrowPeak };

/// Of the cells of one batch: what each shows, and the polynomials.
struct PeakLooks {
    static constexpr std::size_t room = std::max(CellBatch::capacity, laneCount());
    static constexpr float mostSpread = 0.048f;  // and what products of spreads add

    std::size_t first[CellBatch::capacity], last[CellBatch::capacity];  ///< pieces of the transfer function
    const TransferPeak* peak[CellBatch::capacity];                      ///< nullptr: there is more to see, or nothing
    /// The largest |ε|, z₀, and Σ power[i]·(z − z₀)^i. The polynomial does not hold where spread is not below
    /// mostSpread.
    alignas(64) float spread[room], centre[room], power[5][room];

    bool narrow(std::size_t j) const { return spread[j] < mostSpread; }

    /// `z`: scalarFall/(ray per depth) of pixels of cell j.
    HWY_INLINE real opacity(std::size_t j, real z) const {
        const real x = z - real(centre[j]);
        real p = real(power[4][j]) * x + real(power[3][j]);
        for (std::size_t i = 3; i-- > 0;) p = p * x + real(power[i][j]);
        return p;
    }
};

/// One over the rays' length per depth: some value amid those of a tile, and by what share they differ from it at most.
struct TileRays {
    float inverse = 1, spread = 0;
};

/// What the polynomials follow from, per cell of a batch: scalarFall at its reference point, by how much it differs
/// from that over the cell's pixels at most, and D·steepness.
struct PeakView {
    alignas(64) float fall[PeakLooks::room] = {}, spread[PeakLooks::room] = {}, steepDepth[PeakLooks::room] = {};

    template <bool Orthographic>
    HWY_INLINE void set(const CellBatch& batch, std::size_t j, const TransferPeak& peak) {
        fall[j] = batch.scalarPerRho[j];
        steepDepth[j] = peak.depth * (batch.gradient[j] * std::abs(batch.scale[j]));
        if constexpr (Orthographic) return;
        const float x = batch.offsetX[j], y = batch.offsetY[j];
        const float farX = std::max(std::abs(x + static_cast<float>(batch.begin[j][0])),
                                    std::abs(x + static_cast<float>(batch.end[j][0]))),
                    farY = std::max(std::abs(y + static_cast<float>(batch.begin[j][1])),
                                    std::abs(y + static_cast<float>(batch.end[j][1])));
        spread[j] = std::abs(batch.scalarPerX[j]) * farX + std::abs(batch.scalarPerY[j]) * farY;
    }
};

inline HWY_NOINLINE void setPolynomials(const PeakView& view, const TileRays& rays, PeakLooks& looks) {
    const real one(1.0f);
    for (std::size_t j = 0; j < CellBatch::capacity; j += laneCount()) {
        const real fall = loadAligned(view.fall + j), centre = fall * real(rays.inverse);
        storeAt(loadAligned(view.spread + j) / abs(fall) + real(rays.spread), looks.spread + j);
        storeAt(centre, looks.centre + j);
        const real perCentre = one / centre;
        const real q = min(loadAligned(view.steepDepth + j) * abs(perCentre), real(80.0f)), fade = fadeOf(q);
        const real terms[4] = {q, q * (real(0.5f) * q - one), q * (q * (real(1.0f / 6.0f) * q - one) + one),
                               q * (q * (q * (real(1.0f / 24.0f) * q - real(0.5f)) + real(1.5f)) - one)};
        storeAt(one - fade, looks.power[0] + j);
        real scale = -fade;
        for (std::size_t i = 0; i < 4; ++i) {
            scale = scale * perCentre;
            storeAt(scale * terms[i], looks.power[i + 1] + j);
        }
    }
}

/// A neighbour's end of a segment may lie beyond a cell's scalars by rounding; scene units.
constexpr float scalarRounding = 2e-6f;

/// The pieces of the transfer function that the scalars of cell j lie in.
template <bool Peaks>
HWY_INLINE void findPieces(const CpuTransfer& transfer, const CellBatch& batch, std::size_t j, std::size_t& first,
                           std::size_t& last) {
    if constexpr (Peaks) {
        first = transfer.pieceFromAbove(batch.scalarLow[j] - scalarRounding);
        last = transfer.pieceFromAbove(batch.scalarHigh[j] + scalarRounding);
    } else {
        first = transfer.pieceFromAbove(batch.scalarLow[j]);
        last = std::max(first, transfer.pieceFromBelow(batch.scalarHigh[j]));
    }
}

/// The batch's cells that show one isosurface and nothing else, and their polynomials where there are silhouettes.
template <bool Orthographic>
HWY_INLINE void lookAtPeaks(const TileFrame& frame, const CellBatch& batch, std::size_t cells, const TileRays& rays,
                            PeakLooks& looks) {
    PeakView view;
    bool any = false;
    for (std::size_t j = 0; j < cells; ++j) {
        findPieces<true>(*frame.transfer, batch, j, looks.first[j], looks.last[j]);
        looks.peak[j] = onlyPeak(*frame.transfer, looks.first[j], looks.last[j]);
        if (looks.peak[j] == nullptr) continue;
        any = true;
        view.template set<Orthographic>(batch, j, *looks.peak[j]);
    }
    if (any && frame.look.silhouettes) setPolynomials(view, rays, looks);
}

/// Fills the tile's inverse ray lengths.
inline TileRays inverseRayLengths(TileBuffers& px) {
    const real one(1.0f), least(-3e38f);
    real most = least, mostNegated = least;
    for (std::size_t i = 0; i < tilePixels; i += laneCount()) {
        const real inverse = one / loadAligned(px.rayLength + i);
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
