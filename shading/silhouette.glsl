// SPDX-License-Identifier: Apache-2.0
//
// The other ways from the optical depth of a cell segment to its opacity. One text for GLSL and C++; see
// preint/glsl_prelude.h.

// Kraus, "Scale-Invariant Volume Rendering", IEEE Visualization 2005, Equation 16: α′ = min(1, α·k). `opacity` = α =
// 1 − exp(−depth), `enhanced` = k·depth in the form that stays finite (silhouetteDepth), so that α·k =
// α/depth·enhanced has no division by a small cosine.
TETRALUX_GLSL_FUNCTION real approximateSilhouetteOpacity(real opacity, real depth, real enhanced) {
    real perDepth = select(depth > real(1e-6), opacity / max(depth, real(1e-6)), real(1.0));  // (1 − exp(−D))/D
    return min(perDepth * enhanced, real(1.0));
}

// The linear form of post-classification (Equation 11) has the opacity α = min(1, D). Its depth is −ln(1 − min(1,
// D)); this is that depth over D. Silhouettes and light take the segment as one of that depth, as Equation 15 asks.
TETRALUX_GLSL_FUNCTION real linearDepthFactor(real depth) {
    real series = real(1.0) + depth * (real(0.5) + depth * real(0.33333333));
    real through = max(real(1.0) - depth, real(1e-30));
    return select(depth > real(1e-3), -log(through) / max(depth, real(1e-3)), series);
}
