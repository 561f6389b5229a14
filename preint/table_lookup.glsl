// SPDX-License-Identifier: Apache-2.0
//
// Where a segment lies in a pre-integration table (preint/preintegration_table.h). One text for GLSL and C++; see
// preint/glsl_prelude.h for the common subset. The including text provides
//
//   vec4 tableTexel(real u, real v, real w) the table, linearly filtered. Coordinates count texels, the centre of texel
//                                            i is i + 1/2. u: front scalar, v: back scalar and zone,
//                                            w: length slice (1/2 in a 2D table)
//   real tableSize                          texels per scalar axis of a zone
//   TETRALUX_DISCONTINUITIES                0: no discontinuities, one zone
//   TETRALUX_WARPS                          entries of the table's warp; 0 (or not defined) when it is not `warped`
//   vec2 tableWarp[TETRALUX_WARPS]          when warped: the table's `warp`
//   vec2 tableZone[]                        when not: (low, 1/(high − low)) of each zone, (low, 0) of an empty one
//   TETRALUX_SCALE_INVARIANT                1: 2D table; 0: 3D table, which needs besides
//   real tableSlices, tableLengthMax, tableLengthScale
//
//   TETRALUX_RAMPS                          entries of the table's `ramps`; 0 (or not defined): extinction is the texels'
//   vec3 tableRamp[TETRALUX_RAMPS]          the table's `ramps`
//
// Where the numbers of entries are not known when compiling, TETRALUX_WARPS and TETRALUX_RAMPS are 1 and
// TETRALUX_WARP_COUNT and TETRALUX_RAMP_COUNT hold them. Each mapping stands beside its inverse. The ends of a range
// lie at texel centres, so that no texel beyond the zone has weight.

#ifndef TETRALUX_WARPS
#define TETRALUX_WARPS 0
#endif
#ifndef TETRALUX_RAMPS
#define TETRALUX_RAMPS 0
#endif
#ifndef TETRALUX_RAMP_COUNT
#define TETRALUX_RAMP_COUNT TETRALUX_RAMPS
#endif
#ifndef TETRALUX_WARP_COUNT
#define TETRALUX_WARP_COUNT TETRALUX_WARPS
#endif

// Scalar ↔ fraction of a zone's texels. A sum of ramps rather than a search: no branch, no gather.
#if TETRALUX_WARPS
TETRALUX_GLSL_FUNCTION real fractionOfScalar(int zone, real scalar) {
    real coordinate = -real(zone);
    for (int k = 0; k < TETRALUX_WARP_COUNT; ++k) {
        coordinate += tableWarp[k].y * max(scalar - tableWarp[k].x, real(0.0));
    }
    return clamp(coordinate, real(0.0), real(1.0));
}
TETRALUX_GLSL_FUNCTION real scalarOfFraction(int zone, real fraction) {
    real missing = real(zone) + fraction;  // table coordinate from the last ramp's start on
    real scalar = tableWarp[0].x;
    real slope = tableWarp[0].y;
    for (int k = 1; k < TETRALUX_WARP_COUNT; ++k) {
        real covered = slope * (tableWarp[k].x - scalar);
        if (covered > missing) break;
        missing -= covered;
        scalar = tableWarp[k].x;
        slope += tableWarp[k].y;
    }
    return scalar + missing / slope;
}
#else
TETRALUX_GLSL_FUNCTION real fractionOfScalar(int zone, real scalar) {
    return clamp((scalar - tableZone[zone].x) * tableZone[zone].y, real(0.0), real(1.0));
}
TETRALUX_GLSL_FUNCTION real scalarOfFraction(int zone, real fraction) { return tableZone[zone].x + fraction / tableZone[zone].y; }
#endif

// Fraction of an axis ↔ texel coordinate.
TETRALUX_GLSL_FUNCTION real texelOfFraction(real fraction, real size) { return real(0.5) + fraction * (size - real(1.0)); }
TETRALUX_GLSL_FUNCTION real fractionOfTexel(real texel, real size) { return (texel - real(0.5)) / (size - real(1.0)); }

// Length ↔ fraction of the length axis: logarithmic, linear for lengths far below `scale` (where depth is small and
// mean colour is linear in it).
TETRALUX_GLSL_FUNCTION real fractionOfLength(real segmentLength, real lengthMax, real scale) {
    return log(real(1.0) + segmentLength / scale) / log(real(1.0) + lengthMax / scale);
}
TETRALUX_GLSL_FUNCTION real lengthOfFraction(real fraction, real lengthMax, real scale) {
    return scale * (exp(fraction * log(real(1.0) + lengthMax / scale)) - real(1.0));
}

#if TETRALUX_RAMPS
// Mean of extinction between two scalars, (Θ(back) − Θ(front))/(back − front), without a difference of integrals: a
// ramp that begins at s_k covers `share` of the way (exactly 1 or 0 for most) and rises there evenly from its jump to
// the sum of both ends' heights.
TETRALUX_GLSL_FUNCTION real meanExtinctionOf(real front, real back) {
    real low = min(front, back);
    real high = max(front, back);
    real perWay = real(1.0) / max(high - low, real(1e-30));
    real sum = tableRamp[0].y + tableRamp[0].z * ((low - tableRamp[0].x) + (high - tableRamp[0].x));  // begins where the range does
    for (int k = 1; k < TETRALUX_RAMP_COUNT; ++k) {
        real beyondLow = max(low - tableRamp[k].x, real(0.0));
        real beyondHigh = max(high - tableRamp[k].x, real(0.0));
        real share = select(low >= tableRamp[k].x, real(1.0), min(beyondHigh * perWay, real(1.0)));
        sum += share * (tableRamp[k].y + tableRamp[k].z * (beyondLow + beyondHigh));
    }
    return max(sum, real(0.0));
}
#endif

// (mean colour C/α, mean extinction) of a segment within one zone; scalars beyond the zone and lengths beyond the
// last slice are clamped.
TETRALUX_GLSL_FUNCTION vec4 tableEntry(int zone, real front, real back, real segmentLength) {
    real column = texelOfFraction(fractionOfScalar(zone, front), tableSize);
    real row = texelOfFraction(fractionOfScalar(zone, back), tableSize);
#if TETRALUX_DISCONTINUITIES
    // Zones are stacked, and at its ends float coordinates would give the next zone some 1e-3 of weight: stay inside
    // by that much.
    row = clamp(row, real(0.501), tableSize - real(0.501)) + real(zone) * tableSize;
#endif
#if TETRALUX_SCALE_INVARIANT
    vec4 entry = tableTexel(column, row, real(0.5));
#else
    real w = min(fractionOfLength(segmentLength, tableLengthMax, tableLengthScale), real(1.0));
    vec4 entry = tableTexel(column, row, texelOfFraction(w, tableSlices));
#endif
#if TETRALUX_RAMPS
    if (TETRALUX_RAMP_COUNT > 0) entry.w = meanExtinctionOf(front, back);
#endif
    return entry;
}
