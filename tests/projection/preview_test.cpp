// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/engine_registry.h>
#include <projection/frame/preview.h>

#include <cmath>
#include <thread>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/tet/coarse_mesh.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

double ball(const glm::dvec3& x) {
    return std::exp(-8.0 * glm::dot(x - 0.5, x - 0.5));
}

/// An engine that takes a known time: `base` and `perPixel` milliseconds, halved for a mesh of at most half the cells.
class SlowEngine final : public Engine {
public:
    SlowEngine(double base, double perPixel) : base_(base), perPixel_(perPixel) {}
    Image render(const View& view, FrameReport&) override {
        const double pixels = static_cast<double>(view.camera.width) * view.camera.height;
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(base_ + perPixel_ * pixels));
        Image image(view.camera.width, view.camera.height);
        for (glm::vec4& pixel : image.pixels) pixel = {1, 0, 0, 1};
        ++frames;
        return image;
    }
    std::string name() const override { return "slow"; }
    std::string renderer() const override { return "sleep"; }
    int frames = 0;

private:
    double base_, perPixel_;
};

Scene ballScene(int n) {
    return test::sceneOf(test::boxMesh(n, ball), test::smoothFunction(0, 1, 10));
}

TEST(Preview, TakesAsManyPixelsAsTheTimeAllows) {
    const Scene scene = ballScene(3);
    const Camera camera = test::cameraAt({2, 2, 3}, glm::dvec3(0.5), 320, 200);
    SlowEngine engine(2.0, 400.0 / 64000);  // the whole picture would take 402 ms
    const Preview preview = PreviewRenderer(scene, {}, engine).render(camera, 100.0);
    EXPECT_TRUE(preview.kept) << preview.frameMilliseconds;
    EXPECT_LE(preview.frameMilliseconds, 100.0);
    EXPECT_EQ(preview.gridPoints, 0);
    EXPECT_EQ(preview.image.width, 320);
    EXPECT_EQ(preview.image.height, 200);
    // an exact prediction would give (70 − 2)/400 of the pixels; sleeping is never shorter than asked for
    EXPECT_LT(preview.width * preview.height, 0.25 * 64000);
    EXPECT_GT(preview.width * preview.height, 0.03 * 64000) << "and not far fewer";
    EXPECT_NEAR(static_cast<double>(preview.width) / preview.height, 1.6, 0.1);
    EXPECT_EQ(preview.image.at(17, 170), glm::vec4(1, 0, 0, 1));
}

TEST(Preview, IsTheWholePictureWhereTimeSuffices) {
    const Scene scene = ballScene(3);
    SlowEngine engine(1.0, 1e-6);
    const Preview preview =
        PreviewRenderer(scene, {}, engine).render(test::cameraAt({2, 2, 3}, glm::dvec3(0.5), 64, 48), 5000.0);
    EXPECT_TRUE(preview.kept);
    EXPECT_EQ(preview.width, 64);
    EXPECT_EQ(preview.height, 48);
}

TEST(Preview, CoarsensAMeshThatTakesTooLong) {
    const Scene scene = ballScene(36);  // 214,375 cells, of which the slow engine is said to be slow
    SlowEngine engine(400.0, 0.0);
    EngineOptions options;
    options.engine = "cpu";
    const Camera camera = test::cameraAt({2.5, 2, 3}, glm::dvec3(0.5), 64, 64);
    const Preview preview = PreviewRenderer(scene, options, engine).render(camera, 300.0);
    EXPECT_GT(preview.gridPoints, 0);
    EXPECT_LE(preview.gridPoints, 32);
    EXPECT_TRUE(preview.kept) << preview.frameMilliseconds;
    FrameReport report;
    const Image whole = makeEngine(scene, options)->render(camera, report);
    // linear interpolation over spacings of 1/31 or wider, and perhaps fewer pixels: it looks the same
    EXPECT_LT(compareImages(preview.image, whole).rmse, 0.05);
}

TEST(Preview, SaysWhenThePromiseCannotBeKept) {
    const Scene scene = ballScene(3);
    SlowEngine engine(30.0, 0.001);
    const Preview preview =
        PreviewRenderer(scene, {}, engine).render(test::cameraAt({2, 2, 3}, glm::dvec3(0.5), 64, 48), 5.0);
    EXPECT_FALSE(preview.kept);
    EXPECT_GT(preview.frameMilliseconds, 5.0);
    EXPECT_EQ(preview.image.width, 64) << "there is a picture all the same";
    EXPECT_THROW(PreviewRenderer(scene, {}, engine).render(test::cameraAt({2, 2, 3}), 0.0), std::runtime_error);
}

TEST(Resized, KeepsConstantsAndRamps) {
    Image ramp(8, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) ramp.at(x, y) = {(static_cast<float>(x) + 0.5f) / 8, 0.25f, 0, 1};
    const Image large = resized(ramp, 32, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 2; x < 30; ++x) {
            EXPECT_NEAR(large.at(x, y).x, (x + 0.5) / 32, 1e-6);
            EXPECT_NEAR(large.at(x, y).y, 0.25, 1e-7);
        }
    EXPECT_EQ(compareImages(resized(ramp, 8, 4), ramp).max, 0.0);
    EXPECT_THROW(resized(Image(), 4, 4), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::projection

namespace tetralux::mesh {
namespace {

TEST(CoarseMesh, HoldsALinearFieldExactly) {
    const auto linear = [](const glm::dvec3& x) { return 1.0 + 2.0 * x.x - x.y + 0.5 * x.z; };
    const ScalarMesh fine = test::jitteredBoxMesh(9, 0.3, 4, linear);
    const ScalarMesh coarse = coarseMesh(fine, 4);
    EXPECT_EQ(coarse.cells.size(), 5u * 27u) << "a box is filled";
    for (const Tetrahedron& cell : coarse.cells)
        for (const PointIndex p : cell) EXPECT_NEAR(coarse.scalars[p], linear(coarse.positions[p]), 1e-8);
}

TEST(CoarseMesh, LeavesOutWhatIsOutside) {
    const ScalarMesh fine = test::carved(test::boxMesh(17, [](const glm::dvec3& x) { return x.x; }),
                                         [](const glm::dvec3& x) { return glm::length(x - 0.5) > 0.3; });
    const ScalarMesh coarse = coarseMesh(fine, 9);
    EXPECT_LT(coarse.cells.size(), 5u * 512u);
    EXPECT_GT(coarse.cells.size(), 3u * 512u);
    for (const Tetrahedron& cell : coarse.cells) {
        glm::dvec3 centre(0);
        for (const PointIndex p : cell) centre += 0.25 * coarse.positions[p];
        EXPECT_GT(glm::length(centre - 0.5), 0.2) << "a cell in the cavity";
    }
}

}  // namespace
}  // namespace tetralux::mesh
