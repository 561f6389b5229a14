// SPDX-License-Identifier: Apache-2.0
//
// What a segment shows in the modes and classifications that do not integrate it front to back. Scalars and lengths in scene units;
// `path` is what extinction is per unit of. Needs preint/gather_segment.glsl.

#if TETRALUX_SUPPORTS
uniform vec3 support[TETRALUX_SUPPORTS];  // ShownScalars (projection/core/transfer_support.h): low, high, whether low shows
#endif

// Post-classification (Kraus 2005, Equations 10 and 11): the sample in the middle stands for the segment. On the table's diagonal
// stand colour and extinction themselves. Pre-classification takes those of the vertices, interpolated.
Gathered sampledSegment(float front, float back, float path) {
#if TETRALUX_SAMPLE_AT >= 0
    float extinction = attributeAt(TETRALUX_SAMPLE_AT + 3);
    return Gathered(vectorAt(TETRALUX_SAMPLE_AT), extinction, extinction * path, 0.0);
#else
    float s = 0.5 * (front + back);
    int zone = 0;
#if TETRALUX_INTERFACES
    int below = 0;
    for (int i = 0; i < TETRALUX_INTERFACES; ++i) below += int(interfaceValue[i] <= s);
    zone = zoneAfter[below];
#endif
    vec4 entry = tableEntry(zone, s, s, 0.0);
    return Gathered(entry.rgb, entry.w, entry.w * path, 0.0);
#endif
}

#if TETRALUX_MODE == TETRALUX_MODE_ADDITIVE
// ∫ c τ over the path, nothing hidden: colour per depth, where the depth of an isosurface is its opacity. The table's first slice holds
// the mean colour of thin segments.
Gathered emittedSegment(float front, float back, float path) {
    Gathered sum = Gathered(vec3(0.0), 0.0, 0.0, 0.0);
#if TETRALUX_INTERFACES
    float low = min(front, back), high = max(front, back);
    int first = 0, end = 0;
    for (int i = 0; i < TETRALUX_INTERFACES; ++i) {
        first += int(interfaceValue[i] <= low);
        end += int(interfaceValue[i] <= high);
    }
    int crossed = end - first;
    bool rising = front < back;
    float at = front;
    for (int n = 0; n <= crossed; ++n) {
        int next = select(rising, first + n, end - 1 - n);
        float to = n < crossed ? interfaceValue[next] : back;
        int zone = zoneAfter[crossed == 0 ? first : select(rising, next, next + 1)];
        vec4 entry = tableEntry(zone, at, to, 0.0);
        float depth = entry.w * (crossed == 0 ? path : path * abs(to - at) / (high - low));
        sum.meanColor += depth * entry.rgb;
        sum.smoothDepth += depth;
        if (n < crossed) {
            float opacity = opacityOf(interfaceLayer[next].w * interfaceScale);
            sum.meanColor += opacity * interfaceLayer[next].rgb;
            sum.otherDepth += opacity;
        }
        at = to;
    }
#else
    vec4 entry = tableEntry(0, front, back, 0.0);
    sum.smoothDepth = entry.w * path;
    sum.meanColor = sum.smoothDepth * entry.rgb;
#endif
    sum.meanColor /= max(sum.smoothDepth + sum.otherDepth, 1e-36);
    return sum;
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
#if TETRALUX_INTERFACES
    for (int i = 0; i < TETRALUX_INTERFACES; ++i) {
        bool crossed = crossesValue(front, back, interfaceValue[i]);
        if (interfaceLayer[i].w > 0.0 && crossed) nearest = min(nearest, abs(interfaceValue[i] - front));
    }
#endif
    return nearest;
}
#endif
