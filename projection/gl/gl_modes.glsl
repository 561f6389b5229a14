// SPDX-License-Identifier: Apache-2.0
//
// What a segment shows in the modes and classifications that do not integrate it front to back. Scalars and lengths
// in scene units; `path` is what extinction is per unit of. Needs preint/gather_segment.glsl.

#if TETRALUX_SUPPORTS
uniform vec3 support[TETRALUX_SUPPORTS];  // ShownScalars (projection/core/transfer_support.h): low, high, whether low shows
#endif

// Post-classification (Kraus 2005, Equations 10 and 11): the sample in the middle stands for the segment. On the
// table's diagonal stand colour and extinction themselves. Pre-classification takes those of the vertices,
// interpolated.
Gathered sampledSegment(float front, float back, float path) {
#if TETRALUX_SAMPLE_AT >= 0
    float extinction = attributeAt(TETRALUX_SAMPLE_AT + 3);
    return Gathered(vectorAt(TETRALUX_SAMPLE_AT), extinction, extinction * path, 0.0);
#else
    float s = 0.5 * (front + back);
    int zone = 0;
#if TETRALUX_DISCONTINUITIES
    int below = 0;
    for (int i = 0; i < TETRALUX_DISCONTINUITIES; ++i) below += int(discontinuityValue[i] <= s);
    zone = zoneAfter[below];
#endif
    vec4 entry = tableEntry(zone, s, s, 0.0);
    return Gathered(entry.rgb, entry.w, entry.w * path, 0.0);
#endif
}

#if TETRALUX_MODE == TETRALUX_MODE_ADDITIVE || TETRALUX_PER_CELL
// What a segment shows where nothing within it is hidden: ∫ c τ and ∫ τ over the path, and the isosurfaces that it
// crosses. The table's first slice holds the mean colour of thin segments.
struct Emitted {
    vec3 smoothColor, layerColor;  // times depth, times weight
    float smoothDepth, layerWeight;
};

// Part of a segment within one zone. What is relevant has extinction 1 where cells count: less is rounding.
void addEmitted(int zone, float front, float back, float path, inout Emitted sum) {
    vec4 entry = tableEntry(zone, front, back, 0.0);
#if TETRALUX_PER_CELL
    float depth = entry.w > 0.5 ? path : 0.0;
#else
    float depth = entry.w * path;
#endif
    sum.smoothColor += depth * entry.rgb;
    sum.smoothDepth += depth;
}

Emitted emittedSegment(float front, float back, float path) {
    Emitted sum = Emitted(vec3(0.0), vec3(0.0), 0.0, 0.0);
#if TETRALUX_DISCONTINUITIES
    float low = min(front, back), high = max(front, back);
    int first = 0, end = 0;
    for (int i = 0; i < TETRALUX_DISCONTINUITIES; ++i) {
        first += int(discontinuityValue[i] <= low);
        end += int(discontinuityValue[i] <= high);
    }
    int crossed = end - first;
    bool rising = front < back;
    float at = front;
    for (int n = 0; n <= crossed; ++n) {
        int next = select(rising, first + n, end - 1 - n);
        float to = n < crossed ? discontinuityValue[next] : back;
        int zone = zoneAfter[crossed == 0 ? first : select(rising, next, next + 1)];
        addEmitted(zone, at, to, crossed == 0 ? path : path * abs(to - at) / (high - low), sum);
        if (n < crossed) {
            vec4 layer = discontinuityLayer[next];
#if TETRALUX_PER_CELL
            float weight = layer.w > 0.0 ? 1.0 : 0.0;
#else
            float weight = opacityOf(layer.w * isosurfaceScale);
#endif
            sum.layerColor += weight * layer.rgb;
            sum.layerWeight += weight;
        }
        at = to;
    }
#else
    addEmitted(0, front, back, path, sum);
#endif
    return sum;
}
#endif

#if TETRALUX_PER_CELL
// ContributionWeights::perCell: one contribution for what shows, one for each isosurface, in their mean colour.
Gathered contributionsOf(float front, float back, float path) {
#if TETRALUX_SAMPLED
    Gathered taken = sampledSegment(front, back, path);
    return Gathered(taken.meanColor, 0.0, 0.0, path > 0.0 && taken.meanExtinction > 0.5 ? isosurfaceScale : 0.0);
#else
    Emitted shown = emittedSegment(front, back, path);
    vec3 color = shown.layerColor;
    float count = shown.layerWeight;
    if (shown.smoothDepth > 0.0) {
        color += shown.smoothColor / shown.smoothDepth;
        count += 1.0;
    }
    return Gathered(color / max(count, 1.0), 0.0, 0.0, count * isosurfaceScale);
#endif
}
#elif TETRALUX_MODE == TETRALUX_MODE_ADDITIVE && !TETRALUX_SAMPLED
// Colour per depth, where the depth of an isosurface is its opacity.
Gathered emittedMean(float front, float back, float path) {
    Emitted shown = emittedSegment(front, back, path);
    vec3 color = (shown.smoothColor + shown.layerColor) / max(shown.smoothDepth + shown.layerWeight, 1e-36);
    return Gathered(color, 0.0, shown.smoothDepth, shown.layerWeight);
}
#endif

#if TETRALUX_MODE == TETRALUX_MODE_DEPTH
// How far from `front` (in scalar) something first shows; above 1e30 where nothing does.
float firstShown(float front, float back) {
    float nearest = 3e38;
#if TETRALUX_SUPPORTS
    for (int i = 0; i < TETRALUX_SUPPORTS; ++i) {
        float begin = clamp(front, support[i].x, support[i].y), end = clamp(back, support[i].x, support[i].y);
        bool constant = front == back && showsBetween(front, back, support[i].x, support[i].y, support[i].z > 0.0);
        if (begin != end || constant) nearest = min(nearest, abs(begin - front));
    }
#endif
#if TETRALUX_DISCONTINUITIES
    for (int i = 0; i < TETRALUX_DISCONTINUITIES; ++i) {
        bool crossed = crossesValue(front, back, discontinuityValue[i]);
        if (discontinuityLayer[i].w > 0.0 && crossed) nearest = min(nearest, abs(discontinuityValue[i] - front));
    }
#endif
    return nearest;
}
#endif
