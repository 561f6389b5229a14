// SPDX-License-Identifier: Apache-2.0
//
// Modes, limits, classifications and silhouettes: every engine against the reference, the reference against closed
// forms.
#include <map>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/io/read_mesh.h>
#include <projection/core/clip_region.h>
#include <projection/frame/engine_registry.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// Tables of the default error and float; no lobe and no edge takes part.
constexpr EngineThreshold smooth{1e-4, 2e-3};
// A rim of a surface, a limit or a jump may fall into a neighbouring pixel.
constexpr EngineThreshold edged{2e-3, 0.6};

const std::map<Mode, std::string> modes{{Mode::Standard, "Standard"},
                                        {Mode::ScaleInvariant, "ScaleInvariant"},
                                        {Mode::Mip, "Mip"},
                                        {Mode::Minimum, "Minimum"},
                                        {Mode::Average, "Average"},
                                        {Mode::Additive, "Additive"},
                                        {Mode::DataAdditive, "DataAdditive"},
                                        {Mode::Emission, "Emission"},
                                        {Mode::Absorption, "Absorption"},
                                        {Mode::FirstHit, "FirstHit"},
                                        {Mode::Depth, "Depth"},
                                        {Mode::Contributions, "Contributions"}};

Scene fieldScene(const std::string& source, Mode mode) {
    auto read = mesh::readMesh(source);
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    const double low = selected.mesh.scalarMin, high = selected.mesh.scalarMax;
    const double extent =
        integralOf(mode) == preint::Integral::ScaleInvariant ? high - low : selected.mesh.bounds.diagonal() / 1.7;
    auto function = smoothFunction(low, high, 12.0 / extent);
    // what is first seen must be more than a breath for engines to agree on it
    if (mode == Mode::FirstHit || mode == Mode::Depth || mode == Mode::Contributions)
        function.extinction = {{low + 0.3 * (high - low), 0.0}, {low + 0.3 * (high - low), 1.0 / extent}};
    return sceneOf(std::move(selected.mesh), function, mode);
}

Camera cameraOf(const Scene& scene, bool orthographic) {
    Camera camera = cameraAt({0, 0, 0}, scene.mesh->bounds.centre(), 80, 64);
    camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
    if (orthographic) camera.orthographicHeight = 1.1 * scene.mesh->bounds.diagonal();
    return camera;
}

/// A clip plane through the middle, oblique to everything, and a slab.
std::shared_ptr<const PixelMapSource> clipOf(const Scene& scene) {
    const glm::dvec3 centre = scene.mesh->bounds.centre();
    const double size = scene.mesh->bounds.diagonal();
    std::vector<HalfSpace> halves{{centre + 0.05 * size, {-1, -0.4, 0.3}}};
    for (const HalfSpace& half : slabHalfSpaces(centre, {0.2, 1, 0.5}, 0.4 * size)) halves.push_back(half);
    return std::make_shared<ClipRegion>(halves, cutLayerShare * size);
}

EngineThreshold thresholdOf(Mode mode) {
    switch (mode) {
        case Mode::FirstHit:
        case Mode::Depth:
            return edged;
        case Mode::Contributions:
            return {0.02, 1.01};  // a whole cell at a rim
        default:
            return smooth;
    }
}

class Modes : public testing::TestWithParam<Mode> {};

TEST_P(Modes, EnginesAgree) {
    const Scene scene = fieldScene("bucky:12", GetParam());
    expectEnginesAgree(scene, cameraOf(scene, false), thresholdOf(GetParam()), modes.at(GetParam()), true);
    expectEnginesAgree(scene, cameraOf(scene, true), thresholdOf(GetParam()), modes.at(GetParam()) + " parallel");
}

TEST_P(Modes, EnginesAgreeWithinClipPlanes) {
    Scene scene = fieldScene("hydrogen:11", GetParam());
    scene.mapSources = {clipOf(scene)};
    expectEnginesAgree(scene, cameraOf(scene, false), thresholdOf(GetParam()), modes.at(GetParam()) + " clipped");
    expectEnginesAgree(scene, cameraOf(scene, true), thresholdOf(GetParam()),
                       modes.at(GetParam()) + " clipped parallel");
}

