// SPDX-License-Identifier: Apache-2.0
//
// Where the ray of a pixel runs inside a projected tetrahedron, and the scalar there. One text for GLSL, for C++ in
// double (tests) and for SIMD lanes. `real` varies from pixel to pixel, `cell_real` is the same for a whole cell; in
// GLSL both are float.
//
// A cell is described relative to a point c, as a rule its centroid (cell_setup.h derives all of this in double precision):
//
//   dx, dy   pixel offsets from the projection of c
//   rho      relative nearness: z_c/z − 1 in perspective, (z_c − z)/|z_c| in orthographic views. 0 at the depth of c, larger
//            is nearer. Every face plane is affine in (dx, dy): rho_i = plane.x + plane.y·dx + plane.z·dy. So a face that
//            shows its outside to the eye bounds rho from above, one that shows its inside bounds it from below, and nothing is divided by
//            the thin angle of a silhouette.
//   scale    z_c, in scene lengths
//
// All differences are taken near the cell, so float keeps its relative precision at any distance or offset of the mesh.

// rho of one face plane.
TETRALUX_GLSL_FUNCTION real planeRho(cell_real constant, cell_real perX, cell_real perY, real dx, real dy) {
    return constant + perX * dx + perY * dy;
}

// Depth ratio r = z/z_c at rho, perspective. Engines that vectorize get the ratios of both ends of a segment from one reciprocal.
TETRALUX_GLSL_FUNCTION real depthRatio(real rho) { return real(1.0) / (real(1.0) + rho); }

// Length of the segment between two values of rho, in scene length units, for a ray direction of length `rayLength`
// per unit depth (1 in orthographic views).
TETRALUX_GLSL_FUNCTION real segmentLengthOfRatios(cell_real scale, real rhoIn, real rhoOut, real ratioIn, real ratioOut,
                                                  real rayLength) {
    return scale * rayLength * ((rhoIn - rhoOut) * ratioIn) * ratioOut;
}
TETRALUX_GLSL_FUNCTION real segmentLengthPerspective(cell_real scale, real rhoIn, real rhoOut, real rayLength) {
    return segmentLengthOfRatios(scale, rhoIn, rhoOut, depthRatio(rhoIn), depthRatio(rhoOut), rayLength);
}
TETRALUX_GLSL_FUNCTION real segmentLengthOrthographic(cell_real scale, real rhoIn, real rhoOut) {
    return abs(real(scale)) * (rhoIn - rhoOut);
}

// A number with the sign of s_f − s_b. The difference of the two scalars would lose it to rounding where a ray runs almost along a level
// set. In orthographic views `across` is 0.
TETRALUX_GLSL_FUNCTION real scalarFall(real across, cell_real perRho) { return perRho - across; }

// Scalar at rho: value at c plus gradient, kept within the cell's own range, which rounding may leave in slivers. `across` is
// perX·dx + perY·dy, the same at both ends of a segment.
TETRALUX_GLSL_FUNCTION real scalarOfRatio(cell_real atReference, real across, cell_real perRho, real rho, real ratio,
                                          cell_real low, cell_real high) {
    return clamp(atReference + (across + perRho * rho) * ratio, real(low), real(high));
}
TETRALUX_GLSL_FUNCTION real scalarPerspective(cell_real atReference, cell_real perX, cell_real perY, cell_real perRho,
                                              real dx, real dy, real rho, cell_real low, cell_real high) {
    return scalarOfRatio(atReference, perX * dx + perY * dy, perRho, rho, depthRatio(rho), low, high);
}
TETRALUX_GLSL_FUNCTION real scalarOrthographic(cell_real atReference, cell_real perX, cell_real perY, cell_real perRho,
                                               real dx, real dy, real rho, cell_real low, cell_real high) {
    return clamp(atReference + perX * dx + perY * dy + perRho * rho, real(low), real(high));
}
