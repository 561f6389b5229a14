// SPDX-License-Identifier: Apache-2.0
//
// What the rest of the frame does, once it is known how many cells cover pixels: by one group. The range of all keys
// stands after the last group's.
layout(std430, binding = 1) readonly buffer GroupCounts { uint groupCounts[]; };
layout(std430, binding = 2) buffer GroupRanges { dvec2 groupRanges[]; };

uniform uint groups, chunkCount, chunkCells, indicesPerCell;

shared dvec2 ranges[TETRALUX_GROUP];

void main() {
    uint lane = gl_LocalInvocationID.x;
#if TETRALUX_KEYS
    dvec2 range = dvec2(unboundedKey, -unboundedKey);
    for (uint i = lane; i < groups; i += TETRALUX_GROUP) range = dvec2(min(range.x, groupRanges[i].x), max(range.y, groupRanges[i].y));
    ranges[lane] = range;
    barrier();
    for (uint reach = TETRALUX_GROUP / 2; reach > 0; reach /= 2) {
        if (lane < reach) ranges[lane] = dvec2(min(ranges[lane].x, ranges[lane + reach].x), max(ranges[lane].y, ranges[lane + reach].y));
        barrier();
    }
    if (lane == 0) groupRanges[groups] = ranges[0];
#endif
    uint drawn = groupCounts[groups];
    if (lane == 0) {
        plan.drawn = drawn;
        uint blocks = (drawn + TETRALUX_SORT_BLOCK - 1) / TETRALUX_SORT_BLOCK;
        plan.sortGroups[0] = blocks;  // 2,048 cells each: 65,535 hold 134 million
        plan.sortGroups[1] = plan.sortGroups[2] = 1;
        uint lanes = (drawn + TETRALUX_GROUP - 1) / TETRALUX_GROUP;
        plan.settleGroups[0] = min(lanes, TETRALUX_GROUPS_ALONG_X);
        plan.settleGroups[1] = (lanes + TETRALUX_GROUPS_ALONG_X - 1) / TETRALUX_GROUPS_ALONG_X;
        plan.settleGroups[2] = 1;
    }
    for (uint c = lane; c < chunkCount; c += TETRALUX_GROUP) {
        uint cells = min(drawn - min(drawn, c * chunkCells), chunkCells);
        plan.chunks[c].setUp[0] = (cells + TETRALUX_GROUP - 1) / TETRALUX_GROUP;
        plan.chunks[c].setUp[1] = plan.chunks[c].setUp[2] = 1;
        plan.chunks[c].draw[0] = cells * indicesPerCell;
        plan.chunks[c].draw[1] = 1;
        plan.chunks[c].draw[2] = plan.chunks[c].draw[3] = plan.chunks[c].draw[4] = 0;
    }
}
