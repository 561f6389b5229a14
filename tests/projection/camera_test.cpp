// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/core/camera.h>

namespace tetralux::projection {
namespace {

Camera wideCamera() {
    Camera camera;
    camera.eye = {1.9, 1.4, 2.3};
    camera.target = {0.5, 0.5, 0.5};
    camera.width = 640;
    camera.height = 480;
    return camera;
}

// the definition, written out with other operations than the code's
glm::dvec3 definedDirection(const Camera& c, int x, int y) {
    const glm::dvec3 f = glm::normalize(c.target - c.eye), r = glm::normalize(glm::cross(f, c.up)),
                     u = glm::cross(r, f);
    const double t = std::tan(c.fovDegrees / 2 * std::numbers::pi / 180);
    return glm::normalize(f + ((2 * (x + 0.5) - c.width) / c.height) * t * r +
                          ((c.height - 2 * (y + 0.5)) / c.height) * t * u);
}

TEST(Camera, RaysFollowTheDefinition) {
    const Camera camera = wideCamera();
    const CameraFrame frame = cameraFrame(camera);
    for (auto [x, y] : {std::pair{0, 0}, {639, 0}, {0, 479}, {639, 479}, {320, 240}, {17, 401}}) {
        const Ray ray = pixelRay(frame, x, y);
        EXPECT_LT(glm::distance(ray.direction, definedDirection(camera, x, y)), 1e-15);
        EXPECT_EQ(ray.origin, camera.eye);
    }
}

TEST(Camera, OrthographicRaysAreParallelAndSpanTheHeight) {
    Camera camera = wideCamera();
    camera.orthographicHeight = 3.0;
    const CameraFrame frame = cameraFrame(camera);
    const Ray top = pixelRay(frame, 100, -0.5), bottom = pixelRay(frame, 100, 479.5);
    EXPECT_EQ(top.direction, bottom.direction);
    EXPECT_NEAR(glm::distance(top.origin, bottom.origin), 3.0, 1e-14);
    EXPECT_GT(glm::dot(top.origin - bottom.origin, camera.up), 0);
}

TEST(Camera, OrbitKeepsDistanceAndHeightAndReturns) {
    const Camera camera = wideCamera();
    const Camera quarter = orbited(camera, std::numbers::pi / 2);
    EXPECT_NEAR(glm::distance(quarter.eye, camera.target), glm::distance(camera.eye, camera.target), 1e-14);
    EXPECT_NEAR(quarter.eye.y, camera.eye.y, 1e-14);
    EXPECT_LT(glm::distance(orbited(camera, 2 * std::numbers::pi).eye, camera.eye), 1e-14);
}

TEST(Camera, ThreeQuarterViewHoldsTheWholeBox) {
    Camera camera;
    camera.width = 300;
    camera.height = 700;  // narrow: the width decides
    const mesh::BoundingBox box{{-2, 5, 1}, {4, 6, 11}};
    camera.target = box.centre();
    camera.eye = threeQuarterEye(box, camera);
    const CameraFrame frame = cameraFrame(camera);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                           corner & 4 ? box.high.z : box.low.z};
        const glm::dvec3 v = p - camera.eye;
        const double depth = glm::dot(v, frame.forward), pixel = glm::length(frame.perPixelRight);
        EXPECT_LT(std::abs(glm::dot(v, frame.right) / depth / pixel), 150);
        EXPECT_LT(std::abs(glm::dot(v, frame.up) / depth / pixel), 350);
    }
}

TEST(Camera, RefusesWhatNoPictureCanComeOf) {
    auto refuses = [](auto change, const char* word) {
        Camera camera = wideCamera();
        change(camera);
        try {
            cameraFrame(camera);
            ADD_FAILURE() << "accepted: " << word;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refuses([](Camera& c) { c.width = 0; }, "--size");
    refuses([](Camera& c) { c.height = 100000; }, "--size");
    refuses([](Camera& c) { c.target = c.eye; }, "--target");
    refuses([](Camera& c) { c.up = c.target - c.eye; }, "--up");
    refuses([](Camera& c) { c.up = glm::dvec3(0); }, "--up");
    refuses([](Camera& c) { c.eye.x = std::nan(""); }, "--eye");
    refuses([](Camera& c) { c.fovDegrees = 180; }, "--fov");
    refuses([](Camera& c) { c.fovDegrees = 0; }, "--fov");
}

}  // namespace
}  // namespace tetralux::projection
