// SPDX-License-Identifier: Apache-2.0
//
// Locally adaptive opacity: closed forms on boxes, independence of the mesh, engines against each other. The paper's
// equations on an irregular mesh: tests/outside/check_adaptive.py.
#include <gtest/gtest.h>

#include <mesh/io/read_mesh.h>
#include <projection/frame/adaptive_opacity.h>
#include <projection/frame/contribution_map.h>
#include <projection/frame/verification.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;
using Unit = AdaptiveSettings::Unit;
using Filter = AdaptiveSettings::Filter;

const EngineOptions reference{"reference", "auto"};
const std::vector<std::string> allEngines{"reference", "cpu", "gl"};

AdaptiveSettings pieces(double length, double most = 0.12) {
    AdaptiveSettings settings;
    settings.unit = Unit::Length;
    settings.pieceLength = length;
    settings.most = most;
    return settings;
}

AdaptiveSettings wholeCells(double most = 0.12) {
    AdaptiveSettings settings;
    settings.most = most;
    return settings;
}

Scene boxScene(int n, Mode mode, const AdaptiveSettings& adaptive,
               const preint::TransferFunction& function = constantFunction(1.7)) {
    Scene scene = sceneOf(boxMesh(n, [](const glm::dvec3& p) { return p.x; }), function, mode);
    scene.settings.adaptive = adaptive;
    return scene;
}

/// Way of a pixel's ray through the unit box, and through its part with x > 0.4.
struct Ways {
    double whole, part;
};
Ways waysOf(const CameraFrame& frame, int x, int y) {
    const Ray ray = pixelRay(frame, x, y);
    const auto way = [&](const glm::dvec3& low) {
        const auto [in, out] = pathInBox(ray, low, glm::dvec3(1));
        return std::max(0.0, out - in);
    };
    return {way(glm::dvec3(0)), way({0.4, 0, 0})};
}

// 1 − (1 − τ̃)^(X/Δ), whatever the extinction is; below the bound it tends to 1 − 1/e.
TEST(AdaptiveOpacity, LengthIsCountedInPieces) {
    const double piece = 0.07;
    for (const double most : {0.12, 0.02}) {
        const Camera camera = cameraAt({1.9, 1.4, 2.3});
        const CameraFrame frame = cameraFrame(camera);
        for (const std::string& engine : allEngines) {
            const Image image = pictureOf(boxScene(3, Mode::Standard, pieces(piece, most)), camera, {engine, "auto"});
            int bounded = 0, free = 0;
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    const double count = waysOf(frame, x, y).whole / piece;
                    if (count < 1e-6) continue;
                    1.0 / count > most ? ++bounded : ++free;
                    const double opacity = std::min(most, 1.0 / count);
                    ASSERT_NEAR(image.at(x, y).w, 1.0 - std::pow(1.0 - opacity, count), 1e-5)
                        << engine << ' ' << x << ' ' << y;
                }
            EXPECT_GT(bounded, 20);
            if (most > 0.1) {
                EXPECT_GT(free, 100);
            }
        }
    }
}

// Equation 8: N cells of opacity 1/N. The segments are counted by the caster, the formula is the paper's.
TEST(AdaptiveOpacity, CellsAreAsOpaqueAsEachOther) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    for (const double most : {0.12, 1.0}) {
        const Scene scene = boxScene(5, Mode::Standard, wholeCells(most));
        const ReferenceRayCaster caster(scene);
        for (const std::string& engine : allEngines) {
            const Image image = pictureOf(scene, camera, {engine, "auto"});
            for (int y = 1; y < camera.height; y += 3)
                for (int x = 1; x < camera.width; x += 3) {
                    const auto count = static_cast<double>(caster.segmentsAt(camera, x, y).size());
                    if (count == 0) continue;
                    const double opacity = std::min(1.0 / count, most);
                    ASSERT_NEAR(image.at(x, y).w, 1.0 - std::pow(1.0 - opacity, count), 2e-5)
                        << engine << ' ' << x << ' ' << y;
                }
        }
    }
}

// How opaque the transfer function is has no say, only where it is 0.
TEST(AdaptiveOpacity, TheFunctionSaysOnlyWhatIsRelevant) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    preint::TransferFunction thin = constantFunction(1e-3), ramp = constantFunction(1.0);
    ramp.extinction = {{0.0, 0.5}, {0.5, 40.0}, {1.0, 2.0}};
    for (const AdaptiveSettings& settings : {pieces(0.1), wholeCells()}) {
        const Image wanted = pictureOf(boxScene(4, Mode::Standard, settings), camera, reference);
        for (const auto& function : {thin, ramp})
            for (const std::string& engine : allEngines)
                EXPECT_LE(
                    compareImages(pictureOf(boxScene(4, Mode::Standard, settings, function), camera, {engine, "auto"}),
                                  wanted)
                        .max,
                    2e-5)
                    << engine;
    }
}

