// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

/// Places in mesh diagonals from the centre of the bounds, for what is linear in the place of the eye.
class DiagonalUnits {
public:
    DiagonalUnits() = default;
    explicit DiagonalUnits(const mesh::BoundingBox& bounds)
        : centre_(bounds.centre()), perLength_(bounds.diagonal() > 0 ? 1.0 / bounds.diagonal() : 1.0) {}

    glm::dvec3 place(const glm::dvec3& position) const { return (position - centre_) * perLength_; }
    glm::dvec3 step(const glm::dvec3& from, const glm::dvec3& to) const { return (to - from) * perLength_; }

    /// What linear functions of the place are multiplied by: the eye's place and 1, or the direction towards the eye
    /// and 0.
    glm::dvec4 eye(const CameraFrame& frame) const {
        return frame.orthographic ? glm::dvec4(-frame.forward, 0.0) : glm::dvec4(place(frame.eye), 1.0);
    }

private:
    glm::dvec3 centre_{0};
    double perLength_ = 1.0;
};

}  // namespace tetralux::projection
