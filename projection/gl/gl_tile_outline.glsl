// SPDX-License-Identifier: Apache-2.0
//
// Which pixels a cell's outline (gl_cell_buffer.h; counter-clockwise) may hold: exact but for `slack`, on the side of
// too many. Outlines reach 4,096 pixels beyond the image, where float is good for 1e-3.
const float slack = 0.05;  // pixels

struct Outline {
    vec2 corner[4];
};

// Whether the outline may hold a pixel centre of the box low … high.
bool mayHold(Outline outline, vec2 low, vec2 high) {
    vec2 least = min(min(outline.corner[0], outline.corner[1]), min(outline.corner[2], outline.corner[3]));
    vec2 most = max(max(outline.corner[0], outline.corner[1]), max(outline.corner[2], outline.corner[3]));
    bool held = all(lessThanEqual(least - slack, high)) && all(greaterThanEqual(most + slack, low));
    for (int k = 0; k < 4; ++k) {
        vec2 edge = outline.corner[(k + 1) % 4] - outline.corner[k];
        vec2 inmost = vec2(edge.y > 0.0 ? low.x : high.x, edge.x > 0.0 ? high.y : low.y) - outline.corner[k];
        held = held && edge.x * inmost.y - edge.y * inmost.x >= -slack * (abs(edge.x) + abs(edge.y));
    }
    return held;
}
