// SPDX-License-Identifier: Apache-2.0
//
// Which candidates cover pixels: a flag each, their number and the range of their keys for each group.
layout(std430, binding = 3) readonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 4) writeonly buffer Flags { uint flags[]; };
layout(std430, binding = 5) writeonly buffer GroupCounts { uint groupCounts[]; };
layout(std430, binding = 6) writeonly buffer GroupRanges { dvec2 groupRanges[]; };
#if TETRALUX_KEYS
layout(std430, binding = 7) readonly buffer KeyPlanes { dvec4 keyPlanes[]; };
uniform dvec4 keyEye;
shared dvec2 ranges[TETRALUX_GROUP];
#endif

uniform uint count;

shared uint groupSkipped[2];

void main() {
    uint i = itemNumber(), lane = gl_LocalInvocationID.x;
    if (lane < 2) groupSkipped[lane] = 0;
    barrier();
    bool kept = false;
    uint cell = 0;
    if (i < count) {
        cell = candidates[i];
        uvec4 points = cells[cell];
        dvec3 v[4];
        for (int k = 0; k < 4; ++k) v[k] = cameraPoint(points[k]);
        CellRect rect;
        rect.x0 = rect.y0 = rect.x1 = rect.y1 = 0;
        int reason = rectangleOfCell(v, cellView(), rect);
        kept = reason == skipNone;
        if (!kept) atomicAdd(groupSkipped[reason - 1], 1u);
        flags[i] = kept ? 1u : 0u;
    }
    uint total;
    prefixSum(kept ? 1u : 0u, total);
#if TETRALUX_KEYS
    ranges[lane] = dvec2(unboundedKey, -unboundedKey);
    if (kept) ranges[lane] = dvec2(dot(keyPlanes[cell], keyEye));
    barrier();
    for (uint reach = TETRALUX_GROUP / 2; reach > 0; reach /= 2) {
        if (lane < reach) {
            ranges[lane] = dvec2(min(ranges[lane].x, ranges[lane + reach].x), max(ranges[lane].y, ranges[lane + reach].y));
        }
        barrier();
    }
#endif
    if (lane > 0 || groupNumber() * TETRALUX_GROUP >= count) return;
    groupCounts[groupNumber()] = total;
#if TETRALUX_KEYS
    groupRanges[groupNumber()] = ranges[0];
#endif
    atomicAdd(plan.skipped[0], groupSkipped[0]);
    atomicAdd(plan.skipped[1], groupSkipped[1]);
}
