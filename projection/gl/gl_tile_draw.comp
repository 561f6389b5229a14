// SPDX-License-Identifier: Apache-2.0
//
// A tile of the picture by one group, a pixel by each lane: the cells of its list, nearest first, composed over what
// the chunks before have left (Kraus 2005, Equation 5, front to back). A tile ends early when all its pixels are
// finished. Parts of 8 × 4 pixels, 32 lanes that stand together, walk along the cells that may hold one of theirs.
layout(std430, binding = 1) readonly buffer Pairs { uvec2 pairs[]; };      // tile, place of the cell in the chunk
layout(std430, binding = 2) readonly buffer Ranges { uvec2 ranges[]; };    // of pairs, by tile
layout(std430, binding = 3) readonly buffer Vertices { uvec4 vertices[]; };  // gl_cell_buffer.h
layout(std430, binding = 4) buffer TileStates { uvec4 tileStates[]; };     // fragments, pairs, pairs left out, whether it is finished
layout(binding = 0, rgba32f) uniform image2D picture;

uniform ivec2 viewSize;
uniform uint cellVectors;
uniform float leastTransmittance;  // a pixel is finished below it

// Of a cell: its record, then gradient and corners.
const uint firstVector = 2, batchCells = 64, batchVectors = TETRALUX_ATTRIBUTES != 0 ? 9 : TETRALUX_GRADIENT != 0 ? 7 : 6;
shared uvec4 batch[batchCells * batchVectors];
const uint parts = 8;
shared uint partCells[parts * 2];  // a bit for each cell of the batch
shared uint openPixels, tileFragments;

// Pixel of a tile at which a part begins, and of a lane.
ivec2 placeOfPart(uint part) { return ivec2(8 * (part & 1), 4 * (part >> 1)); }
ivec2 placeOf(uint lane) { return placeOfPart(lane / 32) + ivec2(lane & 7, (lane >> 3) & 3); }

// Four lanes for each cell of the batch, two parts each.
void findParts(uint begin, uint cells, ivec2 tilePlace) {
    uint cell = gl_LocalInvocationID.x / 4;
    if (cell >= cells) return;
    uint vertex = pairs[begin + cell].y * cellVectors;
    vec4 corners[2] = vec4[2](uintBitsToFloat(vertices[vertex]), uintBitsToFloat(vertices[vertex + 1]));
    Outline outline = Outline(vec2[4](corners[0].xy, corners[0].zw, corners[1].xy, corners[1].zw));
    for (uint i = 0; i < 2; ++i) {
        uint part = 2 * (gl_LocalInvocationID.x % 4) + i;
        vec2 low = vec2(tilePlace + placeOfPart(part));
        if (mayHold(outline, low, low + vec2(7.0, 3.0))) atomicOr(partCells[2 * part + cell / 32], 1u << (cell % 32));
    }
}

void fetchBatch(uint begin, uint cells) {
    for (uint i = gl_LocalInvocationID.x; i < cells * batchVectors; i += TETRALUX_GROUP) {
        batch[i] = vertices[pairs[begin + i / batchVectors].y * cellVectors + firstVector + i % batchVectors];
    }
}

vec4 batchVector(uint cell, uint i) { return uintBitsToFloat(batch[cell * batchVectors + i]); }

CellRecord batchRecord(uint cell) {
#if TETRALUX_GRADIENT
    gradient = batchVector(cell, 6);
#endif
#if TETRALUX_ATTRIBUTES
    eyeWeight = batchVector(cell, 7);
    points = batch[cell * batchVectors + 8];
#endif
    return unpackRecord(batchVector(cell, 0), batchVector(cell, 1), batchVector(cell, 2), batchVector(cell, 3), batchVector(cell, 4),
                        batchVector(cell, 5));
}

// What blending does on the raster path, from the other side.
vec4 composed(vec4 sum, vec4 cell) {
#if TETRALUX_MODE == TETRALUX_MODE_VOLUME
    return sum + (1.0 - sum.a) * cell;
#elif TETRALUX_MODE == TETRALUX_MODE_FIRST_HIT || TETRALUX_MODE == TETRALUX_MODE_DEPTH
    return cell;
#elif TETRALUX_MODE == TETRALUX_MODE_MIP
    return max(sum, cell);
#elif TETRALUX_MODE == TETRALUX_MODE_MINIMUM
    return min(sum, cell);
#else
    return sum + cell;
#endif
}

bool isFinished(vec4 sum) {
#if TETRALUX_MODE == TETRALUX_MODE_VOLUME
    return 1.0 - sum.a < leastTransmittance;
#elif TETRALUX_MODE == TETRALUX_MODE_FIRST_HIT || TETRALUX_MODE == TETRALUX_MODE_DEPTH
    return sum.a > 0.5;
#else
    return false;
#endif
}

// Whether any lane says so. All lanes must call it.
bool anyLane(bool lane) {
    barrier();
    if (gl_LocalInvocationID.x == 0) openPixels = 0;
    barrier();
    if (lane) openPixels = 1;
    barrier();
    return openPixels != 0;
}

void main() {
    uint lane = gl_LocalInvocationID.x, tile = groupNumber();
    uvec2 range = ranges[tile];
    if (range.x >= range.y) return;
    ivec2 tilePlace = TETRALUX_TILE_SIZE * ivec2(gl_WorkGroupID.xy), place = tilePlace + placeOf(lane);
    bool inside = place.x < viewSize.x && place.y < viewSize.y;
    vec4 sum = vec4(0.0);
    if (inside) sum = imageLoad(picture, place);
    bool open = inside && !isFinished(sum);
    if (lane == 0) tileFragments = 0;
    uint fragments = 0, at = range.x;
    for (; at < range.y; at += batchCells) {
        if (!anyLane(open)) break;
        uint cells = min(batchCells, range.y - at);
        if (lane < 2 * parts) partCells[lane] = 0;
        fetchBatch(at, cells);
        barrier();
        findParts(at, cells, tilePlace);
        barrier();
        for (uint word = 0; word < 2; ++word) {
            uint bits = open ? partCells[2 * (lane / 32) + word] : 0;
            while (bits != 0) {
                vec4 cell;
                bool holds = drawPixel(batchRecord(32 * word + findLSB(bits)), place, cell);
                bits &= bits - 1;
                if (!holds) continue;
                sum = composed(sum, cell);
                ++fragments;
                open = !isFinished(sum);
                bits = open ? bits : 0;
            }
        }
    }
    atomicAdd(tileFragments, fragments);
    if (inside) imageStore(picture, place, sum);
    bool anyOpen = anyLane(open);
    if (lane == 0) tileStates[tile] = uvec4(tileStates[tile].xyz + uvec3(tileFragments, range.y - range.x, range.y - min(at, range.y)), anyOpen ? 0 : 1);
}
