// SPDX-License-Identifier: Apache-2.0
//
// Cells before the camera, as compute shaders of the resident path read them.
layout(std430, binding = 1) readonly buffer CameraPoints { double cameraPoints[]; };
layout(std430, binding = 2) readonly buffer Cells { uvec4 cells[]; };

uniform dvec2 viewCentre;
uniform ivec2 viewSize;
uniform double viewDepthOrigin;

CellView cellView() {
    CellView view;
    view.centre = viewCentre;
    view.width = viewSize.x;
    view.height = viewSize.y;
    view.orthographic = TETRALUX_ORTHOGRAPHIC != 0;
    view.depthOrigin = viewDepthOrigin;
    return view;
}

dvec3 cameraPoint(uint point) { return dvec3(cameraPoints[3 * point], cameraPoints[3 * point + 1], cameraPoints[3 * point + 2]); }
