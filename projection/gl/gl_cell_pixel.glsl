// SPDX-License-Identifier: Apache-2.0
//
// One pixel of one cell: cut the ray by the cell's planes (projection/cells/cell_interval.glsl), look up what light
// meets in between, shade it. The text of fragments (gl_cell.frag) and of compute tiles (gl_tile_draw.comp). The
// variants stand in projection/gl/gl_variants.glsl.

uniform vec2 centre;        // pixel coordinates of the optical axis

#if TETRALUX_LIMITS
// Inverse depth at which the volume begins and ends, factor of extinction, inverse depth at which the layer of a cut
// ends (projection/cells/ray_inverse_depth.h).
uniform sampler2D limits;
uniform sampler2D cutNormals;

float inverseDepthOfRay(CellRecord cell, float rayInverseDepth) {
#if TETRALUX_ORTHOGRAPHIC
    return (beyondReference(cell) + rayInverseDepth) / abs(cell.scale);
#else
    return (beyondReference(cell) + cell.scale * rayInverseDepth) / depthReference;
#endif
}
#endif

// inverseDepth where the ray enters (x) and leaves (y) the cell, at the sample dx, dy pixels beside the reference
// point. Nothing is inside where x ≤ y.
vec2 inverseDepthInterval(CellRecord cell, float dx, float dy) {
#if TETRALUX_ORTHOGRAPHIC
    float nearest = sign(cell.scale), farthest = -3e38;  // the eye's plane
#else
    float nearest = 1e30, farthest = -0.9999999;  // the eye; infinitely far
#endif
    for (int k = 0; k < 4; ++k) {
        float inverseDepth = planeInverseDepth(cell.plane[k].x, cell.plane[k].y, cell.plane[k].z, dx, dy);
        bool front = (cell.frontMask & (1 << k)) != 0;
        nearest = min(nearest, front ? inverseDepth : 3e38);
        farthest = max(farthest, front ? -3e38 : inverseDepth);
    }
    return vec2(nearest, farthest);
}

float scalarAtInverseDepth(CellRecord cell, float dx, float dy, float inverseDepth) {
#if TETRALUX_ORTHOGRAPHIC
    return scalarOrthographic(cell.scalar, cell.scalarPerX, cell.scalarPerY, cell.scalarPerInverseDepth, dx, dy, inverseDepth,
                              cell.scalarLow, cell.scalarHigh);
#else
    return scalarPerspective(cell.scalar, cell.scalarPerX, cell.scalarPerY, cell.scalarPerInverseDepth, dx, dy, inverseDepth,
                             cell.scalarLow, cell.scalarHigh);
#endif
}

#if !TETRALUX_ORTHOGRAPHIC
// |x·right + y·down|²
float squareAside(vec2 fromCentre) {
    vec2 aside = vec2(fromCentre.x + rowShape.x * fromCentre.y, rowShape.y * fromCentre.y);
    return dot(viewRight, viewRight) * dot(aside, aside);
}
#endif

#if TETRALUX_LENGTH
float segmentLength(CellRecord cell, vec2 inverseDepth, vec2 fromCentre) {
#if TETRALUX_ORTHOGRAPHIC
    return segmentLengthOrthographic(cell.scale, inverseDepth.x, inverseDepth.y);
#else
    float rayLength = sqrt(1.0 + squareAside(fromCentre));
    return segmentLengthPerspective(cell.scale, inverseDepth.x, inverseDepth.y, rayLength);
#endif
}
#endif

#if TETRALUX_MODE == TETRALUX_MODE_DEPTH || TETRALUX_DEPTH_COLOR
// Distance along the ray less depthReference, scene lengths.
float distanceBeyond(CellRecord cell, float inverseDepth, vec2 fromCentre) {
#if TETRALUX_ORTHOGRAPHIC
    return depthBeyond(cell, inverseDepth);
#else
    float square = squareAside(fromCentre), rayLength = sqrt(1.0 + square);
    return depthBeyond(cell, inverseDepth) * rayLength + depthReference * square / (1.0 + rayLength);
#endif
}
#endif

