// SPDX-License-Identifier: Apache-2.0
//
// Last step of a pass of the radix sort (gl_radix_sort.h): each cell goes to where its digit begins, after those of
// the same digit before it.
layout(std430, binding = 1) readonly buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 2) readonly buffer DigitPlaces { uint digitPlaces[]; };  // where block b's begin: [digit·blocks + b]
layout(std430, binding = 3) writeonly buffer Sorted { uvec2 sorted[]; };

uniform uint shift;

const uint perLane = TETRALUX_SORT_BLOCK / TETRALUX_GROUP;
shared uint places[16 * TETRALUX_GROUP];  // [digit·lanes + lane]
shared uint digitBegin[16];

void main() {
    uint lane = gl_LocalInvocationID.x, block = gl_WorkGroupID.x;
    uint begin = block * TETRALUX_SORT_BLOCK + lane * perLane, end = min(begin + perLane, plan.drawn);
    for (uint digit = 0; digit < 16; ++digit) places[digit * TETRALUX_GROUP + lane] = 0;
    for (uint i = begin; i < end; ++i) ++places[((keyed[i].x >> shift) & 15u) * TETRALUX_GROUP + lane];
    barrier();
    uint sum = 0;
    for (uint j = 0; j < 16; ++j) sum += places[16 * lane + j];
    uint total, before = prefixSum(sum, total);
    for (uint j = 0; j < 16; ++j) {
        uint count = places[16 * lane + j];
        places[16 * lane + j] = before;
        before += count;
    }
    barrier();
    if (lane < 16) digitBegin[lane] = places[lane * TETRALUX_GROUP];
    barrier();
    for (uint i = begin; i < end; ++i) {
        uint digit = (keyed[i].x >> shift) & 15u;
        uint place = places[digit * TETRALUX_GROUP + lane]++ - digitBegin[digit];
        sorted[digitPlaces[digit * gl_NumWorkGroups.x + block] + place] = keyed[i];
    }
}
