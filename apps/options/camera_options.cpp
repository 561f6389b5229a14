// SPDX-License-Identifier: Apache-2.0
#include <apps/options/camera_options.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <apps/add_option.h>
#include <apps/option_values.h>

namespace tetralux::apps {

namespace {

bool anyAngle(double) {
    return true;
}

/// What says where from; at most one of them may be given.
void checkChoice(const CameraOptions& options) {
    const int given = (options.eye ? 1 : 0) + (options.view.empty() ? 0 : 1) + (options.direction ? 1 : 0);
    if (given > 1) throw std::runtime_error("--eye, --view and --direction each say where from; give one of them");
    if (options.target && !options.eye && given == 1)
        throw std::runtime_error(
            "--target: the view is fitted to what shows; leave it out, or give --eye instead of --view or --direction");
    if (options.orthographic && options.orthographicHeight > 0.0)
        throw std::runtime_error("--orthographic finds the height that --height gives; leave one of them out");
    if (options.orthographic && options.eye)
        throw std::runtime_error("--orthographic fits the view; with --eye give --height H instead");
}

void addCorners(const mesh::BoundingBox& box, std::vector<glm::dvec3>& points) {
    for (int corner = 0; corner < 8; ++corner)
        points.emplace_back((corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                            (corner & 4) != 0 ? box.high.z : box.low.z);
}

/// Points all over the sphere about the box of `points`.
std::vector<glm::dvec3> sphereAbout(const std::vector<glm::dvec3>& points) {
    constexpr int count = 500;
    glm::dvec3 low(points.front()), high(points.front());
    for (const glm::dvec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double radius = 0.5 * glm::length(high - low), golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    std::vector<glm::dvec3> sphere;
    for (int i = 0; i < count; ++i) {  // a spiral from pole to pole
        const double z = 1.0 - (2.0 * i + 1.0) / count, across = std::sqrt(1.0 - z * z);
        sphere.push_back(0.5 * (low + high) +
                         radius * glm::dvec3(across * std::cos(golden * i), across * std::sin(golden * i), z));
    }
    return sphere;
}

projection::ViewDirection directionFor(const CameraOptions& options) {
    projection::ViewDirection view;
    if (!options.view.empty()) view = projection::namedView(options.view);
    if (options.direction) {
        view.forward = *options.direction;
        // along the usual up a view has no orientation
        if (glm::length(glm::cross(glm::normalize(view.forward), view.up)) < 1e-3) view.up = {0, 0, 1};
    }
    view.up = options.up.value_or(view.up);
    const glm::dvec3 up = glm::normalize(view.up);
    // likewise along an up that was given, where the direction is ours
    if (options.view.empty() && !options.direction && glm::length(glm::cross(glm::normalize(view.forward), up)) < 1e-3)
        view.forward = {-1.5, -1.0, -0.7};
    return projection::turned(view, options.turn);
}

}  // namespace

void addCameraOptions(CLI::App& command, CameraOptions& options) {
    addParsed(command, "--size", options.size, parseSize, "pixels, 512x512", "WxH");
    addParsed(
        command, "--view", options.view,
        [](const std::string& option, const std::string& text) {
            try {
                projection::namedView(text);
            } catch (const std::runtime_error& error) {
                throw std::runtime_error(fmt::format("{}: {}", option, error.what()));
            }
            return text;
        },
        fmt::format("from which side, fitted tightly to what shows: {}; x: the eye stands at large x and looks along "
                    "-x; up is z "
                    "(of z, -z: y); iso: from 1,1,1",
                    fmt::join(projection::viewNames(), ", ")),
        "SIDE");
    addParsed(
        command, "--direction", options.direction,
        [](const std::string& option, const std::string& text) {
            const glm::dvec3 direction = parseVector(option, text);
            if (direction == glm::dvec3(0))
                throw std::runtime_error(fmt::format("{}: 0,0,0 points nowhere; give a direction", option));
            return direction;
        },
        "along which direction the eye looks, fitted tightly to what shows", "dx,dy,dz");
    addParsed(command, "--eye", options.eye, parseVector,
              "where from; default: a three-quarter view that holds the mesh", "x,y,z");
    addParsed(command, "--target", options.target, parseVector, "where to; default: the mesh's centre", "x,y,z");
    addParsed(command, "--up", options.up, parseVector, "what is up; default: 0,1,0, or as --view says", "x,y,z");
    addNumber<double>(command, "--azimuth", options.turn.azimuth, anyAngle, "a finite number of degrees",
                      "turns the eye about up, degrees, as vtkCamera does");
    addNumber<double>(command, "--elevation", options.turn.elevation, anyAngle, "a finite number of degrees",
                      "then raises the eye, degrees");
    addNumber<double>(command, "--roll", options.turn.roll, anyAngle, "a finite number of degrees",
                      "then turns up about the direction of view, degrees");
    addNumber<double>(command, "--zoom", options.zoom, positive, "a factor above 0",
                      "narrows the view by this factor: above 1 nearer, below 1 farther");
    addNumber<double>(
        command, "--fov", options.fovDegrees, [](double value) { return value > 0.0 && value < 180.0; },
        "degrees between 0 and 180", "vertical field of view in degrees, 30");
    addNumber<double>(command, "--height", options.orthographicHeight, positive, "a length in mesh units",
                      "orthographic view of this height in mesh units");
    command.add_flag("--orthographic", options.orthographic, "orthographic view, as high as what shows asks for");
}

projection::Camera cameraFor(const CameraOptions& options, const projection::Scene& scene,
                             const projection::SceneParts& parts, const projection::Margins& margins, bool boxToo) {
    checkChoice(options);
    projection::Camera camera;
    camera.width = options.size.x;
    camera.height = options.size.y;
    camera.fovDegrees = options.fovDegrees;
    camera.orthographicHeight = options.orthographic ? 1.0 : options.orthographicHeight;
    if (options.eye) {
        camera.eye = *options.eye;
        camera.target = options.target.value_or(scene.mesh->bounds.centre());
        camera.up = options.up.value_or(camera.up);
        if (!options.turn.none()) camera = projection::turned(camera, options.turn);
    } else {
        const bool toWhatShows = !options.view.empty() || options.direction.has_value();
        std::vector<glm::dvec3> points = projection::shownPoints(scene, parts, toWhatShows);
        if (points.empty()) points = projection::shownPoints(scene, {}, false);
        if (boxToo) addCorners(scene.mesh->bounds, points);
        projection::Margins free = margins;
        if (options.orbits) {  // about the middle of the picture
            points = sphereAbout(points);
            free.left = free.right = std::max(margins.left, margins.right);
            free.top = free.bottom = std::max(margins.top, margins.bottom);
        }
        camera = projection::fitted(camera, directionFor(options), points, free);
        if (options.target) {
            camera.eye += *options.target - camera.target;
            camera.target = *options.target;
        }
        if (!options.orthographic && options.orthographicHeight > 0.0)
            camera.orthographicHeight = options.orthographicHeight;
    }
    if (options.zoom != 1.0) camera = projection::zoomed(camera, options.zoom);
    projection::cameraFrame(camera);  // throws now rather than after preparing
    return camera;
}

}  // namespace tetralux::apps
