// SPDX-License-Identifier: Apache-2.0
//
// What a scalar that is exactly a node's counts for: the value from above. One text for GLSL, C++ in double and SIMD
// lanes, taken by everything that asks whether a segment, a cell or a sample meets an isosurface or a jump.

// An isosurface or a jump at `value` lies on the way from `front` to `back`.
TETRALUX_GLSL_FUNCTION TETRALUX_GLSL_BOOL crossesValue(real front, real back, real value) { return exactlyOne(front < value, back < value); }

#ifndef TETRALUX_LANES
// Whether scalars from `least` to `most` have extinction that stands between `low` and `high`, and at `low` itself
// where `lowShows` (a jump). Of a segment on which the scalar varies, single points are nothing; one on which it is
// constant is all at that point.
TETRALUX_GLSL_FUNCTION bool showsBetween(real least, real most, real low, real high, bool lowShows) {
    return least < high && (most > low || (lowShows && least >= low));
}
#endif
