// SPDX-License-Identifier: Apache-2.0
//
// A gathered segment (preint/gather_segment.glsl) with silhouette and light. Scalars and lengths in scene units
// (projection/cells/cell_setup.h).

#if TETRALUX_GRADIENT_OPACITY
uniform float gradientOpacity;
#endif
#if TETRALUX_LIGHTS && !TETRALUX_FULL_LIGHT
uniform vec3 lights[TETRALUX_LIGHTS];     // towards each, unit, world space
uniform float ambient, exponent, transmission;
#endif

// Whether the segment meets anything with opacity. A table, which interpolates, cannot tell: it blurs the ends of the
// support. A sample meets what stands at the segment's middle; with pre-classification scalars say nothing of it.
bool meetsOpacity(float front, float back) {
#if TETRALUX_SAMPLED && TETRALUX_SAMPLE_AT >= 0
    return true;
#endif
    float low = min(front, back), high = max(front, back);
#if TETRALUX_SAMPLED
    low = high = 0.5 * (front + back);
#endif
    bool shows = false;
#if TETRALUX_SUPPORTS
    for (int i = 0; i < TETRALUX_SUPPORTS; ++i) {
        shows = shows || showsBetween(low, high, support[i].x, support[i].y, support[i].z > 0.0);
    }
#endif
#if TETRALUX_DISCONTINUITIES
    for (int i = 0; i < TETRALUX_DISCONTINUITIES; ++i) {
        shows = shows || (discontinuityLayer[i].w > 0.0 && crossesValue(low, high, discontinuityValue[i]));
    }
#endif
    return shows;
}

#if TETRALUX_DEPTH_COLOR
uniform vec4 depthColor;  // colour and strength
uniform vec2 depthRange;  // share of the way to the far end: at distance 0, per scene length
float depthShare;         // how much of depthColor the segment takes
#endif

#if TETRALUX_SURFACE_SHADOWS
vec4 segmentScalars;  // at the segment's ends, least and largest of its cell
vec3 fieldNormal;     // unit

// What the isosurfaces of the segment's cell leave of light that comes from `towards`.
float surfaceShadows(vec3 towards) {
    float through = 1.0, rise = dot(fieldNormal, towards);
#if TETRALUX_DISCONTINUITIES
    for (int i = 0; i < TETRALUX_DISCONTINUITIES; ++i) {
        through *= surfaceShadow(discontinuityValue[i], opacityOf(discontinuityLayer[i].w), segmentScalars.x, segmentScalars.y, segmentScalars.z,
                                 segmentScalars.w, rise);
    }
#endif
    return through;
}
#endif

// The scale-invariant path, not quite 0 along a level set where silhouettes multiply it by as much as it lacks.
float dataPath(float front, float back) {
#if TETRALUX_SILHOUETTE
    return max(abs(front - back), 1e-18);
#else
    return abs(front - back);
#endif
}

