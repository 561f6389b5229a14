// SPDX-License-Identifier: Apache-2.0
//
// A corner of a cell's outline. The record passes through flat: only a triangle's first vertex carries one that means
// something (gl_cell_stream.h).
layout(location = 0) in vec2 corner;  // pixels, whole numbers are pixel centres
layout(location = 1) in vec4 record0;
layout(location = 2) in vec4 record1;
layout(location = 3) in vec4 record2;
layout(location = 4) in vec4 record3;
layout(location = 5) in vec4 record4;
layout(location = 6) in vec4 record5;
#if TETRALUX_GRADIENT
layout(location = 7) in vec4 cellGradient;
#endif
#if TETRALUX_ATTRIBUTES
layout(location = 8) in vec4 cellEyeWeight;
layout(location = 9) in uvec4 cellPoints;
flat out vec4 eyeWeight;
flat out uvec4 points;
#endif

flat out vec4 cell0, cell1, cell2, cell3, cell4, cell5;
#if TETRALUX_GRADIENT
flat out vec4 gradient;
#endif

uniform vec2 ndcPerPixel;  // 2/size of the image

void main() {
    // Row 0 of the framebuffer is the image's top row, so that reading back needs no flip.
    gl_Position = vec4((corner + 0.5) * ndcPerPixel - 1.0, 0.0, 1.0);
    cell0 = record0;
    cell1 = record1;
    cell2 = record2;
    cell3 = record3;
    cell4 = record4;
    cell5 = record5;
#if TETRALUX_GRADIENT
    gradient = cellGradient;
#endif
#if TETRALUX_ATTRIBUTES
    eyeWeight = cellEyeWeight;
    points = cellPoints;
#endif
}
