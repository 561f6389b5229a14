// SPDX-License-Identifier: Apache-2.0
#include <apps/view/camera_moves.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <projection/core/fitted_view.h>

namespace tetralux::apps::view {

namespace {

constexpr double perDegree = std::numbers::pi / 180.0;
constexpr double polarDegrees = 89.0;  // at 90 the direction of view would be along up

/// Rodrigues' rotation about `axis` of length 1.
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
}

double distanceOf(const projection::Camera& camera) {
    return glm::length(camera.target - camera.eye);
}

/// Mesh units of a pixel at the target's distance.
double pixelLength(const projection::Camera& camera) {
    const double height = camera.orthographic()
                              ? camera.orthographicHeight
                              : 2.0 * distanceOf(camera) * std::tan(0.5 * camera.fovDegrees * perDegree);
    return height / camera.height;
}

std::string text(const glm::dvec3& v) {
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

}  // namespace

projection::Camera turntable(const projection::Camera& camera, glm::dvec2 degrees) {
    const glm::dvec3 up = glm::normalize(camera.up);
    const glm::dvec3 back = camera.eye - camera.target;
    const double height = std::asin(std::clamp(glm::dot(glm::normalize(back), up), -1.0, 1.0)) / perDegree;
    const double most = std::max(polarDegrees, std::abs(height));
    const double raise = std::clamp(height + degrees.y, -most, most) - height;
    const glm::dvec3 right = projection::cameraFrame(camera).right;
    projection::Camera turned = camera;
    turned.eye = camera.target + rotated(rotated(back, right, -raise * perDegree), up, degrees.x * perDegree);
    return turned;
}

projection::Camera trackball(const projection::Camera& camera, glm::dvec2 degrees) {
    const projection::CameraFrame frame = projection::cameraFrame(camera);
    const auto turn = [&](const glm::dvec3& v) {
        return rotated(rotated(v, frame.right, -degrees.y * perDegree), frame.up, degrees.x * perDegree);
    };
    projection::Camera turned = camera;
    turned.eye = camera.target + turn(camera.eye - camera.target);
    turned.up = turn(frame.up);
    return turned;
}

projection::Camera rolled(const projection::Camera& camera, double degrees) {
    projection::Camera turned = camera;
    turned.up =
        rotated(projection::cameraFrame(camera).up, projection::cameraFrame(camera).forward, -degrees * perDegree);
    return turned;
}

projection::Camera panned(const projection::Camera& camera, glm::dvec2 pixels) {
    const projection::CameraFrame frame = projection::cameraFrame(camera);
    const glm::dvec3 shift = pixelLength(camera) * (pixels.y * frame.up - pixels.x * frame.right);
    projection::Camera moved = camera;
    moved.eye += shift;
    moved.target += shift;
    return moved;
}

projection::Camera zoomedTo(const projection::Camera& camera, double factor, glm::dvec2 pixel) {
    const glm::dvec2 off = pixel - 0.5 * (glm::dvec2(camera.width, camera.height) - 1.0);
    projection::Camera moved = camera;
    if (camera.orthographic())
        moved.orthographicHeight = camera.orthographicHeight / factor;
    else
        moved.eye = camera.target + (camera.eye - camera.target) / factor;
    return panned(moved, off * (1.0 - factor));
}

projection::Camera centred(const projection::Camera& camera, glm::dvec3 point) {
    projection::Camera moved = camera;
    moved.eye += point - camera.target;
    moved.target = point;
    return moved;
}

projection::Camera withOtherProjection(const projection::Camera& camera) {
    projection::Camera other = camera;
    const double tangent = std::tan(0.5 * camera.fovDegrees * perDegree);
    if (camera.orthographic()) {
        other.eye =
            camera.target + glm::normalize(camera.eye - camera.target) * (0.5 * camera.orthographicHeight / tangent);
        other.orthographicHeight = 0.0;
    } else {
        other.orthographicHeight = 2.0 * distanceOf(camera) * tangent;
    }
    return other;
}

void removeCamera(OptionWords& words) {
    for (const char* name : {"--eye", "--target", "--up", "--view", "--direction", "--azimuth", "--elevation", "--roll",
                             "--zoom", "--height", "--orthographic"})
        words.remove(name);
}

void setCamera(OptionWords& words, const projection::Camera& camera) {
    removeCamera(words);
    words.set("--eye", text(camera.eye));
    words.set("--target", text(camera.target));
    words.set("--up", text(camera.up));
    if (camera.orthographic()) words.set("--height", fmt::format("{}", camera.orthographicHeight));
    words.set("--fov", fmt::format("{}", camera.fovDegrees));
}

bool hasCamera(const OptionWords& words) {
    return words.has("--eye") && words.has("--target") && words.has("--up") && words.has("--fov");
}

}  // namespace tetralux::apps::view
