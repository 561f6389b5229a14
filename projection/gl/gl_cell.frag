// SPDX-License-Identifier: Apache-2.0
//
// A fragment of a cell (gl_cell_pixel.glsl), written back to front over what lies behind.

flat in vec4 cell0, cell1, cell2, cell3, cell4, cell5;
layout(location = 0) out vec4 result;

void main() {
    if (!drawPixel(unpackRecord(cell0, cell1, cell2, cell3, cell4, cell5), ivec2(gl_FragCoord.xy), result)) discard;
}
