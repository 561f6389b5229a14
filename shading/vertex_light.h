// SPDX-License-Identifier: Apache-2.0
/// \file
/// What light and pre-classification need to know at the vertices: computed once, kept, interpolated linearly to the
/// middle of each segment.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <shading/anisotropy.h>
#include <shading/lights.h>

namespace tetralux::shading {

/// `stride` floats per point, a multiple of four: a row. Each `…At` is the place of an attribute among them, −1: not
/// there.
struct VertexLight {
    int stride = 0;
    int normalAt = -1;    ///< three: gradient (vertex_gradients.h)
    int tensorAt = -1;    ///< six: xx, yy, zz, xy, xz, yz (anisotropy.h)
    int shadowAt = -1;    ///< one per light of ShadingSettings: transmittance to it
    int specularAt = -1;  ///< one: Material::specularByGradient's factor
    int sampleAt = -1;    ///< four: colour and extinction of pre-classification, per unit of scene units
    std::vector<float> values;
    /// Rows of each cell's corners, in the order of its points. Empty: those of the points. Rows of particular cells
    /// follow those of the points.
    std::vector<mesh::Tetrahedron> corners;

    bool any() const { return stride > 0; }
    /// Rows of the corners of a cell with these points.
    const mesh::Tetrahedron& cornersOf(mesh::CellIndex cell, const mesh::Tetrahedron& points) const {
        return corners.empty() ? points : corners[cell];
    }
    float* of(std::size_t row) { return values.data() + row * static_cast<std::size_t>(stride); }
    const float* of(std::size_t row) const { return values.data() + row * static_cast<std::size_t>(stride); }
};

/// The attributes that `settings` need, and samples if they are `sampled`; the anisotropy is `kept`, or else computed.
/// What takes a transfer function is left for others to set (projection/light/light_shadows.h,
/// projection/light/vertex_samples.h): shadows and specular factors are 1.
VertexLight vertexLight(const mesh::ScalarMesh& mesh, const ShadingSettings& settings, bool sampled,
                        const std::vector<Tensor>* kept = nullptr);

/// What that computes; `mesh` alone decides it.
std::vector<Tensor> vertexTensors(const mesh::ScalarMesh& mesh, const AnisotropySettings& settings);

}  // namespace tetralux::shading
