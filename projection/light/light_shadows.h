// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <projection/core/scene.h>

namespace tetralux::projection {

/// Sets the shadows of `light` (VertexLight::shadowAt): transmittance of the volume from every vertex to each light, by
/// the integral of the picture's mode, isosurfaces included, silhouettes not; 0 behind the scene's shadow casters, but
/// for those that the vertex lies on. Exact along a line that begins beside the vertex, within the largest cell there:
/// on the boundary, and in faces parallel to the light, it is what comes to the volume beside them. An area light
/// (ShadowSettings::softness) is the mean over 32 points of a disc across the direction to it. Head lights cast
/// none: 1. They hold as long as mesh, transfer function, mode and lights do.
void addShadows(const Scene& scene, shading::VertexLight& light);

/// Gives the cells through which isosurfaces pass rows of their own (VertexLight::corners), so that no surface shades
/// itself: for a corner behind some of the cell's surfaces, as the light comes, the line's first crossing of each of
/// them does not count. What they hide within the cell is for shading/surface_shadow.glsl to say. Copies the rows of
/// the vertices as they are.
void addSurfaceShadows(const Scene& scene, shading::VertexLight& light);

/// Shadow at any place (mesh units) for one light. Holds the mesh.
using ShadowAt = std::function<double(const shading::Light& light, const glm::dvec3& place)>;
ShadowAt shadowsOf(const Scene& scene);

}  // namespace tetralux::projection
