// SPDX-License-Identifier: Apache-2.0
//
// Whether drawn cells stand as the faces ask that two of them share (visibility_relations.h); one that does not
// leaves the frame to the processor.
layout(std430, binding = 3) readonly buffer Keyed { uvec2 keyed[]; };  // nearest first
layout(std430, binding = 4) readonly buffer Places { uint places[]; };
layout(std430, binding = 5) readonly buffer Neighbours { uvec4 neighbours[]; };

// On which side of face k the eye is, as CellProjector::eyeSide has it: by ascending point numbers, so that both
// cells compute the same.
double eyeSide(uvec4 points, int k) {
    uvec3 p = uvec3(points[faceVertex(k, 0)], points[faceVertex(k, 1)], points[faceVertex(k, 2)]);
    bool odd = false;
    for (int i = 0; i < 3; ++i) {  // 0 1, 1 2, 0 1
        int j = i % 2;
        if (p[j + 1] < p[j]) {
            uint other = p[j];
            p[j] = p[j + 1];
            p[j + 1] = other;
            odd = !odd;
        }
    }
    dvec3 a = cameraPoint(p.x);
    double side = faceSide(a, cameraPoint(p.y) - a, cameraPoint(p.z) - a, TETRALUX_ORTHOGRAPHIC != 0);
    return odd ? -side : side;
}

void main() {
    uint i = itemNumber();
    if (i >= plan.drawn) return;
    uint cell = keyed[i].y;
    uvec4 points = cells[cell], others = neighbours[cell];
    for (int k = 0; k < 4; ++k) {
        uint other = others[k];
        if (other == 0xffffffffu || other < cell) continue;
        uint place = places[other];
        if (place == 0) continue;
        double side = eyeSide(points, k);  // negative: the face shows its outside to the eye, the other cell lies in front
        if (place > i + 1 ? side < 0.0lf : side > 0.0lf) plan.unsettled = 1;
    }
}