// Equation 13: the mean of the colour along what is relevant, here x from 0.4 to 1 with a colour that is x itself.
TEST(AdaptiveOpacity, AdditiveIsTheMeanOfWhatIsRelevant) {
    preint::TransferFunction function;
    function.color = {{0.0, {0, 1, 0.5}}, {1.0, {1, 0, 0.5}}};
    function.extinction = {{0.4, 0.0}, {1.0, 5.0}};
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const CameraFrame frame = cameraFrame(camera);
    for (const Mode mode : {Mode::Additive, Mode::Emission}) {
        const Scene scene = boxScene(4, mode, pieces(0.1), function);
        for (const std::string& engine : allEngines) {
            const Image image = pictureOf(scene, camera, {engine, "auto"});
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    if (waysOf(frame, x, y).part < 0.05) continue;
                    const Ray ray = pixelRay(frame, x, y);
                    const auto [in, out] = pathInBox(ray, {0.4, 0, 0}, glm::dvec3(1));
                    const double mean = ray.origin.x + 0.5 * (in + out) * ray.direction.x;
                    ASSERT_NEAR(image.at(x, y).x, mean, 1e-4) << engine << ' ' << x << ' ' << y;
                    ASSERT_NEAR(image.at(x, y).y, 1.0 - mean, 1e-4);
                    ASSERT_EQ(image.at(x, y).w, mode == Mode::Emission ? 0.0f : 1.0f);
                }
        }
    }
}

// One medium, another mesh: graded towards a corner, or twice as fine.
TEST(AdaptiveOpacity, LengthDoesNotDependOnTheMesh) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    preint::TransferFunction function = smoothFunction(0, 1, 10.0);
    const auto sceneOn = [&](int n, double power, const AdaptiveSettings& settings) {
        mesh::ScalarMesh box = boxMesh(n, [](const glm::dvec3& p) { return p.x; });
        for (std::size_t i = 0; i < box.positions.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) box.positions[i][axis] = std::pow(box.positions[i][axis], power);
            box.scalars[i] = box.positions[i].x;
        }
        Scene scene = sceneOf(finished(std::move(box)), function, Mode::Standard);
        scene.settings.adaptive = settings;
        return scene;
    };
    const auto difference = [&](const AdaptiveSettings& settings, int n, double power, const std::string& engine) {
        return compareImages(pictureOf(sceneOn(5, 1.0, settings), camera, {engine, "auto"}),
                             pictureOf(sceneOn(n, power, settings), camera, {engine, "auto"}))
            .max;
    };
    for (const std::string& engine : allEngines) {
        const double bound = engine == "gl" ? 4e-4 : 1e-5;  // gl: of two tables, each made for 1e-4 of a segment
        EXPECT_LE(difference(pieces(0.1), 9, 1.0, engine), bound) << engine;
        EXPECT_LE(difference(pieces(0.1), 6, 1.7, engine), bound) << engine;
    }
    EXPECT_GT(difference(wholeCells(), 9, 1.0, "cpu"), 1e-2);
}

// Isosurfaces are contributions of their own, in either unit.
TEST(AdaptiveOpacity, IsosurfacesAreContributions) {
    preint::TransferFunction function = constantFunction(0.0);
    function.isosurfaces = {{0.31, 0.9, {1, 0, 0}}, {0.62, 0.01, {0, 1, 0}}};
    Camera camera = cameraAt({-3, 0.43, 0.52});
    camera.fovDegrees = 5.0;
    for (const AdaptiveSettings& settings : {pieces(0.1, 0.4), wholeCells(0.4)})
        for (const std::string& engine : allEngines) {
            const glm::vec4 pixel =
                pictureOf(boxScene(4, Mode::Standard, settings, function), camera, {engine, "auto"}).at(20, 17);
            EXPECT_NEAR(pixel.x, 0.4f, 1e-5f) << engine;
            EXPECT_NEAR(pixel.y, 0.6f * 0.4f, 1e-5f) << engine;
            const glm::vec4 mean =
                pictureOf(boxScene(4, Mode::Additive, settings, function), camera, {engine, "auto"}).at(20, 17);
            EXPECT_NEAR(mean.x, 0.5f, 1e-5f) << engine;
            EXPECT_NEAR(mean.y, 0.5f, 1e-5f) << engine;
        }
}