// Colour per α and α of a segment in view direction `view` (unit, towards the eye); `gradient` is the unit normal and
// |g|, both zero where the scalar is constant; `fallSide` the sign of
// s_f − s_b. `cutNormal` is lit where it is not zero. In modes that hide nothing depth stands
// in α's place.
vec4 shadedSegment(float front, float back, float len, float fallSide, vec3 view, vec4 gradient, vec3 cutNormal) {
    float path = len;
#if TETRALUX_DATA_SPACE && !TETRALUX_SCALE_INVARIANT
    path = dataPath(front, back);  // looked up as a length, so that it can be scaled
#endif
    path *= isosurfaceScale;
#if TETRALUX_PER_CELL
    Gathered segment = contributionsOf(front, back, TETRALUX_DATA_SPACE != 0 ? abs(front - back) : len);
#elif TETRALUX_SAMPLED
    Gathered segment = sampledSegment(front, back, TETRALUX_DATA_SPACE != 0 ? dataPath(front, back) * isosurfaceScale : path);
#elif TETRALUX_MODE == TETRALUX_MODE_ADDITIVE
    Gathered segment = emittedMean(front, back, path);
#else
    Gathered segment = gatherSegment(front, back, path);
#endif
    float depth = segment.smoothDepth + segment.otherDepth;
    float plain = depth;
#if TETRALUX_SILHOUETTE
#if TETRALUX_SMOOTH_SILHOUETTE
    vec4 slope = smoothNormal();
    float cosine = slope.w > 0.0 ? dot(slope.xyz, view) : 1.0;
#else
    vec4 slope = gradient;
    float cosine = dot(slope.xyz, view);
#endif
#if TETRALUX_DATA_SPACE
#if TETRALUX_SCALE_INVARIANT
    float perScalar = segment.meanExtinction;
#else
    float perScalar = segment.smoothDepth / dataPath(front, back);
#endif
    float sharpened = silhouetteDepth(perScalar * slope.w * len, segment.otherDepth, cosine);
#else
    float sharpened = silhouetteDepth(0.0, depth, cosine);
#endif
    depth = gradient.w > 0.0 || TETRALUX_SMOOTH_SILHOUETTE != 0 ? sharpened : depth;
#endif
#if TETRALUX_GRADIENT_OPACITY
    float byGradient = gradientOpacity * gradient.w;  // Levoy's, ShadingSettings::gradientOpacity
    depth *= byGradient;
    plain *= byGradient;
#endif
#if TETRALUX_LINEAR_OPACITY
    float linearFactor = linearDepthFactor(plain);
    depth *= linearFactor;
    plain *= linearFactor;
#endif
    float opacity = opacityOf(depth);
#if TETRALUX_APPROXIMATE_SILHOUETTE
    if (gradient.w > 0.0 || TETRALUX_SMOOTH_SILHOUETTE != 0) opacity = approximateSilhouetteOpacity(opacityOf(plain), plain, depth);
#endif
#if TETRALUX_SILHOUETTE && !TETRALUX_SMOOTH_SILHOUETTE && !TETRALUX_DATA_SPACE && TETRALUX_MODE != TETRALUX_MODE_FIRST_HIT
    // Floats hold the cosine n·d to some 2e-7. Where they do not hold what silhouettes make of it to 1e-4 the pixel
    // is no number, and is composed again in double (exact_repair.h).
    float change = depth * 2e-7 / max(abs(cosine), 1e-30);
#if TETRALUX_MODE == TETRALUX_MODE_ADDITIVE
    change /= max(depth, 1.0);
#else
    change *= exp(-min(depth, 80.0));
#endif
    if (abs(cosine) < 2e-3 && change > 1e-4 && gradient.w > 0.0) return vec4(uintBitsToFloat(0x7fc00000u));
#endif
    vec3 color = segment.meanColor;
#if TETRALUX_LIGHTS
    bool cut = dot(cutNormal, cutNormal) > 0.5;
    vec3 normal = cut ? cutNormal : gradient.xyz;
    float side = cut ? 1.0 : fallSide;
#endif
#if TETRALUX_FULL_LIGHT
    color = lightInFull(segment.meanColor, opacity, side, view, cut ? vec4(normal, 1.0) : gradient, cut);
#elif TETRALUX_LIGHTS
    color *= ambient;
    if (gradient.w > 0.0 || cut) {
        float transmitted = transmission * (1.0 - opacity);
        for (int i = 0; i < TETRALUX_LIGHTS; ++i) {
            color += lightTerm(segment.meanColor, normal, view, lights[i], side, transmitted, exponent);
        }
    }
#endif
#if TETRALUX_DEPTH_COLOR
    color = mix(color, depthColor.rgb, depthShare);
#endif
#if TETRALUX_MODE == TETRALUX_MODE_ADDITIVE || TETRALUX_MODE == TETRALUX_MODE_ABSORPTION
    return vec4(color, depth);
#else
    return vec4(color, opacity);
#endif
}
