// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where single points stand in the image, in double precision and mesh units.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <projection/core/camera.h>

namespace tetralux::projection {

/// Pixel coordinates of a point `fromEye` (mesh units) at depth `depth` along `forward`; no sample shift is included.
class PointPixel {
public:
    explicit PointPixel(const CameraFrame& frame) : frame_(frame) {}

    double depth(const glm::dvec3& fromEye) const { return glm::dot(fromEye, frame_.forward); }
    glm::dvec2 operator()(const glm::dvec3& fromEye, double depth) const {
        return frame_.centre + glm::dvec2(glm::dot(fromEye, frame_.columnAxis), glm::dot(fromEye, frame_.rowAxis)) /
                                   (frame_.pixel * (frame_.orthographic ? 1.0 : depth));
    }

private:
    const CameraFrame& frame_;
};

}  // namespace tetralux::projection