TEST(AdaptiveOpacity, RelevanceIsOneAboveTheThreshold) {
    preint::TransferFunction function = smoothFunction(0, 1, 10.0);  // τ: 0, 0.8, 2, 5, 10
    function.isosurfaces = {{0.1, 0.25, {1, 1, 1}}, {0.2, 0.0, {1, 1, 1}}};
    const auto relevance = relevanceOf(function, 0.2, 3.0, 0.75);
    for (double s : {0.0, 0.3, 0.499, 0.5}) EXPECT_EQ(relevance.extinctionAt(s), 0.0) << s;
    for (double s : {0.501, 0.7, 1.0, 2.0}) EXPECT_EQ(relevance.extinctionAt(s), 3.0) << s;
    ASSERT_EQ(relevance.isosurfaces.size(), 1u);  // one without opacity shows nothing
    EXPECT_EQ(relevance.isosurfaces[0].opacity, 0.75);
    // threshold 0: wherever there is extinction at all, not at the foot of a ramp
    const auto all = relevanceOf(function, 0.0, 1.0, 1.0);
    EXPECT_EQ(all.extinctionAt(0.01), 1.0);
    EXPECT_EQ(all.extinctionAt(0.0), 0.0);
    function.extinction = {{0.2, 0.0}, {0.2, 4.0}, {0.4, 4.0}, {0.4, 0.0}, {0.5, 2.0}, {0.6, 4.0}, {0.7, 2.0}};
    const auto box = relevanceOf(function, 0.5, 1.0, 1.0);
    for (double s : {0.19, 0.4, 0.45, 0.5, 0.7, 0.8}) EXPECT_EQ(box.extinctionAt(s), 0.0) << s;
    for (double s : {0.2, 0.3, 0.501, 0.6, 0.699}) EXPECT_EQ(box.extinctionAt(s), 1.0) << s;
    EXPECT_EQ(relevanceOf(constantFunction(2.0), 0.5, 1.0, 1.0).extinctionAt(7.0), 1.0);
}

// Cell data of 0 at the foot of a ramp from 0: what shows nothing is no contribution, in any engine.
TEST(AdaptiveOpacity, CellsThatShowNothingDoNotCount) {
    mesh::ScalarMesh box = boxMesh(3, [](const glm::dvec3& p) { return p.x; });
    box.association = mesh::Association::Cell;
    box.scalars.resize(box.cells.size());
    for (std::size_t i = 0; i < box.cells.size(); ++i) box.scalars[i] = i % 3 == 0 ? 1.0 : 0.0;
    preint::TransferFunction function = constantFunction(1.0);
    function.extinction = {{0.0, 0.0}, {1.0, 3.0}};
    Scene scene = sceneOf(finished(std::move(box)), function, Mode::Contributions);
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const ReferenceRayCaster caster(scene);
    for (const std::string& engine : allEngines) {
        const Image image = pictureOf(scene, camera, {engine, "auto"});
        for (int y = 1; y < camera.height; y += 4)
            for (int x = 1; x < camera.width; x += 4) {
                const auto segments = caster.segmentsAt(camera, x, y);
                const auto count = std::count_if(segments.begin(), segments.end(),
                                                 [&](const RaySegment& s) { return s.scalarIn > 0.5; });
                ASSERT_EQ(image.at(x, y).x, static_cast<float>(count)) << engine << ' ' << x << ' ' << y;
            }
    }
}

TEST(AdaptiveOpacity, PiecesAreAsLongAsEdgesOnAverage) {
    const mesh::ScalarMesh tetrahedron = unitTetrahedron({0, 1, 3, 3});  // three edges of 1, three of √2
    EXPECT_NEAR(meanEdge(tetrahedron, preint::Integral::Standard), 0.5 * (1 + std::sqrt(2.0)), 1e-12);
    EXPECT_NEAR(meanEdge(tetrahedron, preint::Integral::ScaleInvariant), (1 + 3 + 3 + 2 + 2) / 5.0, 1e-12);
}

// The verification counts by itself: a picture of another medium does not pass for right.
TEST(AdaptiveOpacity, IsVerifiedFromTheMap) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    for (const Filter filter : {Filter::None, Filter::Gaussian})
        for (const Mode mode : {Mode::Standard, Mode::Additive, Mode::Contributions}) {
            AdaptiveSettings settings = wholeCells();
            settings.filter = filter;
            const Scene scene = boxScene(4, mode, settings, smoothFunction(0, 1, 10.0));
            FrameReport report;
            const Image image = makeEngine(scene, {"cpu", "auto"})->render(camera, report);
            EXPECT_LE(verifyImage(image, scene, {camera, report.maps.get()}, 300, 1).rmse, 1e-5);
            Scene other = scene;
            other.transferFunction = smoothFunction(0.5, 1, 10.0);
            EXPECT_GT(verifyImage(image, other, {camera, report.maps.get()}, 300, 1).rmse, 1e-3);
        }
}

