// SPDX-License-Identifier: Apache-2.0
//
// Opacity and colour of a short segment on which colour and extinction are linear, by polynomials: no exponential, no division. One text for
// C++ in double (tests against preint::linearPieceWeights) and for SIMD lanes; see preint/glsl_prelude.h for the common subset.
//
// With front and back depths d_f = τ_f·l and d_b = τ_b·l write D = (d_f + d_b)/2 for the optical depth and δ = (d_b − d_f)/2. Moreland & Angel's
// weights (2004, thesis Equations 5.5–5.10) are C = c_f·W_f + c_b·W_b. In terms of the mean colour c = (c_f + c_b)/2 and the half
// difference e = (c_b − c_f)/2,
//
//   C = c·α + e·V,   α = W_f + W_b = 1 − exp(−D),   V = W_b − W_f = 2Ψ − 1 − exp(−D),   Ψ = ∫₀¹ exp(−Dx + δx(1 − x)) dx.
//
// Expanding exp(δx(1 − x)) gives, with K_n(D) = ∫ (1/4 − y²)ⁿ exp(−Dy) dy over [−1/2, 1/2],
//
//   V = exp(−D/2)·[2K₁·(δ − D²/2) + K₂·δ² + K₃/3·δ³ + …],
//
// where the terms that cancel (K₀ − cosh(D/2) = −K₁·D²/2) have cancelled on paper: thin segments keep their relative precision. The functions of
// D alone are polynomials fitted at Chebyshev nodes on [0, 1]. Largest errors for D ≤ 1, |δ| ≤ 1/2: α 3e-7·D², V 1.4e-5.

TETRALUX_GLSL_FUNCTION real pieceDepthLimit() { return real(1.0); }
TETRALUX_GLSL_FUNCTION real pieceSlopeLimit() { return real(0.5); }

// 1 − exp(−D), D ≤ 1.
TETRALUX_GLSL_FUNCTION real pieceOpacity(real depth) {
    real p = real(-0.000981258207) * depth + real(0.00800055647);
    p = p * depth + real(-0.0415518936);
    p = p * depth + real(0.166652616);
    p = p * depth + real(-0.499999723);
    p = p * depth + real(1.0);
    return p * depth;
}

// V, for D ≤ 1 and |δ| ≤ 1/2.
TETRALUX_GLSL_FUNCTION real pieceSkew(real depth, real halfStep) {
    real a = real(0.00137703303) * depth + real(-0.010616848);
    a = a * depth + real(0.049829769);
    a = a * depth + real(-0.166645845);
    a = a * depth + real(0.333332923);
    real e = real(0.00352464817) * depth + real(-0.016231814);
    e = e * depth + real(0.0333099482);
    real f = real(-0.00091362244) * depth + real(0.00234843061);
    real first = real(-0.5) * depth * depth + halfStep;
    real higher = f * halfStep + e;
    return higher * (halfStep * halfStep) + a * first;
}

// Where along a linear piece (0 … 1) the depth from its front reaches `reached`, given the depths at its ends (their mean is the whole depth).
TETRALUX_GLSL_FUNCTION real pieceFraction(real frontDepth, real backDepth, real reached) {
    real root = sqrt(max(frontDepth * frontDepth + real(2.0) * (backDepth - frontDepth) * reached, real(0.0)));
    return min(real(2.0) * reached / max(frontDepth + root, real(1e-30)), real(1.0));
}
