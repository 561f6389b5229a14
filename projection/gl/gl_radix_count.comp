// SPDX-License-Identifier: Apache-2.0
//
// First step of a pass of the radix sort (gl_radix_sort.h): how often each digit occurs in each block of cells.
layout(std430, binding = 1) readonly buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 2) writeonly buffer DigitCounts { uint digitCounts[]; };  // of block b: [digit·blocks + b]

uniform uint shift;

shared uint counts[16];

void main() {
    uint lane = gl_LocalInvocationID.x, block = gl_WorkGroupID.x;
    if (lane < 16) counts[lane] = 0;
    barrier();
    for (uint j = 0; j < TETRALUX_SORT_BLOCK; j += TETRALUX_GROUP) {
        uint i = block * TETRALUX_SORT_BLOCK + j + lane;
        if (i < plan.drawn) atomicAdd(counts[(keyed[i].x >> shift) & 15u], 1u);
    }
    barrier();
    if (lane < 16) digitCounts[lane * gl_NumWorkGroups.x + block] = counts[lane];
}
