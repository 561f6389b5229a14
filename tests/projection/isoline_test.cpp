// SPDX-License-Identifier: Apache-2.0
//
// Isolines on slices of a cube with a linear scalar: straight lines, so that what they cover of a pixel has a closed
// form, in every engine.
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/frame/engine_registry.h>
#include <projection/opaque/opaque_layer.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

double linear(const glm::dvec3& x) {
    return 0.2 + 0.5 * x.x + 0.25 * x.y;
}

const Slice slice{{0.5, 0.5, 0.4}, {0, 0, 1}};
const glm::dvec3 ink{0.1, 0.9, 0.2};

OpaqueObjects withLines(double opacity, double width) {
    OpaqueObjects objects;
    objects.slices = {slice};
    objects.slices[0].opacity = opacity;
    objects.isolines = {{0.35, 0.5, 0.65}, width, ink};
    return objects;
}

/// Where a point is in the image, from the camera's definition.
glm::dvec2 pixelOf(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye),
                     right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    const glm::dvec3 p = point - camera.eye;
    const double half = camera.orthographic()
                            ? 0.5 * camera.orthographicHeight
                            : glm::dot(p, forward) * std::tan(camera.fovDegrees * std::acos(-1.0) / 360.0);
    const double scale = 0.5 * camera.height / half;
    return {0.5 * (camera.width - 1) + scale * glm::dot(p, right), 0.5 * (camera.height - 1) - scale * glm::dot(p, up)};
}

/// The line of value v across the slice's unit square: 0.5·x + 0.25·y = v − 0.2.
std::pair<glm::dvec3, glm::dvec3> lineOf(double value) {
    const auto xAt = [&](double y) { return (value - 0.2 - 0.25 * y) / 0.5; };
    const auto yAt = [&](double x) { return (value - 0.2 - 0.5 * x) / 0.25; };
    const glm::dvec3 low = yAt(1.0) >= 0 ? glm::dvec3(1, yAt(1.0), 0.4) : glm::dvec3(xAt(0.0), 0, 0.4);
    const glm::dvec3 high = yAt(0.0) <= 1 ? glm::dvec3(0, yAt(0.0), 0.4) : glm::dvec3(xAt(1.0), 1, 0.4);
    return {low, high};
}

double expectedShare(const Camera& camera, const Isolines& lines, int x, int y) {
    double nearest = 1e300;
    for (const double value : lines.values) {
        const auto [low, high] = lineOf(value);
        const glm::dvec2 from = pixelOf(camera, low), along = pixelOf(camera, high) - from, p = glm::dvec2(x, y) - from;
        const double t = std::clamp(glm::dot(p, along) / glm::dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(p - t * along));
    }
    return std::max(0.0, std::min(0.5, nearest + 0.5 * lines.width) - std::max(-0.5, nearest - 0.5 * lines.width));
}

/// \returns how many pixels have some of a line.
int holdToClosedForm(const Camera& camera, const OpaqueObjects& objects) {
    Scene scene = sceneOf(jitteredBoxMesh(7, 0.3, 5, linear), constantFunction(0.0));
    scene.transferFunction = smoothFunction(0.0, 1.0, 0.0);
    scene.mapSources.push_back(std::make_shared<const OpaqueLayer>(scene, objects));
    const CameraFrame frame = cameraFrame(camera);
    int covered = 0;
    for (const std::string& name : engineNames()) {
        FrameReport report;
        EngineOptions options;
        options.engine = name;
        const Image image = makeEngine(scene, options)->render(camera, report);
        covered = 0;
        double worst = 0;
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                const Ray ray = pixelRay(frame, x, y);
                const double t = (0.4 - ray.origin.z) / ray.direction.z;
                const glm::dvec3 place = ray.origin + t * ray.direction;
                if (std::min({place.x, place.y, 1 - place.x, 1 - place.y}) < 1e-3) continue;
                const double share = expectedShare(camera, objects.isolines, x, y), a = objects.slices[0].opacity;
                const glm::dvec4 expected =
                    (1 - share) * a * glm::dvec4(scene.transferFunction.colorAt(linear(place)), 1.0) +
                    share * glm::dvec4(ink, 1.0);
                for (int channel = 0; channel < 4; ++channel)
                    worst = std::max(worst, std::abs(expected[channel] - static_cast<double>(image.at(x, y)[channel])));
                covered += share > 0 ? 1 : 0;
            }
        EXPECT_LE(worst, 1e-6) << name;
    }
    return covered;
}

TEST(Isolines, HaveAConstantWidthInPixels) {
    for (const double width : {0.4, 1.5, 5.0}) {
        EXPECT_GT(holdToClosedForm(cameraAt({1.9, 1.4, 2.3}), withLines(1.0, width)), 50) << width;
        EXPECT_GT(holdToClosedForm(cameraAt({0.6, 0.1, 0.7}, {0.5, 0.6, 0.4}), withLines(1.0, width)), 50)
            << "partly behind the eye";
    }
    Camera flat = cameraAt({2.1, 1.7, 2.6});
    flat.orthographicHeight = 1.6;
    EXPECT_GT(holdToClosedForm(flat, withLines(1.0, 1.5)), 50);
}

TEST(Isolines, AreOpaqueOnClearSlices) {
    for (const double opacity : {0.0, 0.3})
        EXPECT_GT(holdToClosedForm(cameraAt({1.9, 1.4, 2.3}), withLines(opacity, 2.0)), 50);
}

TEST(Isolines, StandOutFromTheSlice) {
    Scene scene = sceneOf(boxMesh(5, linear), constantFunction(0.0));
    scene.transferFunction.color = {{0.45, {1, 1, 1}}, {0.45, {0.2, 0, 0.3}}};  // bright below, dark above
    OpaqueObjects objects = withLines(1.0, 3.0);
    objects.isolines.color.reset();
    scene.mapSources.push_back(std::make_shared<const OpaqueLayer>(scene, objects));
    const Camera camera = cameraAt({0.5, 0.5, 3}, {0.5, 0.5, 0.4}, 64, 64);
    FrameReport report;
    const Image image = makeEngine(scene, {})->render(camera, report);
    const auto redAt = [&](double value) {
        const auto [low, high] = lineOf(value);
        const glm::dvec2 pixel = pixelOf(camera, 0.5 * (low + high));
        return image.at(static_cast<int>(std::lround(pixel.x)), static_cast<int>(std::lround(pixel.y))).x;
    };
    EXPECT_EQ(redAt(0.35), 0.0f);
    EXPECT_EQ(redAt(0.65), 1.0f);
}

}  // namespace
}  // namespace tetralux::projection
