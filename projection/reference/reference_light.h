// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: light of one segment in double precision, straight from the scene's settings.
#pragma once

#include <projection/core/scene.h>

namespace tetralux::projection {

struct SegmentToLight {
    mesh::CellIndex cell;
    glm::dvec3 middle;     ///< of the segment, mesh units
    glm::dvec3 direction;  ///< of the ray, unit
    double fromEye;        ///< from the ray's start to the middle, mesh units
    glm::dvec3 normal;     ///< of the cell's gradient, unit; zero where there is none
    bool cut = false;      ///< within the layer of a cut: `normal` is the cut's, and the side its front
    double side;           ///< sign of s_f − s_b
    glm::dvec3 color;      ///< C_seg/α_seg
    double opacity;        ///< after the silhouette
};

/// Colour per α. `scene` carries its vertices' light (withVertexLight).
glm::dvec3 litColor(const Scene& scene, const SegmentToLight& segment);

}  // namespace tetralux::projection
