// SPDX-License-Identifier: Apache-2.0
//
// What compute shaders of the resident path share: numbering over two dimensions of groups (one takes 65,535 at
// most), prefix sums over a group, and the frame's plan.
layout(local_size_x = TETRALUX_GROUP) in;

uint groupNumber() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint itemNumber() { return groupNumber() * TETRALUX_GROUP + gl_LocalInvocationID.x; }

shared uint groupSums[TETRALUX_GROUP];

// Sum of the values of lower lanes, and of all (Hillis & Steele 1986). All lanes must call it.
uint prefixSum(uint value, out uint total) {
    uint lane = gl_LocalInvocationID.x;
    groupSums[lane] = value;
    barrier();
    for (uint reach = 1; reach < TETRALUX_GROUP; reach *= 2) {
        uint lower = lane >= reach ? groupSums[lane - reach] : 0;
        barrier();
        groupSums[lane] += lower;
        barrier();
    }
    total = groupSums[TETRALUX_GROUP - 1];
    uint before = groupSums[lane] - value;
    barrier();
    return before;
}

// Mirrored by GlResidentCells. A dispatch command is three numbers.
struct ChunkCommands {
    uint setUp[3];
    uint draw[5];
};
layout(std430, binding = 0) buffer Plan {
    uint drawn;               // cells that cover pixels
    uint skipped[2];          // outside the view, without a pixel centre
    uint unsettled;           // whether the order is uncertain
    uint sortGroups[3];       // dispatch: blocks of the sort
    uint settleGroups[3];     // dispatch: one lane per drawn cell
    ChunkCommands chunks[];
} plan;