TEST_P(Modes, EnginesAgreeOnIsosurfaces) {
    const Mode mode = GetParam();
    Scene scene = fieldScene("marschner-lobb:12", mode);
    scene.transferFunction = isosurfacesFunction(scene.mesh->scalarMin, scene.mesh->scalarMax);
    if (mode == Mode::FirstHit || mode == Mode::Depth) scene.transferFunction.extinction = {{0.0, 0.0}};
    EngineThreshold threshold = thresholdOf(mode);
    threshold.rmse = std::max(threshold.rmse, 2e-3);  // rims of isosurfaces
    threshold.max = std::max(threshold.max, 0.7);
    expectEnginesAgree(scene, cameraOf(scene, false), threshold, modes.at(mode) + " surfaces");
}

INSTANTIATE_TEST_SUITE_P(All, Modes,
                         testing::Values(Mode::Standard, Mode::ScaleInvariant, Mode::Mip, Mode::Minimum, Mode::Average,
                                         Mode::Additive, Mode::DataAdditive, Mode::Emission, Mode::Absorption,
                                         Mode::FirstHit, Mode::Depth, Mode::Contributions),
                         [](const auto& suite) { return modes.at(suite.param); });

TEST(OrderFreeModes, SpendNoTimeInSorting) {
    for (const auto& [mode, name] : modes) {
        const Scene scene = fieldScene("bucky:9", mode);
        for (const auto& options : fastEngines()) {
            FrameReport report;
            const auto engine = makeEngine(scene, options);
            engine->render(cameraOf(scene, false), report);
            EXPECT_EQ(report.orderMethod == "none", orderFree(mode)) << name << ' ' << options.engine;
            if (orderFree(mode)) {
                EXPECT_EQ(report.cellsSorted, 0u) << name;
                EXPECT_EQ(engine->prepareMilliseconds().count("order"), 0u) << name;
            }
        }
    }
}

TEST(OrderFreeModes, BesideCellsAtTheEyeIsNothing) {
    const auto oblique = [](const glm::dvec3& p) { return p.x - 0.7 * p.y + 0.4 * p.z; };
    const glm::dvec3 corner(0.13, 0.27, 0.31);
    const mesh::ScalarMesh box = boxMesh(4, oblique, corner, {1.21, 0.93, 1.37});
    const Camera camera = cameraAt(corner, corner + glm::dvec3(1.0, 0.8, 0.1), 44, 37);  // with the box on one side
    EngineOptions tiles{"gl", "auto"};
    tiles.glPath = "tiles";
    for (const Mode mode : {Mode::Mip, Mode::Minimum, Mode::Average}) {
        const Scene scene = sceneOf(box, smoothFunction(box.scalarMin, box.scalarMax), mode);
        const Image exact = referenceThatShows(scene, camera);
        for (const EngineOptions& options : {EngineOptions{"cpu", "auto"}, EngineOptions{"gl", "auto"}, tiles})
            EXPECT_LE(compareImages(pictureOf(scene, camera, options), exact).max, 1e-4)
                << modes.at(mode) << ' ' << options.engine << ' ' << options.glPath;
    }
}

TEST(VertexValues, AreRightInCellsWhoseFacesAreSeenEdgeOn) {
    const auto field = [](const glm::dvec3& p) { return p.x * p.y + 0.3 * p.z * p.z + 0.2 * p.y; };
    const mesh::ScalarMesh grid = boxMesh(5, field);
    Scene scene = sceneOf(grid, smoothFunction(grid.scalarMin, grid.scalarMax, 4.0));
    scene.settings.classification = Classification::Pre;
    EngineOptions resident{"gl", "auto"}, tiles{"gl", "auto"};
    resident.glPath = "resident";
    tiles.glPath = "tiles";
    for (const bool orthographic : {false, true}) {
        Camera camera = cameraAt({0.5, 0.5, 3.0}, glm::dvec3(0.5), 44, 37);  // in the planes of the grid's faces
        if (orthographic) camera.orthographicHeight = 1.3;
        const Image exact = referenceThatShows(scene, camera);
        for (const EngineOptions& options :
             {EngineOptions{"cpu", "auto"}, EngineOptions{"gl", "auto"}, resident, tiles})
            EXPECT_LE(compareImages(pictureOf(scene, camera, options), exact).max, 1e-4)
                << options.engine << ' ' << options.glPath << (orthographic ? " parallel" : "");
    }
}

