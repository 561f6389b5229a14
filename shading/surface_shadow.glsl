// SPDX-License-Identifier: Apache-2.0
//
// Shadow of an isosurface upon segments of the cells through which it passes. One text for GLSL and C++; see
// preint/glsl_prelude.h for the common subset.
//
// What the vertices of such a cell carry leaves the cell's own isosurfaces out, so that none shades itself. Within
// the cell the scalar alone says what stands between a segment and the light: isosurfaces beyond both its ends, on
// the side from which light comes.
//
//   value, opacity  of the isosurface
//   front, back     scalars at the segment's ends
//   low, high       least and largest scalar of the cell
//   rise            g·l: positive where the scalar rises towards the light
// The share of light that the isosurface lets through; 1 where it does not pass through this cell.
TETRALUX_GLSL_FUNCTION real surfaceShadow(real value, real opacity, real front, real back, real low, real high, real rise) {
    real through = real(1.0) - opacity;
    real above = select(max(front, back) < value, select(value > high, real(1.0), through), real(1.0));
    real below = select(min(front, back) < value, real(1.0), select(value > low, through, real(1.0)));
    return select(rise > real(0.0), above, below);
}
