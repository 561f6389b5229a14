// SPDX-License-Identifier: Apache-2.0
#include <projection/core/clip_region.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Interval {
    double begin = -infinity, end = infinity;
    double layerEnd = 0.0;
    glm::dvec3 normal{0};  // of the plane through which the ray comes in, towards the eye; 0: none
};

Interval intervalOf(const std::vector<HalfSpace>& halfSpaces, double cutLayer, const Ray& ray) {
    Interval interval;
    for (const HalfSpace& half : halfSpaces) {
        const double inside = glm::dot(ray.origin - half.point, half.normal);
        const double rate = glm::dot(ray.direction, half.normal);
        if (rate == 0) {
            if (inside < 0) return {infinity, infinity};
            continue;
        }
        const double t = -inside / rate;
        if (rate < 0) {
            interval.end = std::min(interval.end, t);
        } else if (t > interval.begin) {
            interval.begin = t;
            interval.layerEnd = cutLayer > 0 ? t + cutLayer / rate : 0.0;
            interval.normal = -half.normal;
        }
    }
    return interval;
}

}  // namespace

std::vector<HalfSpace> boxHalfSpaces(const glm::dvec3& low, const glm::dvec3& high) {
    std::vector<HalfSpace> result;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0);
        normal[axis] = 1;
        result.push_back({low, normal});
        result.push_back({high, -normal});
    }
    return result;
}

std::vector<HalfSpace> slabHalfSpaces(const glm::dvec3& point, const glm::dvec3& normal, double thickness) {
    const glm::dvec3 half = 0.5 * thickness * glm::normalize(normal);
    return {{point - half, normal}, {point + half, -normal}};
}

ClipRegion::ClipRegion(std::vector<HalfSpace> halfSpaces, double cutLayer)
    : halfSpaces_(std::move(halfSpaces)), cutLayer_(cutLayer) {
    if (!(cutLayer >= 0) || !std::isfinite(cutLayer))
        throw std::runtime_error(fmt::format("clip plane: a layer of {}; give a length from 0", cutLayer));
    for (HalfSpace& half : halfSpaces_) {
        const double largest = std::max({std::abs(half.normal.x), std::abs(half.normal.y), std::abs(half.normal.z)});
        const double sum = half.point.x + half.point.y + half.point.z;
        if (!(largest > 0) || !std::isfinite(largest) || !std::isfinite(sum))
            throw std::runtime_error(
                fmt::format("clip plane: normal {},{},{} at {},{},{} has no direction or place; give "
                            "finite numbers, not all of the normal 0",
                            half.normal.x, half.normal.y, half.normal.z, half.point.x, half.point.y, half.point.z));
        half.normal = glm::normalize(half.normal / largest);
    }
}

glm::dvec2 ClipRegion::within(const Ray& ray) const {
    const Interval interval = intervalOf(halfSpaces_, 0.0, ray);
    return {interval.begin, interval.end};
}

void ClipRegion::apply(const Camera& camera, PixelMaps& maps) const {
    const CameraFrame frame = cameraFrame(camera);
    const auto width = static_cast<std::size_t>(camera.width), height = static_cast<std::size_t>(camera.height);
    if (halfSpaces_.empty()) return;
    cutNearer(camera, maps, 0, {});  // makes the maps
    cutFarther(camera, maps, 0, infinity);
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const Interval interval =
                intervalOf(halfSpaces_, cutLayer_, pixelRay(frame, static_cast<double>(x), static_cast<double>(y)));
            const std::size_t pixel = y * width + x;
            cutNearer(camera, maps, pixel, {interval.begin, interval.layerEnd, glm::vec3(interval.normal)});
            cutFarther(camera, maps, pixel, interval.end);
        }
    });
}

}  // namespace tetralux::projection
