// SPDX-License-Identifier: Apache-2.0
#include <projection/core/modes.h>

#include <algorithm>

#include <glm/geometric.hpp>

namespace tetralux::projection {

preint::Integral integralOf(Mode mode) {
    const bool overData = mode == Mode::ScaleInvariant || mode == Mode::DataAdditive;
    return overData ? preint::Integral::ScaleInvariant : preint::Integral::Standard;
}

bool addsUp(Mode mode) {
    return mode == Mode::Additive || mode == Mode::DataAdditive || mode == Mode::Emission;
}

bool orderFree(Mode mode) {
    switch (mode) {
        case Mode::Standard:
        case Mode::ScaleInvariant:
        case Mode::FirstHit:
        case Mode::Depth:
            return false;
        case Mode::Mip:
        case Mode::Minimum:
        case Mode::Average:
        case Mode::Additive:
        case Mode::DataAdditive:
        case Mode::Emission:
        case Mode::Absorption:
        case Mode::Contributions:
            return true;
    }
    return false;
}

DepthRange depthRange(const mesh::BoundingBox& bounds, const Camera& camera) {
    const CameraFrame frame = cameraFrame(camera);
    const glm::dvec3 towards = bounds.centre() - frame.eye;
    const double middle = frame.orthographic ? glm::dot(towards, frame.forward) : glm::length(towards);
    const double radius = std::max(0.5 * bounds.diagonal(), 1e-9 * std::abs(middle));
    const double nearest = std::max(0.0, middle - radius);
    const double farthest = middle + radius;
    return {nearest, farthest > nearest ? farthest : nearest + radius};  // all of it may be behind the eye's plane
}

bool composesParts(Mode mode) {
    return mode == Mode::Standard || mode == Mode::ScaleInvariant || mode == Mode::FirstHit || mode == Mode::Absorption;
}

}  // namespace tetralux::projection
