// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <projection/cells/cell_setup.h>
#include <projection/core/pixel_maps.h>

namespace tetralux::projection {

/// Stands for "no limit" (nearer than all; its negative: farther than all).
inline constexpr float noInverseDepthLimit = 3e38f;

/// The limits of pixel maps as fast engines read them: inverse depth along rays, zRef/z − 1 in perspective and zRef − z
/// in orthographic views, z the depth in scene lengths. Each is empty or has one element per pixel.
struct InverseDepthMaps {
    std::vector<float> nearest, farthest, cutLayerEnd;
};
InverseDepthMaps inverseDepthMaps(const PixelMaps& maps, const CameraFrame& frame, const SceneUnits& units,
                                  double depthReference);

/// zRef for a camera: about the depth of the mesh's middle, and not too near, since the eye may stand in the mesh.
double depthReferenceOf(const mesh::BoundingBox& bounds, const CameraFrame& frame, const SceneUnits& units);

/// That depth, as float holds it, where the mesh is so far away that all of it lies about there; else 0. Floats beyond
/// it keep the mesh's depths at any distance of the eye.
double depthOriginOf(const mesh::BoundingBox& bounds, const CameraFrame& frame, const SceneUnits& units);

}  // namespace tetralux::projection
