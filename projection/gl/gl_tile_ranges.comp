// SPDX-License-Identifier: Apache-2.0
//
// Where each tile's cells begin and end among the sorted pairs; tiles without cells keep (0, 0).
layout(std430, binding = 1) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, binding = 2) writeonly buffer Ranges { uint ranges[]; };  // begin, end

void main() {
    uint i = itemNumber();
    if (i >= plan.drawn) return;
    uint tile = pairs[i].x, before = pairs[max(i, 1) - 1].x, after = pairs[min(i + 1, plan.drawn - 1)].x;
    if (i == 0 || before != tile) ranges[2 * tile] = i;
    if (i + 1 == plan.drawn || after != tile) ranges[2 * tile + 1] = i + 1;
}
