// SPDX-License-Identifier: Apache-2.0
//
// Mesh points to points before the camera (camera_points.h).
layout(std430, binding = 1) readonly buffer Positions { double positions[]; };
layout(std430, binding = 2) writeonly buffer CameraPoints { double cameraPoints[]; };

uniform uint count;
uniform dvec3 eye, right, down, forward;

void main() {
    uint i = itemNumber();
    if (i >= count) return;
    dvec3 fromEye = dvec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]) - eye;
    cameraPoints[3 * i] = dot(fromEye, right);
    cameraPoints[3 * i + 1] = dot(fromEye, down);
    cameraPoints[3 * i + 2] = dot(fromEye, forward);
}
