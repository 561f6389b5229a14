// SPDX-License-Identifier: Apache-2.0
//
// Prefix sums in place by one group; the sum of all stands after the last.
layout(std430, binding = 1) buffer Values { uint values[]; };

uniform uint fixedCount;  // 0: the digits of the sort's blocks

const uint perLane = 8;

void main() {
    uint count = fixedCount > 0 ? fixedCount : 16 * plan.sortGroups[0] * plan.sortGroups[1];
    uint carried = 0, lane = gl_LocalInvocationID.x;
    for (uint first = 0; first < count; first += TETRALUX_GROUP * perLane) {
        uint begin = first + lane * perLane, end = min(begin + perLane, count), sum = 0;
        for (uint i = begin; i < end; ++i) sum += values[i];
        uint total, before = carried + prefixSum(sum, total);
        for (uint i = begin; i < end; ++i) {
            uint value = values[i];
            values[i] = before;
            before += value;
        }
        carried += total;
    }
    if (lane == 0) values[count] = carried;
}