class Integrals : public testing::TestWithParam<Mode> {};
INSTANTIATE_TEST_SUITE_P(Both, Integrals, testing::Values(Mode::Standard, Mode::ScaleInvariant),
                         [](const auto& suite) { return modes.at(suite.param); });

TEST_P(Integrals, EnginesAgreeOnClassifications) {
    for (const auto& [classification, name] :
         {std::pair(Classification::Post, " post"), std::pair(Classification::PostLinear, " post linear"),
          std::pair(Classification::Pre, " pre")}) {
        Scene scene = fieldScene("bucky:12", GetParam());
        scene.settings.classification = classification;
        // the linear form is clamped: kinks on every pixel
        expectEnginesAgree(scene, cameraOf(scene, false), {3e-4, 5e-3}, modes.at(GetParam()) + name);
    }
}

TEST_P(Integrals, EnginesAgreeOnScaledExtinction) {
    for (const bool surfaces : {false, true}) {
        Scene scene = fieldScene("bucky:12", GetParam());
        if (surfaces) scene.transferFunction = isosurfacesFunction(scene.mesh->scalarMin, scene.mesh->scalarMax);
        const Camera camera = cameraOf(scene, false);
        PixelMaps maps;
        for (std::size_t i = 0; i < 80 * 64; ++i)
            maps.extinctionScale.push_back(static_cast<float>(i % 80) / 20.0f);  // 0 … 4 from left to right
        scene.settings.largestExtinctionScale = 4.0;
        expectEnginesAgree(scene, {camera, &maps}, surfaces ? EngineThreshold{2e-3, 0.7} : EngineThreshold{1e-4, 2e-3},
                           modes.at(GetParam()) + (surfaces ? " scaled surfaces" : " scaled"));
        scene.settings.shading.silhouette = true;
        expectEnginesAgree(scene, {camera, &maps}, {2e-3, 0.7}, modes.at(GetParam()) + " scaled silhouettes");
    }
}

TEST_P(Integrals, EnginesAgreeOnSilhouettesAndGradientOpacity) {
    Scene scene = fieldScene("hydrogen:11", GetParam());
    const Camera camera = cameraOf(scene, false);
    auto& shading = scene.settings.shading;
    const std::string name = modes.at(GetParam());
    // standard: k has a pole where a ray runs along an isosurface
    const EngineThreshold poles = GetParam() == Mode::Standard ? EngineThreshold{2e-3, 5e-2} : smooth;
    shading.silhouette = true;
    shading.approximateSilhouette = true;
    expectEnginesAgree(scene, camera, poles, name + " approximate silhouettes");
    shading.gradientOpacity = 0.2;
    expectEnginesAgree(scene, camera, poles, name + " both");
    shading.silhouette = shading.approximateSilhouette = false;
    expectEnginesAgree(scene, camera, smooth, name + " gradient opacity");
}

TEST_P(Integrals, EnginesAgreeOnLightOfCuts) {
    Scene scene = fieldScene("bucky:12", GetParam());
    scene.mapSources = {clipOf(scene)};
    scene.settings.shading.lights.push_back({glm::normalize(glm::dvec3(1, 2, 3))});
    scene.settings.shading.exponent = 8;
    const Camera camera = cameraOf(scene, false);
    // a light's side is the sign of s_f − s_b, which float may turn where the two agree to 1e-7
    expectEnginesAgree(scene, camera, {3e-4, 5e-2}, modes.at(GetParam()) + " lit cut");
    // the cut's normal shows: without it the picture is another
    PixelMaps maps;
    scene.mapSources.front()->apply(camera, maps);
    scene.mapSources.clear();
    const Image with = referencePicture(scene, {camera, &maps});
    maps.cutLayerEnd.clear();
    maps.cutNormal.clear();
    EXPECT_GT(compareImages(with, referencePicture(scene, {camera, &maps})).rmse, 1e-3);
}

