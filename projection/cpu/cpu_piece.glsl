// SPDX-License-Identifier: Apache-2.0
//
// Opacity and colour of a short segment on which colour and extinction are linear, by polynomials: no exponential, no
// division. One text for C++ in double (tests against preint::linearPieceWeights) and for SIMD lanes; see
// preint/glsl_prelude.h for the common subset.
//
// With front and back depths d_f = τ_f·l and d_b = τ_b·l write D = (d_f + d_b)/2 for the optical depth and δ = (d_b −
// d_f)/2. Moreland & Angel's weights (2004, thesis Equations 5.5–5.10) are C = c_f·W_f + c_b·W_b. In terms of the
// mean colour c = (c_f + c_b)/2 and the half difference e = (c_b − c_f)/2,
//
//   C = c·α + e·V,   α = W_f + W_b = 1 − exp(−D),   V = W_b − W_f = 2Ψ − 1 − exp(−D),   Ψ = ∫₀¹ exp(−Dx + δx(1 − x)) dx.
//
// Expanding exp(δx(1 − x)) gives, with K_n(D) = ∫ (1/4 − y²)ⁿ exp(−Dy) dy over [−1/2, 1/2],
//
//   V = exp(−D/2)·[2K₁·(δ − D²/2) + K₂·δ² + K₃/3·δ³ + …],
//
// where the terms that cancel (K₀ − cosh(D/2) = −K₁·D²/2) have cancelled on paper: thin segments keep their relative
// precision. The functions of D alone are polynomials fitted at Chebyshev nodes on [0, 1]. Largest errors for D ≤ 1,
// |δ| ≤ 1/2: α 3e-7·D², V 1.4e-5.

TETRALUX_GLSL_FUNCTION real pieceDepthLimit() { return real(1.0); }
TETRALUX_GLSL_FUNCTION real pieceSlopeLimit() { return real(0.5); }

// (1 − exp(−D))/D, D ≤ 1.
TETRALUX_GLSL_FUNCTION real pieceOpacityPerDepth(real depth) {
    real p = real(-0.000981258207) * depth + real(0.00800055647);
    p = p * depth + real(-0.0415518936);
    p = p * depth + real(0.166652616);
    p = p * depth + real(-0.499999723);
    return p * depth + real(1.0);
}

// 1 − exp(−D), D ≤ 1.
TETRALUX_GLSL_FUNCTION real pieceOpacity(real depth) { return pieceOpacityPerDepth(depth) * depth; }

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

// V·D/α per unit of path, where silhouettes make the opacity another one: D and δ are `extinction` and `step` times
// the path. K_n(D) and the factor D/α·exp(−D/2) = (D/2)/sinh(D/2) are even, which makes this cheaper than V, and
// nothing is divided. D ≤ 1, |δ| ≤ 1/2; V to 1.4e-5.
TETRALUX_GLSL_FUNCTION real pieceLean(real extinction, real step, real depth, real halfStep) {
    real square = depth * depth;
    real a = real(0.000127452188) * square + real(-0.00555376143);
    a = a * square + real(0.333333234);
    real e = real(-0.000774238626) * square + real(0.0333309144);
    real first = real(-0.5) * extinction * depth + step;
    real higher = real(0.00234830414) * halfStep + e;
    return higher * (step * halfStep) + a * first;
}

// α and V for D ≤ 1/10: α to D⁵/120, V to D³/16.
TETRALUX_GLSL_FUNCTION real finePieceLimit() { return real(0.1); }
TETRALUX_GLSL_FUNCTION real finePieceOpacity(real depth) {
    real p = real(-1.0 / 24.0) * depth + real(1.0 / 6.0);
    p = p * depth + real(-0.5);
    return p * depth * depth + depth;
}
TETRALUX_GLSL_FUNCTION real finePieceSkew(real depth, real halfStep) {
    real a = real(1.0 / 30.0) * halfStep + real(1.0 / 3.0);
    real b = a * halfStep - real(1.0 / 6.0) * depth * depth;
    return b - real(0.5) * depth * b;
}

// Deep pieces: completing the square in Ψ with r = √|δ| gives, where the back is denser (error function) and where
// the front is (Dawson's integral F),
//
//   Ψ = [G(d_f/2r) − exp(−D)·G(d_b/2r)]/r,   G(u) = √π/2·exp(u²)·erfc(u)   or   G = F.
//
// Nothing large cancels where D > 1/2, since G falls and so does exp(−D).

// √π/2·exp(u²)·erfc(u), u ≥ 0: polynomial in t = 1/(1 + u/2), relative error 3e-6.
TETRALUX_GLSL_FUNCTION real scaledComplement(real u) {
    real t = real(1.0) / (real(0.5) * u + real(1.0));
    real p = real(0.0451195874) * t + real(-0.0978389124);
    p = p * t + real(-0.0360125521);
    p = p * t + real(0.110762798);
    p = p * t + real(0.143767195);
    p = p * t + real(0.220518906);
    p = p * t + real(0.24991165);
    p = p * t + real(0.250000698);
    return p * t;
}

// F(u) = exp(−u²)·∫₀ᵘ exp(x²) dx, u ≥ 0: rational (after Lether 1997), relative error 1e-5; beyond 30 its asymptotic
// series.
TETRALUX_GLSL_FUNCTION real dawsonIntegral(real u) {
    real y = min(u * u, real(900.0));
    real p = real(0.0001789971) * y + real(0.0005064034);
    p = p * y + real(0.0072644182);
    p = p * y + real(0.0424060604);
    p = p * y + real(0.1049934947);
    p = p * y + real(1.0);
    real q = real(0.0003579942) * y + real(0.0008327945);
    q = q * y + real(0.0140005442);
    q = q * y + real(0.0694555761);
    q = q * y + real(0.2909738639);
    q = q * y + real(0.7715471019);
    q = q * y + real(1.0);
    real inverse = real(1.0) / max(u, real(1.0));
    return select(u > real(30.0), inverse * (real(0.25) * inverse * inverse + real(0.5)), u * p / q);
}

// V of a deep piece from its ends' depths, r, exp(−D), and G at both ends.
TETRALUX_GLSL_FUNCTION real deepPieceSkew(real gFront, real gBack, real perRoot, real fade) {
    real psi = (gFront - fade * gBack) * perRoot;
    return real(2.0) * psi - (real(1.0) + fade);
}

// r, kept from 0: extinction that is as good as constant.
TETRALUX_GLSL_FUNCTION real deepPieceRoot(real halfStep) { return max(sqrt(abs(halfStep)), real(1e-6)); }
