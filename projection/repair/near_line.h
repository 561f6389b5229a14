// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <projection/core/camera.h>

namespace tetralux::projection {

/// Distances (pixels, along the image axis that a line is farther from) between a line and centres that are asked for.
struct PixelDistances {
    double least, most;
};

/// Appends the pixels (y·width + x) whose centre the line from `a` to `b` (pixel coordinates) passes at such a
/// distance.
void addNearLine(glm::dvec2 a, glm::dvec2 b, PixelDistances wanted, const CameraFrame& frame,
                 std::vector<std::uint32_t>& pixels);

}  // namespace tetralux::projection
