// SPDX-License-Identifier: Apache-2.0
#include <projection/cells/ray_inverse_depth.h>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// Least reference depth, scene lengths.
constexpr double leastDepthReference = 0.5;

/// Shaders read it as float, and what is beyond it counts from that.
double roundedToFloat(double depth) {
    return static_cast<double>(static_cast<float>(depth));
}

float inverseDepthOf(double depth, double depthReference, bool orthographic) {
    const double most = static_cast<double>(noInverseDepthLimit);
    if (std::isinf(depth))
        return depth > 0 ? -noInverseDepthLimit : noInverseDepthLimit;  // nothing is nearer, or all is
    double rayInverseDepth = depthReference - depth;
    if (!orthographic) rayInverseDepth = depth > 0 ? rayInverseDepth / depth : most;
    return static_cast<float>(std::clamp(rayInverseDepth, -most, most));
}

}  // namespace

InverseDepthMaps inverseDepthMaps(const PixelMaps& maps, const CameraFrame& frame, const SceneUnits& units,
                                  double depthReference) {
    const auto width = static_cast<std::size_t>(frame.width), height = static_cast<std::size_t>(frame.height);
    InverseDepthMaps result;
    result.nearest.resize(maps.nearest.size());
    result.farthest.resize(maps.farthest.size());
    result.cutLayerEnd.resize(maps.cutLayerEnd.size());
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = y * width + x;
            const glm::dvec2 fromAxis =
                frame.squared(glm::dvec2(static_cast<double>(x), static_cast<double>(y)) - frame.centre);
            const double rayLength = frame.orthographic
                                         ? 1.0
                                         : std::sqrt(1.0 + glm::dot(frame.perPixelRight, frame.perPixelRight) *
                                                               glm::dot(fromAxis, fromAxis));
            const auto at = [&](double distance) {
                return inverseDepthOf(distance / units.length / rayLength, depthReference, frame.orthographic);
            };
            // what lies before the eye limits nothing there
            if (!maps.nearest.empty())
                result.nearest[i] = maps.nearest[i] > 0 ? at(maps.nearest[i]) : noInverseDepthLimit;
            if (!maps.farthest.empty()) result.farthest[i] = at(maps.farthest[i]);
            if (!maps.cutLayerEnd.empty())
                result.cutLayerEnd[i] = maps.cutLayerEnd[i] > 0 ? at(maps.cutLayerEnd[i]) : noInverseDepthLimit;
        }
    });
    return result;
}

double depthReferenceOf(const mesh::BoundingBox& bounds, const CameraFrame& frame, const SceneUnits& units) {
    const double middle = glm::dot(bounds.centre() - frame.eye, frame.forward) / units.length;
    return roundedToFloat(frame.orthographic ? middle : std::max(middle, leastDepthReference));
}

double depthOriginOf(const mesh::BoundingBox& bounds, const CameraFrame& frame, const SceneUnits& units) {
    constexpr double farAway = 4.0;  // scene lengths, of which the mesh's diagonal is one
    const double reference = depthReferenceOf(bounds, frame, units);
    return std::abs(reference) > farAway ? reference : 0.0;
}

}  // namespace tetralux::projection
