// SPDX-License-Identifier: Apache-2.0
/// \file
/// The points of a mesh before a camera: once per frame, for all that an engine does with them.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>
#include <projection/core/scene_units.h>

namespace tetralux::projection {

/// A mesh point before the camera: x and y in pixels times depth (pixels when orthographic), z the depth, lengths in
/// scene units; and its pixel, the sample shift included. A point at or behind the eye's plane has no pixel: pixelX is
/// NaN. The ray of pixel (x, y) is z·(x − centre.x, y − centre.y, 1), or (x − centre.x, y − centre.y, z), with `centre`
/// from sampleCentre.
struct CameraPoint {
    double x, y, z;
    float pixelX, pixelY;

    glm::dvec3 position() const { return {x, y, z}; }
};
static_assert(sizeof(CameraPoint) == 32);

/// Pixel coordinates of the optical axis among the samples.
inline glm::dvec2 sampleCentre(const CameraFrame& frame) {
    return frame.centre - frame.sampleShift;
}

/// What a point's place from the eye (mesh units) is multiplied by to become a CameraPoint's x, y and z.
struct CameraAxes {
    glm::dvec3 right, down, forward;
};
CameraAxes cameraAxes(const CameraFrame& frame, const SceneUnits& units);

/// All points of `mesh`. `points` keeps its memory.
void projectPoints(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame,
                   std::vector<CameraPoint>& points);

}  // namespace tetralux::projection
