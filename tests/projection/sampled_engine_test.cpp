// SPDX-License-Identifier: Apache-2.0
//
// Anti-aliasing: pixels are means of rays at known places, in every engine and mode, with everything a picture has.
#include <gtest/gtest.h>

#include <mesh/tet/procedural_field.h>
#include <projection/core/clip_region.h>
#include <projection/frame/sampled_engine.h>
#include <projection/frame/verification.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

const std::vector<std::string> allEngines{"reference", "cpu", "gl"};

Scene withSamplesPerPixel(Scene scene, int samples) {
    scene.settings.samples = samples;
    return scene;
}

TEST(Samples, AreTheNextSquareNumber) {
    for (const auto& [samples, perAxis] : {std::pair(1, 1), std::pair(2, 2), std::pair(4, 2), std::pair(5, 3),
                                           std::pair(9, 3), std::pair(16, 4), std::pair(64, 8)})
        EXPECT_EQ(samplesPerAxis(samples), perAxis) << samples;
}

// 1 − exp(−τ l) of the rays through (i + ½)/n of the pixel, whose lengths follow from the box.
TEST(Samples, StandOnAGridInEachPixel) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 30, 24);
    const CameraFrame frame = cameraFrame(camera);
    const Scene scene = sceneOf(boxMesh(3, [](const glm::dvec3& p) { return p.x; }), constantFunction(1.7));
    for (const int perAxis : {2, 3})
        for (const std::string& engine : allEngines) {
            const Image image = pictureOf(withSamplesPerPixel(scene, perAxis * perAxis), camera, {engine, "auto"});
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    double sum = 0;
                    for (int j = 0; j < perAxis; ++j)
                        for (int i = 0; i < perAxis; ++i) {
                            const Ray ray =
                                pixelRay(frame, x + (i + 0.5) / perAxis - 0.5, y + (j + 0.5) / perAxis - 0.5);
                            const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
                            sum -= std::expm1(-1.7 * std::max(0.0, out - in));
                        }
                    ASSERT_NEAR(image.at(x, y).w, sum / (perAxis * perAxis), 1e-5) << engine << ' ' << x << ' ' << y;
                }
        }
}

// An opaque half-space whose edge is a slanted line: the mean of many samples tends to the area it covers.
TEST(Samples, TendToTheAreaCovered) {
    Camera camera = cameraAt({0.5, 0.5, 4}, glm::dvec3(0.5), 16, 16);
    camera.orthographicHeight = 0.8;  // within the box
    preint::TransferFunction function = constantFunction(1e6);
    function.extinction = {{0.5, 0.0}, {0.5, 1e6}};
    const auto slant = [](const glm::dvec3& p) { return p.x + 0.37 * (p.y - 0.5); };
    const Scene scene = sceneOf(boxMesh(4, slant), function);
    const double pixel = 0.8 / 16;
    for (const std::string& engine : allEngines) {
        const Image image = pictureOf(withSamplesPerPixel(scene, 64), camera, {engine, "auto"});
        int edges = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                const double middle = 0.1 + pixel * (x + 0.5) + 0.37 * (0.4 - pixel * (y + 0.5)) - 0.5;
                double area = 0;  // of many thin strips
                for (int strip = 0; strip < 1000; ++strip) {
                    const double edge = middle / pixel + 0.37 * ((strip + 0.5) / 1000 - 0.5);
                    area += std::clamp(edge + 0.5, 0.0, 1.0) / 1000;
                }
                edges += area > 0.01 && area < 0.99 ? 1 : 0;
                ASSERT_NEAR(image.at(x, y).w, area, 0.04) << engine << ' ' << x << ' ' << y;
            }
        EXPECT_GT(edges, 10);
    }
}

Scene everything(Mode mode) {
    Scene scene = sceneOf(sampledMesh(mesh::proceduralField("bucky", 9), 9), smoothFunction(0, 1, 8.0), mode);
    scene.transferFunction.isosurfaces = {{0.63, 0.9, {1, 0.5, 0.1}}};
    scene.mapSources.push_back(std::make_shared<ClipRegion>(
        std::vector<HalfSpace>{{scene.mesh->bounds.centre() + glm::dvec3(0.1, 0, 0), {-1, -0.4, 0.3}}}, 0.0));
    return scene;
}

// Isosurfaces, clip planes, the mesh's outline: what holds for one sample holds for the mean of four.
TEST(Samples, EnginesAgree) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::Mip, Mode::Average, Mode::Additive,
                            Mode::FirstHit, Mode::Depth, Mode::Absorption}) {
        const Scene scene = withSamplesPerPixel(everything(mode), 4);
        Camera camera = cameraAt({0, 0, 0}, scene.mesh->bounds.centre(), 40, 32);
        camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
        // a rim of a surface may fall into a neighbouring sample, a quarter of a pixel
        expectEnginesAgree(scene, camera, {2e-3, 0.2}, "four samples");
    }
}

// The reference looks at all samples of a pixel, and at the maps that they were drawn with.
TEST(Samples, AreVerified) {
    const Scene scene = withSamplesPerPixel(everything(Mode::Standard), 9);
    Camera camera = cameraAt({0, 0, 0}, scene.mesh->bounds.centre(), 40, 32);
    camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
    FrameReport report;
    const Image image = makeEngine(scene, {"cpu", "auto"})->render(camera, report);
    ASSERT_NE(report.maps, nullptr);
    EXPECT_LE(verifyImage(image, scene, {camera, report.maps.get()}, 400, 1).rmse, 1e-5);
    const Image one = pictureOf(withSamplesPerPixel(scene, 1), camera, {"cpu", "auto"});
    EXPECT_GT(verifyImage(one, scene, {camera, report.maps.get()}, 400, 1).rmse, 5e-3);
}

// What a caller says of a pixel holds for all of its samples.
TEST(Samples, TakeTheMapsOfTheirPixel) {
    const Scene scene = sceneOf(boxMesh(3, [](const glm::dvec3& p) { return p.x; }), constantFunction(1.7));
    const Camera camera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 20, 16);
    PixelMaps maps;
    maps.farthest.assign(20 * 16, 1e30);
    maps.farthest[8 * 20 + 10] = 0.0;
    const Image image = pictureOf(withSamplesPerPixel(scene, 4), {camera, &maps}, {"cpu", "auto"});
    const Image whole = pictureOf(withSamplesPerPixel(scene, 4), camera, {"cpu", "auto"});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 20; ++x)
            EXPECT_NEAR(image.at(x, y).w, x == 10 && y == 8 ? 0.0f : whole.at(x, y).w, 1e-6f) << x << ' ' << y;
    EXPECT_GT(whole.at(10, 8).w, 0.5f);
}

}  // namespace
}  // namespace tetralux::projection
