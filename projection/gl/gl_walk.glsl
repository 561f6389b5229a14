// SPDX-License-Identifier: Apache-2.0
//
// Stands in for a table that misses the error that was asked for (preint/table_lookup.glsl): the same answer, found
// by walking along the pieces between a transfer function's nodes. Rough functions need it, of which neighbouring
// texels know nothing of each other.
//
//   tableTexels    a column per piece: (low, high, extinction at low, at high), colour at low, colour at high; scalars ascend
//   zonePiece[]    the first piece of each zone, and how many there are

#if TETRALUX_DISCONTINUITIES
uniform float discontinuityValue[TETRALUX_DISCONTINUITIES];  // see preint/gather_segment.glsl
uniform vec4 discontinuityLayer[TETRALUX_DISCONTINUITIES];
uniform int zoneAfter[TETRALUX_DISCONTINUITIES + 1];
uniform int zonePiece[TETRALUX_ZONES + 1];
#else
const int zonePiece[2] = int[2](0, TETRALUX_WALK);
#endif
uniform sampler2D tableTexels;

int pieceAt(int zone, float scalar) {
    int low = zonePiece[zone], high = zonePiece[zone + 1] - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (texelFetch(tableTexels, ivec2(middle, 0), 0).x <= scalar)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

struct Walk {
    vec3 color, thinColor;  // of what is seen; of all, as if nothing hid anything
    float opacity, through, meanExtinction;
};

// A run of lines, of (colour, extinction) from `front` to `back`, which is `share` of a segment whose depth is
// extinction times `path`: in steps of at most half an optical depth, by Gauss's rule of three points, which errs by
// less than 1e-6 there.
void addRun(TETRALUX_GLSL_INOUT(Walk) walk, vec4 front, vec4 back, float share, float path) {
    const vec3 places = vec3(0.1127016654, 0.5, 0.8872983346), weights = vec3(5.0, 8.0, 5.0) / 18.0;
    vec4 rise = back - front;
    walk.meanExtinction += share * (front.w + 0.5 * rise.w);
    for (int k = 0; k < 3; ++k) {
        vec4 value = front + places[k] * rise;
        walk.thinColor += share * weights[k] * value.w * value.rgb;
    }
    float way = share * path, done = 0.0;
    for (int steps = 0; done < 1.0 && walk.through > 1e-8 && steps < 64; ++steps) {
        float depth = way * (front.w + done * rise.w), slope = way * rise.w, square = depth * depth + slope;
        float taken = 1.0 - done;
        if (square > 0.0) taken = min(taken, 1.0 / max(depth + sqrt(square), 1e-30));
        float stepDepth = taken * (depth + 0.5 * taken * slope), seen = 0.0;
        vec3 color = vec3(0.0);
        for (int k = 0; k < 3; ++k) {
            float at = places[k] * taken;
            vec4 value = front + (done + at) * rise;
            float source = weights[k] * value.w * exp(-at * (depth + 0.5 * at * slope));
            seen += source;
            color += source * value.rgb;
        }
        float opacity = walk.through * (1.0 - exp(-stepDepth));
        if (stepDepth < 0.05) opacity = walk.through * stepDepth * (1.0 - stepDepth * (0.5 - stepDepth * (1.0 / 6.0 - stepDepth / 24.0)));
        walk.color += color * (opacity / max(seen, 1e-36));
        walk.opacity += opacity;
        walk.through -= opacity;
        done = taken < 1.0 - done ? done + taken : 1.0;
    }
}

// See preint/table_lookup.glsl.
vec4 tableEntry(int zone, float front, float back, float segmentLength) {
    float zoneLow = texelFetch(tableTexels, ivec2(zonePiece[zone], 0), 0).x;
    float zoneHigh = texelFetch(tableTexels, ivec2(zonePiece[zone + 1] - 1, 0), 0).y;
    front = clamp(front, zoneLow, zoneHigh);
    back = clamp(back, zoneLow, zoneHigh);
    float way = abs(back - front);
#if TETRALUX_SCALE_INVARIANT
    float path = way;
#else
    float path = segmentLength;
#endif
    Walk walk = Walk(vec3(0.0), vec3(0.0), 0.0, 1.0, 0.0);
    int last = pieceAt(zone, back), onward = front <= back ? 1 : -1;
    for (int piece = pieceAt(zone, front);; piece += onward) {
        vec4 range = texelFetch(tableTexels, ivec2(piece, 0), 0);
        vec4 low = vec4(texelFetch(tableTexels, ivec2(piece, 1), 0).rgb, range.z);
        vec4 high = vec4(texelFetch(tableTexels, ivec2(piece, 2), 0).rgb, range.w);
        float perScalar = 1.0 / (range.y - range.x);
        float begin = clamp(front, range.x, range.y), end = clamp(back, range.x, range.y);
        float share = way > 0.0 ? abs(end - begin) / way : 1.0;
        addRun(walk, mix(low, high, (begin - range.x) * perScalar), mix(low, high, (end - range.x) * perScalar), share, path);
        if (piece == last) break;
    }
    vec3 color = walk.opacity > 1e-30 ? walk.color / walk.opacity : walk.thinColor / max(walk.meanExtinction, 1e-36);
    return vec4(color, walk.meanExtinction);
}
