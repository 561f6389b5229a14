// SPDX-License-Identifier: Apache-2.0
//
// Where each drawn cell stands in the order, counted from 1; the others keep 0. For gl_order_check.comp.
layout(std430, binding = 1) readonly buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 2) writeonly buffer Places { uint places[]; };

void main() {
    uint i = itemNumber();
    if (i < plan.drawn) places[keyed[i].y] = i + 1;
}
