// SPDX-License-Identifier: Apache-2.0
//
// What light meets along one segment, by table look-up: a segment is cut at the discontinuities that it crosses
// (isosurfaces and jumps), so that these stay exact, and gathered front to back. Needs preint/table_lookup.glsl and,
// when there are discontinuities,
//
//   TETRALUX_DISCONTINUITY_COUNT            how many (TETRALUX_DISCONTINUITIES itself unless defined)
//   real discontinuityValue[]               ascending
//   vec4 discontinuityLayer[]               colour, optical depth −ln(1 − α₀); depth 0: only a jump
//   int zoneAfter[]                         zone of the table above the first i of them: one entry more

#ifndef TETRALUX_ISOSURFACE_SCALE
#define TETRALUX_ISOSURFACE_SCALE real(1.0)  // factor of the isosurfaces' depths
#endif
#ifndef TETRALUX_DISCONTINUITY_COUNT
#define TETRALUX_DISCONTINUITY_COUNT TETRALUX_DISCONTINUITIES
#endif

// 1 − exp(−depth), with the type's relative precision for thin segments too: many of them add up. The series errs by
// depth⁵/720 < 5e-10 of its value below 0.05.
TETRALUX_GLSL_FUNCTION real opacityOf(real depth) {
    real series = depth * (real(1.0) - depth * (real(0.5) - depth * (real(1.0 / 6.0) - depth * (real(1.0 / 24.0) - depth * real(1.0 / 120.0)))));
    return select(depth < real(0.05), series, real(1.0) - exp(-depth));
}

// A segment before silhouette and light.
struct Gathered {
    vec3 meanColor;       // C/α
    real meanExtinction;  // of the smooth functions, per unit of scalar or length
    real smoothDepth;     // optical depth of the smooth functions
    real otherDepth;      // optical depth of isosurfaces
};

TETRALUX_GLSL_FUNCTION real smoothDepthOf(real meanExtinction, real front, real back, real segmentLength) {
#if TETRALUX_SCALE_INVARIANT
    return meanExtinction * abs(front - back);
#else
    return meanExtinction * segmentLength;
#endif
}

TETRALUX_GLSL_FUNCTION Gathered gatherWithin(int zone, real front, real back, real segmentLength) {
    vec4 entry = tableEntry(zone, front, back, segmentLength);
    Gathered part;
    part.meanColor = vec3(entry.x, entry.y, entry.z);
    part.meanExtinction = entry.w;
    part.smoothDepth = smoothDepthOf(entry.w, front, back, segmentLength);
    part.otherDepth = real(0.0);
    return part;
}

#if TETRALUX_DISCONTINUITIES
// The discontinuities crossed are those with low < v ≤ high: (front < v) ≠ (back < v).
TETRALUX_GLSL_FUNCTION Gathered gatherSegment(real front, real back, real segmentLength) {
    real low = min(front, back);
    real high = max(front, back);
    int first = 0;
    int end = 0;
    for (int i = 0; i < TETRALUX_DISCONTINUITY_COUNT; ++i) {
        first += int(discontinuityValue[i] <= low);
        end += int(discontinuityValue[i] <= high);
    }
    if (first == end) return gatherWithin(zoneAfter[first], front, back, segmentLength);

    bool rising = front < back;
    int crossed = end - first;
    real lengthPerScalar = segmentLength / (high - low);
    vec3 color = vec3(real(0.0));
    vec3 thinColor = vec3(real(0.0));  // the limit of C for small depth
    real transparency = real(1.0);
    real smoothDepth = real(0.0);
    real otherDepth = real(0.0);
    real at = front;
    for (int n = 0; n <= crossed; ++n) {
        int next = select(rising, first + n, end - 1 - n);  // the discontinuity that ends this part, unless it is the last
        real to = back;
        if (n < crossed) to = discontinuityValue[next];
        Gathered part = gatherWithin(zoneAfter[select(rising, next, next + 1)], at, to, abs(to - at) * lengthPerScalar);
        real opacity = opacityOf(part.smoothDepth);
        color += transparency * opacity * part.meanColor;
        thinColor += part.smoothDepth * part.meanColor;
        transparency *= real(1.0) - opacity;
        smoothDepth += part.smoothDepth;
        if (n < crossed) {
            vec4 layer = discontinuityLayer[next];
            vec3 layerColor = vec3(layer.x, layer.y, layer.z);
            real layerDepth = layer.w * TETRALUX_ISOSURFACE_SCALE;
            opacity = opacityOf(layerDepth);
            color += transparency * opacity * layerColor;
            thinColor += layerDepth * layerColor;
            transparency *= real(1.0) - opacity;
            otherDepth += layerDepth;
        }
        at = to;
    }
    real depth = smoothDepth + otherDepth;
    Gathered sum;
    if (depth > real(1e-12)) {
        sum.meanColor = color / opacityOf(depth);
    } else {  // thinner than that, order within the segment does not show
        sum.meanColor = thinColor / max(depth, real(1e-36));
    }
    sum.meanExtinction = smoothDepth / (high - low);  // per unit of scalar: what the scale-invariant silhouette reads
    sum.smoothDepth = smoothDepth;
    sum.otherDepth = otherDepth;
    return sum;
}
#else
TETRALUX_GLSL_FUNCTION Gathered gatherSegment(real front, real back, real segmentLength) {
    return gatherWithin(0, front, back, segmentLength);
}
#endif