// A cube of constant extinction, cut by a plane: what is left of each ray follows Beer's law.
TEST(ClipRegion, LeavesTheLengthOnTheSideOfTheNormal) {
    const Scene plain = sceneOf(boxMesh(3, [](const glm::dvec3& p) { return p.x; }), constantFunction(1.7));
    Scene scene = plain;
    const glm::dvec3 point(0.45, 0.5, 0.55), normal(1, -2, 0.5);
    scene.mapSources = {std::make_shared<ClipRegion>(std::vector<HalfSpace>{{point, normal}}, 0.01)};
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const CameraFrame frame = cameraFrame(camera);
    for (const std::string engine : {"reference", "cpu", "gl"}) {
        const Image image = pictureOf(scene, camera, {engine, "auto"});
        int cut = 0;
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                const Ray ray = pixelRay(frame, x, y);
                auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
                const double t = glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal);
                const double whole = out - in;
                if (glm::dot(ray.direction, normal) > 0)
                    in = std::max(in, t);
                else
                    out = std::min(out, t);
                cut += whole > 0 && std::max(0.0, out - in) < whole - 0.01;
                // the fast engines' sample stands 6e-5 pixels beside the centre
                ASSERT_NEAR(image.at(x, y).w, -std::expm1(-1.7 * std::max(0.0, out - in)), 3e-5) << engine << x << y;
            }
        EXPECT_GT(cut, 200);
    }
}

TEST(ClipRegion, BoxAndSlabAreHalfSpaces) {
    Scene scene = sceneOf(boxMesh(3, [](const glm::dvec3& p) { return p.x; }), constantFunction(1.7));
    const glm::dvec3 low(0.2, 0.1, 0.3), high(0.7, 0.8, 0.6);
    scene.mapSources = {std::make_shared<ClipRegion>(boxHalfSpaces(low, high), 0.01)};
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const Image image = referencePicture(scene, camera);
    const CameraFrame frame = cameraFrame(camera);
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const auto [in, out] = pathInBox(pixelRay(frame, x, y), low, high);
            ASSERT_NEAR(image.at(x, y).w, -std::expm1(-1.7 * std::max(0.0, out - in)), 1e-6);
        }
    EXPECT_THROW(ClipRegion({{glm::dvec3(0), glm::dvec3(0)}}, 0.01), std::runtime_error);
    EXPECT_THROW(ClipRegion({{glm::dvec3(0), glm::dvec3(1)}}, -1.0), std::runtime_error);
    const auto slab = slabHalfSpaces(glm::dvec3(1), glm::dvec3(0, 0, 2), 0.5);
    EXPECT_NEAR(slab[0].point.z, 0.75, 1e-12);
    EXPECT_NEAR(slab[1].point.z, 1.25, 1e-12);
}

