// SPDX-License-Identifier: Apache-2.0
//
// One pixel of one cell: cut the ray by the cell's planes (projection/cell_interval.glsl), look up what light meets in between, shade it.
// Written back to front over what lies behind, premultiplied.
//
// Variants (0 or 1 unless said otherwise): TETRALUX_ORTHOGRAPHIC, TETRALUX_MODE (one of the numbers below), TETRALUX_SCALE_INVARIANT,
// TETRALUX_INTERFACES (how many), TETRALUX_SUPPORTS (how many), TETRALUX_SILHOUETTE, TETRALUX_LIGHTS (how many), TETRALUX_GRADIENT (silhouette or
// lights), TETRALUX_FULL_LIGHT (anything but the plain lights of shading/cell_shading.glsl), TETRALUX_ATTRIBUTES (vertices have some),
// TETRALUX_LENGTH (whether anything reads the segment's length).
#define TETRALUX_MODE_VOLUME 0
#define TETRALUX_MODE_MIP 1
#define TETRALUX_MODE_AVERAGE 2
#define TETRALUX_MODE_FIRST_HIT 3

flat in vec4 cell0, cell1, cell2, cell3, cell4, cell5;
#if TETRALUX_GRADIENT
flat in vec4 gradient;  // unit normal, magnitude in scene units
#endif
layout(location = 0) out vec4 result;

uniform vec2 centre;        // pixel coordinates of the optical axis

// rho where the ray enters (x) and leaves (y) the cell, at the sample dx, dy pixels beside the reference point. Nothing is inside
// where x ≤ y.
vec2 rhoInterval(CellRecord cell, float dx, float dy) {
#if TETRALUX_ORTHOGRAPHIC
    float nearest = sign(cell.scale), farthest = -3e38;  // the eye's plane
#else
    float nearest = 1e30, farthest = -0.9999999;  // the eye; infinitely far
#endif
    for (int k = 0; k < 4; ++k) {
        float rho = planeRho(cell.plane[k].x, cell.plane[k].y, cell.plane[k].z, dx, dy);
        bool front = (cell.frontMask & (1 << k)) != 0;
        nearest = min(nearest, front ? rho : 3e38);
        farthest = max(farthest, front ? -3e38 : rho);
    }
    return vec2(nearest, farthest);
}

float scalarAtRho(CellRecord cell, float dx, float dy, float rho) {
#if TETRALUX_ORTHOGRAPHIC
    return scalarOrthographic(cell.scalar, cell.scalarPerX, cell.scalarPerY, cell.scalarPerRho, dx, dy, rho,
                              cell.scalarLow, cell.scalarHigh);
#else
    return scalarPerspective(cell.scalar, cell.scalarPerX, cell.scalarPerY, cell.scalarPerRho, dx, dy, rho,
                             cell.scalarLow, cell.scalarHigh);
#endif
}

#if TETRALUX_LENGTH
float segmentLength(CellRecord cell, vec2 rho, vec2 fromCentre) {
#if TETRALUX_ORTHOGRAPHIC
    return segmentLengthOrthographic(cell.scale, rho.x, rho.y);
#else
    // |forward + x·right + y·down|, whose three vectors are orthogonal
    float rayLength = sqrt(1.0 + dot(viewRight, viewRight) * dot(fromCentre, fromCentre));
    return segmentLengthPerspective(cell.scale, rho.x, rho.y, rayLength);
#endif
}
#endif

void main() {
    CellRecord cell = unpackRecord(cell0, cell1, cell2, cell3, cell4, cell5);
    vec2 pixel = gl_FragCoord.xy - 0.5;
    float dx = (pixel.x - cell.pixel.x) - cell.fraction.x;
    float dy = (pixel.y - cell.pixel.y) - cell.fraction.y;
    vec2 rho = rhoInterval(cell, dx, dy);
    if (!(rho.x > rho.y)) discard;
    float front = scalarAtRho(cell, dx, dy, rho.x);
    float back = scalarAtRho(cell, dx, dy, rho.y);
    float len = 0.0;
#if TETRALUX_LENGTH
    len = segmentLength(cell, rho, pixel - centre);
#endif

#if TETRALUX_MODE == TETRALUX_MODE_MIP
    result = vec4(max(front, back));
#elif TETRALUX_MODE == TETRALUX_MODE_AVERAGE
    result = vec4(0.5 * (front + back) * len, len, 0.0, 0.0);
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
#if TETRALUX_FULL_LIGHT
    setMiddle(cell, rho, dx, dy, pixel - centre);
#endif
    float across = 0.0;
#if !TETRALUX_ORTHOGRAPHIC
    across = cell.scalarPerX * dx + cell.scalarPerY * dy;
#endif
    float side = sign(scalarFall(across, cell.scalarPerRho));
    vec4 perOpacity = shadedSegment(front, back, len, side, view, normalAndMagnitude);
#if TETRALUX_MODE == TETRALUX_MODE_FIRST_HIT
    if (!segmentShows(front, back)) discard;
    result = vec4(perOpacity.rgb, 1.0);
#else
    result = vec4(perOpacity.rgb * perOpacity.a, perOpacity.a);
#endif
#endif
}
