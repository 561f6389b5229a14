// SPDX-License-Identifier: Apache-2.0
//
// Which tiles the cells of a chunk may touch: all that their outlines (gl_cell_buffer.h) do not miss and that are not
// finished. Run twice, with TETRALUX_EMIT 0 to count them and with 1 to write them, in the cells' order.
layout(std430, binding = 1) readonly buffer Vertices { vec2 corners[]; };
layout(std430, binding = 2) readonly buffer TileStates { uvec4 tileStates[]; };  // gl_tile_draw.comp
layout(std430, binding = 3) buffer CellPairs { uint cellPairs[]; };              // of the cells before, in the group
layout(std430, binding = 4) buffer GroupPairs { uint groupPairs[]; };            // of each group; afterwards of the groups before
#if TETRALUX_EMIT
layout(std430, binding = 5) writeonly buffer Pairs { uvec2 pairs[]; };  // tile, place of the cell in the chunk
#else
layout(std430, binding = 5) buffer Demand { uint mostPairs, roughPairs; };
#endif

uniform ivec2 viewSize;  // pixels
uniform uint chunkBegin, chunkCells, cornerStride, capacity;

const int tileSize = TETRALUX_TILE_SIZE;
// How many tiles the cell touches; written from `at` on.
uint visitTiles(uint slot, uint at) {
    Outline outline;
    for (int k = 0; k < 4; ++k) outline.corner[k] = corners[slot * cornerStride + k];
    vec2 low = min(min(outline.corner[0], outline.corner[1]), min(outline.corner[2], outline.corner[3]));
    vec2 high = max(max(outline.corner[0], outline.corner[1]), max(outline.corner[2], outline.corner[3]));
    ivec2 first = ivec2(ceil(clamp(low, vec2(0.0), vec2(viewSize)))), last = ivec2(floor(clamp(high, vec2(-1.0), vec2(viewSize - 1))));
    if (first.x > last.x || first.y > last.y) return 0;
    int tilesAlongX = (viewSize.x + tileSize - 1) / tileSize;
    uint count = 0;
    for (int y = first.y / tileSize; y <= last.y / tileSize; ++y) {
        for (int x = first.x / tileSize; x <= last.x / tileSize; ++x) {
            vec2 begin = vec2(tileSize * x, tileSize * y);
            int tile = y * tilesAlongX + x;
            if (tileStates[tile].w != 0 || !mayHold(outline, begin, begin + float(tileSize - 1))) continue;
#if TETRALUX_EMIT
            if (at + count < capacity) pairs[at + count] = uvec2(tile, slot);
#endif
            ++count;
        }
    }
    return count;
}

void main() {
    uint slot = itemNumber();
    bool drawn = slot < chunkCells && chunkBegin + slot < plan.drawn;
#if TETRALUX_EMIT
    if (drawn) visitTiles(slot, groupPairs[groupNumber()] + cellPairs[slot]);
#else
    uint total, before = prefixSum(drawn ? visitTiles(slot, 0u) : 0u, total);
    if (slot < chunkCells) cellPairs[slot] = before;
    if (gl_LocalInvocationID.x == 0 && groupNumber() * TETRALUX_GROUP < chunkCells) {
        groupPairs[groupNumber()] = total;
        atomicAdd(roughPairs, (total + 255) / 256);
    }
#endif
}