class Filters : public testing::TestWithParam<Filter> {};

// A constant stays what it is, nothing stays nothing, and what lies beside nothing is not thinned.
TEST_P(Filters, AreMeansOfWhatIsThere) {
    AdaptiveSettings settings;
    settings.filter = GetParam();
    const Camera camera = cameraAt({0, 0, 3}, glm::dvec3(0), 37, 26);
    const auto half = [](const View& view) {
        Image image(view.camera.width, view.camera.height);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width / 2; ++x) image.at(x, y) = glm::vec4(0, 0, 0, 5);
        return image;
    };
    const std::vector<float> map = contributionMap(camera, settings, half);
    ASSERT_EQ(map.size(), 37u * 26u);
    for (int y = 0; y < 26; ++y) {
        for (int x = 0; x < 16; ++x) EXPECT_NEAR(map[static_cast<std::size_t>(y * 37 + x)], 5.0f, 1e-5f);
        EXPECT_EQ(map[static_cast<std::size_t>(y * 37 + 36)], 0.0f);
    }
}

// What is linear across the picture is found again by interpolation (away from the rims, where it ends).
TEST_P(Filters, KeepWhatIsLinear) {
    AdaptiveSettings settings;
    settings.filter = GetParam();
    settings.sigma = 1.5;
    const Camera camera = cameraAt({0, 0, 3}, glm::dvec3(0), 45, 41);
    const auto slope = [&](const View& view) {
        Image image(view.camera.width, view.camera.height);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const CameraFrame frame = cameraFrame(view.camera);
                const glm::dvec3 d = pixelRay(frame, x, y).direction;
                image.at(x, y).w = static_cast<float>(10 + 9 * d.x / d.z);
            }
        return image;
    };
    const std::vector<float> map = contributionMap(camera, settings, slope);
    const Image exact = slope(camera);
    for (int y = 8; y < 33; ++y)
        for (int x = 8; x < 37; ++x)
            EXPECT_NEAR(map[static_cast<std::size_t>(y * 45 + x)], exact.at(x, y).w, 1e-4f) << x << ' ' << y;
}

INSTANTIATE_TEST_SUITE_P(All, Filters,
                         testing::Values(Filter::None, Filter::Gaussian, Filter::Bilinear2, Filter::Bilinear4));

// Lit, with silhouettes, smoothed, cut, over the scalar: whatever else a picture asks for.
TEST(AdaptiveOpacity, EnginesAgree) {
    auto read = mesh::readMesh("bucky:12");
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::Additive, Mode::DataAdditive, Mode::Absorption})
        for (const Unit unit : {Unit::Cells, Unit::Length}) {
            Scene scene = sceneOf(selected.mesh, smoothFunction(0, 1, 10.0), mode);
            scene.settings.adaptive = AdaptiveSettings{};
            scene.settings.adaptive->unit = unit;
            Camera camera = cameraAt({0, 0, 0}, glm::dvec3(0.5), 60, 48);
            camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
            const std::string name = unit == Unit::Cells ? "cells" : "length";
            expectEnginesAgree(scene, camera, {1e-5, 1e-4}, name);  // tables of gl
            scene.settings.adaptive->filter = Filter::Gaussian;
            scene.settings.shading.silhouette = true;
            if (mode != Mode::Absorption) scene.settings.shading.lights = {{glm::dvec3(0.6, 0.8, 0)}};
            expectEnginesAgree(scene, camera, {1e-4, 1e-3}, name + " lit silhouettes");
        }
}

// A field over 24 decades of which all but the least value is relevant, at a size at which some rays pass edges within
// the rounding of floats: in the corners a cell is a contribution although its scalars differ by 1e-22 of the range.
TEST(AdaptiveOpacity, CountsCellsWhoseScalarsHardlyDiffer) {
    auto read = mesh::readMesh("bucky:24");
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    Scene scene = sceneOf(selected.mesh, smoothFunction(selected.mesh.scalarMin, 1, 10.0), Mode::Standard);
    scene.settings.adaptive = wholeCells();
    Camera camera = cameraAt({0, 0, 0}, glm::dvec3(0.5), 400, 400);
    camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
    expectEnginesAgree(scene, camera, {1e-6, 1e-5}, "density");
}

}  // namespace
}  // namespace tetralux::projection
