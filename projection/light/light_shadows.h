// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <projection/core/scene.h>

namespace tetralux::projection {

/// Sets the shadows of `light` (VertexLight::shadowAt): transmittance of the volume from every vertex to each light, by
/// the integral of the picture's mode, isosurfaces included, silhouettes not; 0 behind the scene's shadow casters, but
/// for those that the vertex lies on. Exact along a line from 1e-7 of the
/// mesh's diagonal beside the vertex (which keeps it out of the faces of grids). An area light
/// (ShadowSettings::softness) is the mean over 16 points of a disc across the direction to it. Head lights cast
/// none: 1. They hold as long as mesh, transfer function, mode and lights do.
void addShadows(const Scene& scene, shading::VertexLight& light);

/// The same at any place (mesh units) for one light. Holds the mesh.
using ShadowAt = std::function<double(const shading::Light& light, const glm::dvec3& place)>;
ShadowAt shadowsOf(const Scene& scene);

}  // namespace tetralux::projection
