// SPDX-License-Identifier: Apache-2.0
//
// Where the ray of a pixel runs inside a projected tetrahedron, and the scalar there. One text for GLSL, for C++ in
// double (tests) and for SIMD lanes. `real` varies from pixel to pixel, `cell_real` is the same for a whole cell; in
// GLSL both are float.
//
// A cell is described relative to a point c, as a rule its centroid (cell_setup.h derives all of this in double
// precision):
//
//   dx, dy        pixel offsets from the projection of c
//   inverseDepth  relative to that of c: z_c/z − 1 in perspective, (z_c − z)/|z_c| in orthographic views. 0 at the depth
//                 of c, larger is nearer. Every face plane is affine in (dx, dy): inverseDepth_i = plane.x + plane.y·dx +
//                 plane.z·dy. So a face that shows its outside to the eye bounds it from above, one that shows its inside
//                 from below, and nothing is divided by the thin angle of a silhouette.
//   scale         z_c, in scene lengths
//
// All differences are taken near the cell, so float keeps its relative precision at any distance or offset of the mesh.

// inverseDepth of one face plane.
TETRALUX_GLSL_FUNCTION real planeInverseDepth(cell_real constant, cell_real perX, cell_real perY, real dx, real dy) {
    return constant + perX * dx + perY * dy;
}

// Depth ratio r = z/z_c at inverseDepth, perspective. Engines that vectorize get the ratios of both ends of a segment
// from one reciprocal.
TETRALUX_GLSL_FUNCTION real depthRatio(real inverseDepth) { return real(1.0) / (real(1.0) + inverseDepth); }

// Length of the segment between two values of inverseDepth, in scene length units, for a ray direction of length
// `rayLength` per unit depth (1 in orthographic views).
TETRALUX_GLSL_FUNCTION real segmentLengthOfRatios(cell_real scale, real inverseDepthIn, real inverseDepthOut, real ratioIn, real ratioOut,
                                                  real rayLength) {
    return scale * rayLength * ((inverseDepthIn - inverseDepthOut) * ratioIn) * ratioOut;
}
TETRALUX_GLSL_FUNCTION real segmentLengthPerspective(cell_real scale, real inverseDepthIn, real inverseDepthOut, real rayLength) {
    return segmentLengthOfRatios(scale, inverseDepthIn, inverseDepthOut, depthRatio(inverseDepthIn), depthRatio(inverseDepthOut), rayLength);
}
TETRALUX_GLSL_FUNCTION real segmentLengthOrthographic(cell_real scale, real inverseDepthIn, real inverseDepthOut) {
    return abs(real(scale)) * (inverseDepthIn - inverseDepthOut);
}

// A number with the sign of s_f − s_b. The difference of the two scalars would lose it to rounding where a ray runs
// almost along a level set. In orthographic views `across` is 0.
TETRALUX_GLSL_FUNCTION real scalarFall(real across, cell_real perInverseDepth) { return perInverseDepth - across; }

// Scalar at inverseDepth: value at c plus gradient, kept within the cell's own range, which rounding may leave in
// slivers. `across` is perX·dx + perY·dy, the same at both ends of a segment.
TETRALUX_GLSL_FUNCTION real scalarOfRatio(cell_real atReference, real across, cell_real perInverseDepth, real inverseDepth, real ratio,
                                          cell_real low, cell_real high) {
    return clamp(atReference + (across + perInverseDepth * inverseDepth) * ratio, real(low), real(high));
}
TETRALUX_GLSL_FUNCTION real scalarPerspective(cell_real atReference, cell_real perX, cell_real perY, cell_real perInverseDepth,
                                              real dx, real dy, real inverseDepth, cell_real low, cell_real high) {
    return scalarOfRatio(atReference, perX * dx + perY * dy, perInverseDepth, inverseDepth, depthRatio(inverseDepth), low, high);
}
TETRALUX_GLSL_FUNCTION real scalarOrthographic(cell_real atReference, cell_real perX, cell_real perY, cell_real perInverseDepth,
                                               real dx, real dy, real inverseDepth, cell_real low, cell_real high) {
    return clamp(atReference + perX * dx + perY * dy + perInverseDepth * inverseDepth, real(low), real(high));
}
