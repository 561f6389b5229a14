// SPDX-License-Identifier: Apache-2.0
//
// Where a segment lies in a pre-integration table (preint/preintegration_table.h). One text for GLSL and C++; see
// preint/glsl_prelude.h for the common subset. The including text provides
//
//   vec4 tableTexel(real u, real v, real w)  the table, linearly filtered. Coordinates count texels, the centre of texel i is i + 1/2.
//                                            u: front scalar, v: back scalar and zone, w: length slice (1/2 in a 2D table)
//   real tableSize                           texels per scalar axis of a zone
//   tableZone[z]                             vec2(low, 1/(high − low)) of zone z; 0 for the reciprocal of an empty range
//   TETRALUX_INTERFACES                      0: no interfaces, one zone
//   TETRALUX_SCALE_INVARIANT                 1: 2D table; 0: 3D table, which needs besides
//   real tableSlices, tableLengthMax, tableLengthScale
//
// Each mapping stands beside its inverse. The ends of a range lie at texel centres, so that no texel beyond the zone has weight.

// Fraction of a zone's range ↔ texel coordinate along a scalar axis.
TETRALUX_GLSL_FUNCTION real texelOfFraction(real fraction, real size) { return real(0.5) + fraction * (size - real(1.0)); }
TETRALUX_GLSL_FUNCTION real fractionOfTexel(real texel, real size) { return (texel - real(0.5)) / (size - real(1.0)); }

// Length ↔ fraction of the length axis: logarithmic, linear for lengths far below `scale` (where depth is small and mean colour is
// linear in it).
TETRALUX_GLSL_FUNCTION real fractionOfLength(real segmentLength, real lengthMax, real scale) {
    return log(real(1.0) + segmentLength / scale) / log(real(1.0) + lengthMax / scale);
}
TETRALUX_GLSL_FUNCTION real lengthOfFraction(real fraction, real lengthMax, real scale) {
    return scale * (exp(fraction * log(real(1.0) + lengthMax / scale)) - real(1.0));
}

// (mean colour C/α, mean extinction) of a segment within one zone; scalars beyond the zone and lengths beyond the last slice are clamped.
TETRALUX_GLSL_FUNCTION vec4 tableEntry(int zone, real front, real back, real segmentLength) {
    real low = tableZone[zone].x;
    real perScalar = tableZone[zone].y;
    real u = clamp((front - low) * perScalar, real(0.0), real(1.0));
    real v = clamp((back - low) * perScalar, real(0.0), real(1.0));
    real row = texelOfFraction(v, tableSize);
#if TETRALUX_INTERFACES
    // Zones are stacked, and at its ends float coordinates would give the next zone some 1e-3 of weight: stay inside by that much.
    row = clamp(row, real(0.501), tableSize - real(0.501)) + real(zone) * tableSize;
#endif
#if TETRALUX_SCALE_INVARIANT
    return tableTexel(texelOfFraction(u, tableSize), row, real(0.5));
#else
    real w = min(fractionOfLength(segmentLength, tableLengthMax, tableLengthScale), real(1.0));
    return tableTexel(texelOfFraction(u, tableSize), row, texelOfFraction(w, tableSlices));
#endif
}