// s = x + 2y + 3z in the cube; the picture of each mode along a ray in closed form.
TEST(ReferenceModes, ClosedForms) {
    const auto field = [](const glm::dvec3& p) { return p.x + 2 * p.y + 3 * p.z; };
    Scene scene = sceneOf(boxMesh(4, field), {});
    scene.transferFunction.color = {{0.0, {0, 0, 0}}, {6.0, {1, 0.5, 0.25}}};
    scene.transferFunction.extinction = {{0.0, 0.0}, {6.0, 0.6}};  // τ = s/10, c = s/6·(1, ½, ¼)
    const Camera camera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 12, 10);
    const CameraFrame frame = cameraFrame(camera);
    const auto imageOf = [&](Mode mode) {
        scene.settings.mode = mode;
        return referencePicture(scene, camera);
    };
    const Image minimum = imageOf(Mode::Minimum), additive = imageOf(Mode::Additive),
                emission = imageOf(Mode::Emission), absorption = imageOf(Mode::Absorption),
                depth = imageOf(Mode::Depth);
    const DepthRange range = depthRange(scene.mesh->bounds, camera);
    int met = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const Ray ray = pixelRay(frame, x, y);
            const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
            if (out <= in) continue;
            ++met;
            const double a = field(ray.origin + in * ray.direction), b = field(ray.origin + out * ray.direction);
            const double l = out - in, squares = (a * a + a * b + b * b) / 3;
            EXPECT_NEAR(minimum.at(x, y).x, std::min(a, b) / 6, 1e-6);
            EXPECT_NEAR(additive.at(x, y).x, l * squares / 60, 1e-6);
            EXPECT_NEAR(additive.at(x, y).w, std::min(1.0, l * (a + b) / 20), 1e-6);
            EXPECT_NEAR(emission.at(x, y).x, l * squares / 60, 1e-6);
            EXPECT_EQ(emission.at(x, y).w, 0.0f);
            EXPECT_EQ(absorption.at(x, y).x, 0.0f);
            EXPECT_NEAR(absorption.at(x, y).w, -std::expm1(-l * (a + b) / 20), 1e-6);
            EXPECT_NEAR(depth.at(x, y).x, range.greyAt(in), 1e-6);
            EXPECT_EQ(depth.at(x, y).w, 1.0f);
        }
    EXPECT_GT(met, 30);
}

TEST(DepthRange, EndsWhereTheSphereDoesBehindTheEyesPlaneToo) {
    const mesh::BoundingBox box{glm::dvec3(-1), glm::dvec3(1)};
    const double radius = std::sqrt(3.0);
    Camera camera = cameraAt({0, 0, -0.5}, {0, 0, -2});  // past the middle, looking away from it
    camera.orthographicHeight = 2;
    EXPECT_DOUBLE_EQ(depthRange(box, camera).nearest, 0.0);
    EXPECT_DOUBLE_EQ(depthRange(box, camera).farthest, radius - 0.5);
    camera = cameraAt({0, 0, -5}, {0, 0, -6});  // all of it is behind
    camera.orthographicHeight = 2;
    EXPECT_GT(depthRange(box, camera).farthest, depthRange(box, camera).nearest);
}

TEST(PixelMaps, OfAnotherSizeAreAnError) {
    const Scene scene = fieldScene("bucky:4", Mode::Standard);
    PixelMaps maps;
    maps.farthest = {1.0, 2.0};
    for (const std::string engine : {"reference", "cpu", "gl"})
        EXPECT_THROW(pictureOf(scene, {cameraOf(scene, false), &maps}, {engine, "auto"}), std::runtime_error);
}

TEST(PixelMaps, OpaquePointsStandBehindTheVolume) {
    Scene scene = sceneOf(boxMesh(3, [](const glm::dvec3& p) { return p.x; }), constantFunction(1.7));
    const Camera camera = cameraAt({0.5, 0.5, 3.0});
    struct Wall final : PixelMapSource {
        void apply(const Camera& view, PixelMaps& maps) const override {
            const CameraFrame frame = cameraFrame(view);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x)  // the plane z = 0.5
                    putOpaque(view, maps, static_cast<std::size_t>(y * view.width + x),
                              -2.5 / pixelRay(frame, x, y).direction.z, {0.2f, 0.4f, 0.6f});
        }
    };
    scene.mapSources = {std::make_shared<Wall>()};
    for (const std::string engine : {"reference", "cpu", "gl"}) {
        const Image image = pictureOf(scene, camera, {engine, "auto"});
        const double alpha = -std::expm1(-1.7 * 0.5);  // the middle ray is nearly straight
        const glm::vec4 pixel = image.at(camera.width / 2, camera.height / 2);
        EXPECT_NEAR(pixel.x, 0.8 * alpha + (1 - alpha) * 0.2, 1e-3) << engine;
        EXPECT_EQ(image.at(0, 0), glm::vec4(0.2f, 0.4f, 0.6f, 1.0f)) << engine;
    }
}

}  // namespace
}  // namespace tetralux::projection