// What the segment of the cell between inverseDepth.x and inverseDepth.y adds to the pixel, premultiplied; false
// where it adds nothing. `cutNormal` is lit in the place of the field's where it is not zero.
bool drawSegment(CellRecord cell, vec2 pixel, float dx, float dy, vec2 inverseDepth, vec3 cutNormal, out vec4 result) {
    result = vec4(0.0);
    if (!(inverseDepth.x > inverseDepth.y)) return false;
    float front = scalarAtInverseDepth(cell, dx, dy, inverseDepth.x);
    float back = scalarAtInverseDepth(cell, dx, dy, inverseDepth.y);
    float len = 0.0;
#if TETRALUX_LENGTH
    len = segmentLength(cell, inverseDepth, pixel - centre);
#endif

#if TETRALUX_MODE == TETRALUX_MODE_MIP
    result = vec4(max(front, back));
#elif TETRALUX_MODE == TETRALUX_MODE_MINIMUM
    result = vec4(min(front, back));
#elif TETRALUX_MODE == TETRALUX_MODE_AVERAGE
    result = vec4(0.5 * (front + back) * len, len, 0.0, 0.0);
#elif TETRALUX_MODE == TETRALUX_MODE_DEPTH
    float step = firstShown(front, back);
    if (step > 1e30) return false;
    float along = front == back ? 0.0 : len * min(step / abs(back - front), 1.0);
    result = vec4(distanceBeyond(cell, inverseDepth.x, pixel - centre) + along, 0.0, 0.0, 1.0);
#else
    vec3 view = vec3(0.0);
    vec4 normalAndMagnitude = vec4(0.0);
#if TETRALUX_GRADIENT
    normalAndMagnitude = gradient;
    view = -viewForward;  // towards the eye
#if !TETRALUX_ORTHOGRAPHIC
    view = -normalize(viewForward + (pixel.x - centre.x) * viewRight + (pixel.y - centre.y) * viewDown);
#endif
#endif
#if TETRALUX_FULL_LIGHT || TETRALUX_ATTRIBUTES
    setMiddle(cell, inverseDepth, dx, dy, pixel - centre);
#endif
    float across = 0.0;
#if !TETRALUX_ORTHOGRAPHIC
    across = cell.scalarPerX * dx + cell.scalarPerY * dy;
#endif
    float side = sign(scalarFall(across, cell.scalarPerInverseDepth));
#if TETRALUX_DEPTH_COLOR
    float middle = 0.5 * (distanceBeyond(cell, inverseDepth.x, pixel - centre) + distanceBeyond(cell, inverseDepth.y, pixel - centre));
    depthShare = depthColor.a * clamp(depthRange.x + depthRange.y * middle, 0.0, 1.0);
#endif
#if TETRALUX_SURFACE_SHADOWS
    segmentScalars = vec4(front, back, cell.scalarLow, cell.scalarHigh);
    fieldNormal = gradient.xyz;
#endif
    vec4 perOpacity = shadedSegment(front, back, len, side, view, normalAndMagnitude, cutNormal);
#if TETRALUX_MODE == TETRALUX_MODE_FIRST_HIT
    // what gradient opacity or vertices leave nothing of is not met either
    if (!(perOpacity.a > 0.0) || !meetsOpacity(front, back)) return false;
#if !TETRALUX_ORTHOGRAPHIC
    // an eye on a vertex or an edge: that a cell ends right there is for rounding to say
    const float atEye = 1e6, faint = 1e-4;
    if (inverseDepth.y > atEye && perOpacity.a < faint) return false;
#endif
    result = vec4(perOpacity.rgb, 1.0);
#elif TETRALUX_MODE == TETRALUX_MODE_ABSORPTION
    result = vec4(perOpacity.a, 0.0, 0.0, 0.0);
#else
    result = vec4(perOpacity.rgb * perOpacity.a, perOpacity.a);
#endif
#endif
    return true;
}

#if TETRALUX_CUT_LAYERS
// Puts what a ray meets next under what it has met.
void putBehind(bool shown, vec4 behind, inout bool anything, inout vec4 result) {
    if (!shown) return;
#if TETRALUX_MODE == TETRALUX_MODE_FIRST_HIT
    if (!anything) result = behind;
#elif TETRALUX_MODE == TETRALUX_MODE_ADDITIVE
    result += behind;
#else
    result += (1.0 - result.a) * behind;
#endif
    anything = true;
}
#endif

// What the cell adds to the pixel at these whole numbers, premultiplied; false where it adds nothing.
bool drawPixel(CellRecord cell, ivec2 place, out vec4 result) {
    vec2 pixel = vec2(place);
    float dx = (pixel.x - cell.pixel.x) - cell.fraction.x;
    float dy = (pixel.y - cell.pixel.y) - cell.fraction.y;
    vec2 inverseDepth = inverseDepthInterval(cell, dx, dy);
#if TETRALUX_LIMITS
    vec4 limit = texelFetch(limits, place, 0);
    inverseDepth = vec2(min(inverseDepth.x, inverseDepthOfRay(cell, limit.x)), max(inverseDepth.y, inverseDepthOfRay(cell, limit.y)));
    isosurfaceScale = limit.z;
#endif
#if TETRALUX_CUT_LAYERS
    float layerEnd = inverseDepthOfRay(cell, limit.w);
    bool anything = false;
    result = vec4(0.0);
    for (int part = 0; part < 2; ++part) {
        bool layer = part == 0;
        vec2 within = layer ? vec2(inverseDepth.x, max(inverseDepth.y, layerEnd)) : vec2(min(inverseDepth.x, layerEnd), inverseDepth.y);
        if (!(within.x > within.y)) continue;
        vec4 segment;
        bool shown = drawSegment(cell, pixel, dx, dy, within, layer ? texelFetch(cutNormals, place, 0).xyz : vec3(0.0), segment);
        putBehind(shown, segment, anything, result);
    }
    return anything;
#else
    return drawSegment(cell, pixel, dx, dy, inverseDepth, vec3(0.0), result);
#endif
}
