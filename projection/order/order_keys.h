// SPDX-License-Identifier: Apache-2.0
/// \file
/// Keys of cells that are linear in the place of the eye: one gradient and one constant per cell, made once; a frame
/// takes four multiplications per cell. Both the certain power order and the plain order by centroids are of this form.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>
#include <projection/core/diagonal_units.h>

namespace tetralux::projection {

class OrderKeys {
public:
    OrderKeys() = default;

    /// Keys of PowerOrder: the cell's linear function of the heights (one per mesh point), continued to the eye.
    static OrderKeys power(const mesh::ScalarMesh& mesh, const std::vector<double>& heights);

    /// Minus the squared distance of the cell's centroid, but for what is the same for all cells. No certain order.
    static OrderKeys centroid(const mesh::ScalarMesh& mesh);

    bool empty() const { return planes_.empty(); }

    /// 32 bytes per cell: gradient and constant over positions in mesh diagonals from the centre of the bounds. To make
    /// them anew each frame would take four times the time of reading them.
    const std::vector<glm::dvec4>& planes() const { return planes_; }

    /// What a plane is multiplied by. Larger is nearer.
    glm::dvec4 eye(const CameraFrame& frame) const { return units_.eye(frame); }

private:
    explicit OrderKeys(const mesh::ScalarMesh& mesh);

    std::vector<glm::dvec4> planes_;
    DiagonalUnits units_;
};

/// Value of a plane at the eye; the larger, the nearer the cell.
inline double orderKey(const glm::dvec4& plane, const glm::dvec4& eye) {
    return plane.x * eye.x + plane.y * eye.y + plane.z * eye.z + plane.w * eye.w;
}

}  // namespace tetralux::projection
