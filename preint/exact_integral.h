// SPDX-License-Identifier: Apache-2.0
/// \file
/// The judge: what light meets along one segment, in double precision, by closed form or quadrature, no table.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include <preint/transfer_function.h>

namespace tetralux::preint {

/// Over what extinction is integrated: path length, or variation of the scalar (Kraus 2005, Equation 3).
enum class Integral { Standard, ScaleInvariant };

/// What a segment adds: `color` is premultiplied, `opticalDepth` = −ln(transmittance) (infinite when opaque).
struct SegmentResult {
    glm::dvec3 color{0};
    double opticalDepth = 0.0;
    double opacity() const;  ///< 1 − exp(−opticalDepth), accurate for thin segments
    double transmittance() const;
};

/// Piecewise-linear pieces of one transfer function, prepared once. `function` must be absolute (`resolved`).
class ExactIntegral {
public:
    explicit ExactIntegral(const TransferFunction& function);

    /// The segment from scalar `front` to `back`, linear over `length` (mesh units, ≥ 0), isosurfaces included;
    /// relative accuracy 1e-12. An isosurface v is crossed exactly when (front < v) ≠ (back < v). Several at one value
    /// follow each other in their listed order when the scalar rises along the segment, in reverse when it falls.
    /// With front = back the standard integral is that of a constant (at a jump: of the value from above), the
    /// scale-invariant one is nothing.
    SegmentResult segment(double front, double back, double length, Integral integral) const;

    /// The same without isosurfaces: what tables hold.
    SegmentResult smoothSegment(double front, double back, double length, Integral integral) const;

    /// Θ(s): integral of τ from the first node to s, in units of τ·scalar (negative below the first node).
    double extinctionIntegral(double scalar) const;

    const TransferFunction& function() const { return function_; }

    struct PointValue {
        glm::dvec3 color;
        double extinction;
    };
    PointValue valueFromAbove(double scalar) const;  ///< they differ at jumps only
    PointValue valueFromBelow(double scalar) const;

    /// The largest extinction anywhere in [low, high].
    double largestExtinction(double low, double high) const;

    /// The colour that a segment over [low, high] without extinction takes on as soon as it grows: that of the nearest
    /// visible scalar within [limitLow, limitHigh], of the middle when there is none.
    glm::dvec3 nearestVisibleColor(double low, double high, double limitLow, double limitHigh) const;

private:
    struct Piece {  // between two neighbouring nodes of colour or extinction
        double low, high;
        double inverseWidth;  // 1/(high − low); 0 for the two outer pieces, which are constant
        double extinctionLow, extinctionHigh;
        glm::dvec3 colorLow, colorHigh;
        double extinctionIntegralLow;  // Θ(low); of the first piece, Θ(high) = 0
    };
    std::size_t pieceFromAbove(double scalar) const;  // low ≤ scalar < high
    std::size_t pieceFromBelow(double scalar) const;  // low < scalar ≤ high
    static PointValue valueAt(const Piece& piece, double scalar);
    void addPiece(const PointValue& front, const PointValue& back, double path, SegmentResult& sum) const;
    void buildPieces();

    TransferFunction function_;
    std::vector<double> breaks_;  // ascending scalars of all nodes, each once
    std::vector<Piece> pieces_;   // breaks_.size() + 1; the first and last reach to ∓infinity with constant values
};

/// Weights of one linear piece of optical depth `front`·… (Moreland & Angel 2004, thesis Equations 5.5–5.10):
/// with depths τ_f·D and τ_b·D, C = c_f·frontWeight + c_b·backWeight where frontWeight = 1 − Ψ, backWeight = Ψ − ζ.
struct LinearPieceWeights {
    double frontWeight, backWeight, opticalDepth;
};
LinearPieceWeights linearPieceWeights(double frontDepth, double backDepth);

}  // namespace tetralux::preint
