// SPDX-License-Identifier: Apache-2.0
//
// The candidates that cover pixels, side by side in their order, with their keys.
layout(std430, binding = 1) readonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 2) readonly buffer Flags { uint flags[]; };
layout(std430, binding = 3) readonly buffer GroupCounts { uint groupCounts[]; };
layout(std430, binding = 4) writeonly buffer Keyed { uvec2 keyed[]; };  // key ascending from near to far, cell
#if TETRALUX_KEYS
layout(std430, binding = 5) readonly buffer GroupRanges { dvec2 groupRanges[]; };
layout(std430, binding = 6) readonly buffer KeyPlanes { dvec4 keyPlanes[]; };
uniform dvec4 keyEye;
uniform uint groups;
#endif

uniform uint count;

void main() {
    uint i = itemNumber();
    bool kept = i < count && flags[min(i, count - 1)] != 0;
    uint total, before = prefixSum(kept ? 1u : 0u, total);
    if (!kept) return;
    uint cell = candidates[i], key = 0;
#if TETRALUX_KEYS
    dvec2 range = groupRanges[groups];
    key = uint(orderPosition(dot(keyPlanes[cell], keyEye), range.y, range.x));
#endif
    keyed[groupCounts[groupNumber()] + before] = uvec2(key, cell);
}
