// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: light of one segment in double precision, straight from the scene's settings.
#pragma once

#include <array>

#include <projection/core/scene.h>

namespace tetralux::projection {

struct SegmentToLight {
    mesh::CellIndex cell;
    glm::dvec3 middle;       ///< of the segment, mesh units
    glm::dvec3 direction;    ///< of the ray, unit
    double fromEye;          ///< from the ray's start to the middle, mesh units
    glm::dvec3 normal;       ///< of the cell's gradient, unit; zero where there is none
    glm::dvec3 fieldNormal;  ///< the same, whatever is lit
    bool cut = false;        ///< within the layer of a cut: `normal` is the cut's, and the side its front
    double side;             ///< sign of s_f − s_b
    double front, back;      ///< scalars at the segment's ends
    glm::dvec3 color;        ///< C_seg/α_seg
    double opacity;          ///< after the silhouette
};

/// Barycentric coordinates of `x` in a cell, brought inside where rounding left them beyond.
std::array<double, 4> innerCoordinates(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const glm::dvec3& x);

/// The smoothed gradient (shading::Normals::Smooth) at a place in a cell. `scene` carries its vertices' light.
glm::dvec3 smoothGradient(const Scene& scene, mesh::CellIndex cell, const glm::dvec3& x);

/// Colour per α. `scene` carries its vertices' light (withVertexLight).
glm::dvec3 litColor(const Scene& scene, const SegmentToLight& segment);

}  // namespace tetralux::projection
