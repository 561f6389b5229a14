// SPDX-License-Identifier: Apache-2.0
//
// Puts each run of cells with equal whole-number keys in the order of their keys as doubles (key_sort.cpp). A run
// that is too long for one lane leaves the frame to the processor: so does a layer of a grid that is seen along an
// axis without perspective. (Checking relations afterwards would not do, since cells that are not drawn may stand
// between two that are.)
layout(std430, binding = 1) buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 2) readonly buffer KeyPlanes { dvec4 keyPlanes[]; };

uniform dvec4 keyEye;

const uint longestRun = 64;

double keyOf(uint cell) { return dot(keyPlanes[cell], keyEye); }

void main() {
    uint begin = itemNumber();
    if (begin >= plan.drawn) return;
    uint key = keyed[begin].x, end = begin + 1;
    if (begin > 0) {
        if (keyed[begin - 1].x == key) return;
    }
    while (end < plan.drawn && end - begin <= longestRun) {
        if (keyed[end].x != key) break;
        ++end;
    }
    if (end - begin > longestRun) {
        plan.unsettled = 1;
        return;
    }
    for (uint i = begin + 1; i < end; ++i) {
        uint cell = keyed[i].y, j = i;
        double own = keyOf(cell);
        while (j > begin) {
            uint before = keyed[j - 1].y;
            if (!(keyOf(before) < own)) break;
            keyed[j--].y = before;
        }
        keyed[j].y = cell;
    }
}
