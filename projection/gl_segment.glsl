// SPDX-License-Identifier: Apache-2.0
//
// A gathered segment (preint/gather_segment.glsl) with silhouette and light. Scalars and lengths in scene units (projection/cell_setup.h).

#if TETRALUX_SUPPORTS
uniform vec2 support[TETRALUX_SUPPORTS];  // scalars with extinction
#endif
#if TETRALUX_LIGHTS && !TETRALUX_FULL_LIGHT
uniform vec3 lights[TETRALUX_LIGHTS];     // towards each, unit, world space
uniform float ambient, exponent, transmission;
#endif

// Whether α > 0. The table, which interpolates, cannot tell: it blurs the ends of the support.
bool segmentShows(float front, float back) {
    float low = min(front, back), high = max(front, back);
    bool shows = false;
#if TETRALUX_SUPPORTS
    for (int i = 0; i < TETRALUX_SUPPORTS; ++i) {
        shows = shows || (high > support[i].x && low < support[i].y);
    }
#endif
#if TETRALUX_INTERFACES
    for (int i = 0; i < TETRALUX_INTERFACES; ++i) {
        shows = shows || (interfaceLayer[i].w > 0.0 && low < interfaceValue[i] && interfaceValue[i] <= high);
    }
#endif
    return shows;
}

// Colour per α and α of a segment in view direction `view` (unit, towards the eye); `gradient` is the unit normal and
// |g|, both zero where the scalar is constant; `side` the sign of s_f − s_b.
vec4 shadedSegment(float front, float back, float len, float side, vec3 view, vec4 gradient) {
    Gathered segment = gatherSegment(front, back, len);
    float depth = segment.smoothDepth + segment.otherDepth;
#if TETRALUX_SILHOUETTE
    float cosine = dot(gradient.xyz, view);
#if TETRALUX_SCALE_INVARIANT
    float sharpened = silhouetteDepth(segment.meanExtinction * gradient.w * len, segment.otherDepth, cosine);
#else
    float sharpened = silhouetteDepth(0.0, depth, cosine);
#endif
    depth = gradient.w > 0.0 ? sharpened : depth;
#endif
    float opacity = opacityOf(depth);
    vec3 color = segment.meanColor;
#if TETRALUX_FULL_LIGHT
    color = lightInFull(segment.meanColor, opacity, side, view, gradient);
#elif TETRALUX_LIGHTS
    color *= ambient;
    if (gradient.w > 0.0) {
        float transmitted = transmission * (1.0 - opacity);
        for (int i = 0; i < TETRALUX_LIGHTS; ++i) {
            color += lightTerm(segment.meanColor, gradient.xyz, view, lights[i], side, transmitted, exponent);
        }
    }
#endif
    return vec4(color, opacity);
}
