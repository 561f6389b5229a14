// SPDX-License-Identifier: Apache-2.0
//
// What becomes of a chunk's pairs of tile and cell (gl_tiles.h), once they are counted: the plan here is theirs. More
// than there is room for are left alone; the frame is then drawn again.
layout(std430, binding = 1) readonly buffer GroupPairs { uint groupPairs[]; };
layout(std430, binding = 2) buffer Demand { uint mostPairs, roughPairs; };

uniform uint groups, capacity;

void main() {
    if (gl_LocalInvocationID.x > 0) return;
    uint pairs = groupPairs[groups];
    if (roughPairs > 0x400000u) pairs = 0xffffffffu;  // 2³⁰: the exact number may have run over
    roughPairs = 0;
    mostPairs = max(mostPairs, pairs);
    plan.drawn = pairs > capacity ? 0 : pairs;
    plan.sortGroups[0] = (plan.drawn + TETRALUX_SORT_BLOCK - 1) / TETRALUX_SORT_BLOCK;
    uint lanes = (plan.drawn + TETRALUX_GROUP - 1) / TETRALUX_GROUP;
    plan.settleGroups[0] = min(lanes, TETRALUX_GROUPS_ALONG_X);
    plan.settleGroups[1] = (lanes + TETRALUX_GROUPS_ALONG_X - 1) / TETRALUX_GROUPS_ALONG_X;
    plan.sortGroups[1] = plan.sortGroups[2] = plan.settleGroups[2] = 1;
}
