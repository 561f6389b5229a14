// SPDX-License-Identifier: Apache-2.0
#include <projection/core/camera.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

constexpr int largestSize = 16384, largestWhole = 1 << 20;

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vector, also for lengths whose square leaves the range of double; zero for zero.
glm::dvec3 unit(const glm::dvec3& v) {
    double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

double tangentOfHalfFov(const Camera& camera) {
    return std::tan(camera.fovDegrees * std::numbers::pi / 360.0);
}

}  // namespace

CameraFrame cameraFrame(const Camera& camera) {
    if (camera.width < 1 || camera.height < 1 || camera.width > largestSize || camera.height > largestSize)
        throw std::runtime_error(fmt::format("image size {}x{}: each side must be 1 to {} pixels; give --size WxH",
                                             camera.width, camera.height, largestSize));
    const glm::ivec2 whole = camera.whole == glm::ivec2(0) ? glm::ivec2(camera.width, camera.height) : camera.whole;
    if (camera.tile.x < 0 || camera.tile.y < 0 || whole.x > largestWhole || whole.y > largestWhole ||
        camera.width > whole.x - camera.tile.x || camera.height > whole.y - camera.tile.y)
        throw std::runtime_error(fmt::format("tile of {}x{} pixels at {},{}: does not lie within {}x{} pixels",
                                             camera.width, camera.height, camera.tile.x, camera.tile.y, whole.x,
                                             whole.y));
    if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up) ||
        !std::isfinite(camera.orthographicHeight) || camera.orthographicHeight < 0 ||
        !std::isfinite(camera.windowCentre.x) || !std::isfinite(camera.windowCentre.y) || !std::isfinite(camera.shear))
        throw std::runtime_error("camera: a coordinate is not a finite number; give --eye, --target and --up as x,y,z");
    if (!camera.orthographic() && !(camera.fovDegrees > 0 && camera.fovDegrees < 180))
        throw std::runtime_error(
            fmt::format("field of view {} degrees: must lie between 0 and 180; give --fov DEG", camera.fovDegrees));

    if (!std::isfinite(camera.aspect) || camera.aspect < 0)
        throw std::runtime_error(
            fmt::format("camera: an aspect of {}; give width over height, or 0 for square pixels", camera.aspect));

    CameraFrame frame;
    frame.eye = camera.eye;
    frame.forward = unit(camera.target - camera.eye);
    if (frame.forward == glm::dvec3(0))
        throw std::runtime_error("camera: eye and target are the same point; move --eye or --target");
    glm::dvec3 right = glm::cross(frame.forward, unit(camera.up));
    if (glm::length(right) < 1e-12)
        throw std::runtime_error("camera: up is parallel to the view or zero; give another --up");
    frame.right = glm::normalize(right);
    frame.up = glm::cross(frame.right, frame.forward);
    frame.orthographic = camera.orthographic();
    frame.width = camera.width;
    frame.height = camera.height;
    frame.centre = {0.5 * (whole.x - 1) - 0.5 * whole.x * camera.windowCentre.x - camera.tile.x,
                    0.5 * (whole.y - 1) + 0.5 * whole.y * camera.windowCentre.y - camera.tile.y};

    double imageHeight = frame.orthographic ? camera.orthographicHeight : 2.0 * tangentOfHalfFov(camera);
    const double row = imageHeight / whole.y, column = camera.aspect > 0 ? imageHeight * camera.aspect / whole.x : row;
    frame.rowStretch = row / column;
    frame.rowLean = -camera.shear * frame.rowStretch;
    frame.perPixelRight = frame.right * column;
    frame.perPixelDown = -frame.up * row + frame.rowLean * frame.perPixelRight;
    frame.pixel = glm::length(frame.perPixelRight);
    frame.columnAxis = frame.right + frame.up * (frame.rowLean / frame.rowStretch);
    frame.rowAxis = -frame.up / frame.rowStretch;
    return frame;
}

Ray pixelRay(const CameraFrame& frame, double x, double y) {
    glm::dvec3 offset = (x - frame.centre.x) * frame.perPixelRight + (y - frame.centre.y) * frame.perPixelDown;
    if (frame.orthographic) return {frame.eye + offset, frame.forward};
    return {frame.eye, glm::normalize(frame.forward + offset)};
}

glm::dvec3 threeQuarterEye(const mesh::BoundingBox& bounds, const Camera& camera) {
    // The sphere about the box must fit the narrower side of the image.
    glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, 0.7, 1.5));
    double radius = 0.5 * bounds.diagonal();
    if (radius == 0) radius = 1.0;
    double aspect =
        std::min(1.0, camera.aspect > 0 ? camera.aspect : static_cast<double>(camera.width) / camera.height);
    double halfAngle = std::atan(tangentOfHalfFov(camera) * aspect);
    double distance = camera.orthographic() ? 2.0 * radius : radius / std::sin(halfAngle);
    // up along the direction of view would leave the picture without orientation: step aside
    if (glm::length(glm::cross(direction, unit(camera.up))) < 1e-3)
        direction = glm::normalize(glm::dvec3(1.5, 1.0, 0.7));
    return bounds.centre() + distance * direction;
}

Camera orbited(const Camera& camera, double angle) {
    // Rodrigues' rotation of the eye about `up` through the target
    glm::dvec3 axis = unit(camera.up);
    glm::dvec3 arm = camera.eye - camera.target;
    Camera result = camera;
    result.eye = camera.target + arm * std::cos(angle) + glm::cross(axis, arm) * std::sin(angle) +
                 axis * (glm::dot(axis, arm) * (1.0 - std::cos(angle)));
    return result;
}

}  // namespace tetralux::projection
