// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/scene.h>

namespace tetralux::projection {

/// Sets the specular factors of `light` (VertexLight::specularAt, shading/lights.h says what they are), and its samples
/// (VertexLight::sampleAt): colour and extinction of the vertices' scalars. Isosurfaces are in neither.
void addSpecularFactors(const Scene& scene, shading::VertexLight& light);
void addSamples(const Scene& scene, shading::VertexLight& light);

/// Whether the picture is pre-classified from samples at the vertices. Cell data is not: one sample stands for a cell
/// whichever way it is taken.
bool samplesVertices(const Scene& scene);

}  // namespace tetralux::projection
