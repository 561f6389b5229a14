// SPDX-License-Identifier: Apache-2.0
//
// Pictures of the OpenGL engine against closed forms and against the reference engine.
#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include <mesh/io/read_mesh.h>
#include <mesh/tet/procedural_field.h>
#include <projection/frame/engine_registry.h>
#include <projection/gl/gl_engine.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

Image glImage(const Scene& scene, const Camera& camera, const std::string& context = "auto") {
    EngineOptions options;
    options.context = context;
    FrameReport report;
    return makeGlEngine(scene, options)->render(camera, report);
}

// What a table of the default error (1e-4 per segment, far less on average) and float leave. Seen on llvmpipe: rmse up
// to 8e-6, max up to 1.5e-4.
constexpr test::EngineThreshold smoothThreshold{2e-5, 4e-4};

void expectLikeReference(const Scene& scene, const Camera& camera, test::EngineThreshold threshold) {
    test::expectLike(test::referenceThatShows(scene, camera), scene, camera, {"gl", "auto"}, threshold);
}

Scene fieldScene(const std::string& source, Mode mode) {
    auto read = mesh::readMesh(source);
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    const double low = selected.mesh.scalarMin, high = selected.mesh.scalarMax;
    // extinction per unit of what is integrated over, so that all fields show some depth
    const double extent = mode == Mode::ScaleInvariant ? high - low : selected.mesh.bounds.diagonal() / 1.7;
    auto function = smoothFunction(low, high, 25.0 / extent);
    if (mode == Mode::FirstHit) function.extinction = {{low + 0.3 * (high - low), 0.0}, {high, 25.0 / extent}};
    return sceneOf(std::move(selected.mesh), function, mode);
}

Camera fieldCamera(const Scene& scene) {
    Camera camera = cameraAt({0, 0, 0}, scene.mesh->bounds.centre(), 80, 64);
    camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
    return camera;
}

class GlFieldModes : public testing::TestWithParam<std::tuple<std::string, Mode>> {};

TEST_P(GlFieldModes, LikeReference) {
    const auto [source, mode] = GetParam();
    const Scene scene = fieldScene(source, mode);
    // First-hit shows a surface: at its rim a ray grazes it, where its colour changes fast. 8e-6, 5.6e-4 were seen.
    expectLikeReference(scene, fieldCamera(scene),
                        mode == Mode::FirstHit ? test::EngineThreshold{4e-5, 3e-3} : smoothThreshold);
}

std::string modeName(Mode mode) {
    const std::map<Mode, std::string> names{{Mode::Standard, "Standard"},
                                            {Mode::ScaleInvariant, "ScaleInvariant"},
                                            {Mode::Mip, "Mip"},
                                            {Mode::Average, "Average"},
                                            {Mode::FirstHit, "FirstHit"}};
    return names.at(mode);
}

INSTANTIATE_TEST_SUITE_P(All, GlFieldModes,
                         testing::Combine(testing::Values("bucky:12", "coulomb:10", "marschner-lobb:12", "hydrogen:11"),
                                          testing::Values(Mode::Standard, Mode::ScaleInvariant, Mode::Mip,
                                                          Mode::Average, Mode::FirstHit)),
                         [](const auto& suite) {
                             std::string name = std::get<0>(suite.param) + "_" + modeName(std::get<1>(suite.param));
                             for (char& c : name) {
                                 if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                             }
                             return name;
                         });

class GlIntegrals : public testing::TestWithParam<Mode> {};

TEST_P(GlIntegrals, IsosurfacesAreExact) {
    Scene scene = fieldScene("bucky:12", GetParam());
    scene.transferFunction = isosurfacesFunction(scene.mesh->scalarMin, scene.mesh->scalarMax);
    // no table error at all; an isosurface's rim may fall into a neighbouring pixel
    expectLikeReference(scene, fieldCamera(scene), {2e-4, 2e-2});
}

TEST_P(GlIntegrals, JumpsAreExact) {
    Scene scene = fieldScene("bucky:12", GetParam());
    auto& function = scene.transferFunction;
    function.extinction = {{0.2, 0.0}, {0.3, 4.0}, {0.3, 1.0}, {0.6, 2.0}, {0.6, 9.0}, {0.8, 9.0}};
    function.color = {{0.1, {1, 0, 0}}, {0.45, {0, 1, 0}}, {0.45, {0, 0, 1}}, {0.9, {1, 1, 0}}};
    expectLikeReference(scene, fieldCamera(scene), smoothThreshold);
}

TEST_P(GlIntegrals, ConstantFunction) {
    Scene scene = fieldScene("marschner-lobb:12", GetParam());
    scene.transferFunction = constantFunction(GetParam() == Mode::Standard ? 1.0 : 5.0);
    expectLikeReference(scene, fieldCamera(scene), {5e-6, 1e-4});  // no table error: float and the shifted sample
}

TEST_P(GlIntegrals, EyeInside) {
    const Scene scene = fieldScene("bucky:12", GetParam());
    for (const glm::dvec3 eye : {glm::dvec3(0.43, 0.51, 0.56), {0.11, 0.93, 0.5}, {0.5, 0.5, 0.5}}) {
        Camera camera = cameraAt(eye, {0.9, 0.6, 0.7}, 64, 64);
        camera.fovDegrees = 100;
        expectLikeReference(scene, camera, smoothThreshold);
    }
}

TEST_P(GlIntegrals, ViewAlongAnAxisOfTheGrid) {
    const Scene scene = fieldScene("bucky:9", GetParam());
    // odd sizes: pixel rays lie in faces and along edges of cells
    for (const glm::dvec3 eye : {glm::dvec3(0.5, 0.5, 3.5), {-3, 0.5, 0.5}}) {
        expectLikeReference(scene, cameraAt(eye, glm::dvec3(0.5), 65, 65), smoothThreshold);
        Camera parallel = cameraAt(eye, glm::dvec3(0.5), 65, 65);
        parallel.orthographicHeight = 65.0 / 64.0 * 1.5;
        expectLikeReference(scene, parallel, smoothThreshold);
    }
}

TEST_P(GlIntegrals, Orthographic) {
    const Scene scene = fieldScene("coulomb:10", GetParam());
    Camera camera = fieldCamera(scene);
    camera.orthographicHeight = 1.3 * scene.mesh->bounds.diagonal();
    expectLikeReference(scene, camera, smoothThreshold);
    camera.eye = scene.mesh->bounds.centre();  // cells behind the eye's plane are not seen
    camera.target = camera.eye + glm::dvec3(0.3, -0.4, 1);
    expectLikeReference(scene, camera, smoothThreshold);
}

TEST_P(GlIntegrals, SilhouettesAndLights) {
    Scene scene = fieldScene("hydrogen:11", GetParam());
    const Camera camera = fieldCamera(scene);
    scene.settings.shading.silhouette = true;
    // k = |g|/|g·d| of the standard integral has a pole where the ray runs along an isosurface: what float makes
    // of g·d shows there.
    expectLikeReference(scene, camera,
                        GetParam() == Mode::Standard ? test::EngineThreshold{1e-4, 1e-2} : smoothThreshold);
    scene.settings.shading.lights = {{glm::dvec3(0, 0, 1)}, {glm::dvec3(0.6, 0.8, 0)}};
    scene.settings.shading.exponent = 8;
    // A light's side is the sign of s_f − s_b, which float may turn where the two agree to 1e-7.
    expectLikeReference(scene, camera, {1e-4, 1e-2});
    scene.settings.shading.silhouette = false;
    scene.settings.shading.transmission = false;
    expectLikeReference(scene, camera, {1e-4, 1e-2});
}

TEST_P(GlIntegrals, CellData) {
    Scene scene = fieldScene("bucky:9", GetParam());
    mesh::ScalarMesh cells = *scene.mesh;
    std::vector<double> values;
    for (mesh::CellIndex cell = 0; cell < cells.cells.size(); ++cell) values.push_back(scene.mesh->scalarAt(cell, 1));
    cells.association = mesh::Association::Cell;
    cells.scalars = values;
    scene.mesh = std::make_shared<const mesh::ScalarMesh>(finished(std::move(cells)));
    if (GetParam() == Mode::Standard) {
        expectLikeReference(scene, fieldCamera(scene), smoothThreshold);
        return;
    }
    for (const glm::vec4& pixel : glImage(scene, fieldCamera(scene)).pixels) {
        ASSERT_EQ(pixel, glm::vec4(0)) << "segments of constant scalar are fully transparent";
    }
}

INSTANTIATE_TEST_SUITE_P(Both, GlIntegrals, testing::Values(Mode::Standard, Mode::ScaleInvariant),
                         [](const auto& suite) { return modeName(suite.param); });

// exp(−τl) through one tetrahedron, pixel by pixel: x + y + z ≤ 1, x, y, z ≥ 0.
TEST(GlEngine, OneTetrahedronFollowsBeersLaw) {
    const double extinction = 2.5;
    const Scene scene = sceneOf(unitTetrahedron({1, 1, 1, 1}), constantFunction(extinction));
    const Camera camera = cameraAt({1.3, 1.1, 1.6}, glm::dvec3(0.25), 61, 53);
    const CameraFrame frame = cameraFrame(camera);
    const Image image = glImage(scene, camera);
    int hit = 0;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const Ray ray = pixelRay(frame, x, y);
            double in = 0, out = 1e300;
            const auto clip = [&](double value, double rate) {  // value + rate·t ≥ 0
                (rate > 0 ? in : out) = rate > 0 ? std::max(in, -value / rate) : std::min(out, -value / rate);
            };
            for (int axis = 0; axis < 3; ++axis) clip(ray.origin[axis], ray.direction[axis]);
            clip(1 - ray.origin.x - ray.origin.y - ray.origin.z, -ray.direction.x - ray.direction.y - ray.direction.z);
            const double alpha = -std::expm1(-extinction * std::max(0.0, out - in));
            hit += out > in;
            // the sample stands 6e-5 pixels beside the centre (sampleShift)
            EXPECT_NEAR(image.at(x, y).w, alpha, 2e-5) << x << ' ' << y;
            EXPECT_NEAR(image.at(x, y).x, 0.8 * alpha, 2e-5);
        }
    }
    EXPECT_GT(hit, 300);
}

TEST(GlEngine, ContextsGiveTheSameImage) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        const Scene scene = fieldScene("bucky:12", mode);
        const Image egl = glImage(scene, fieldCamera(scene), "egl");
        const Image osmesa = glImage(scene, fieldCamera(scene), "osmesa");
        // to the bit where both are llvmpipe; 1e-5 leaves room for a GPU behind EGL
        EXPECT_LE(compareImages(egl, osmesa).max, 1e-5);
    }
}

TEST(GlEngine, EnginesOneAfterTheOtherAndSeveralFrames) {
    const Scene scene = fieldScene("bucky:9", Mode::ScaleInvariant);
    const Camera camera = fieldCamera(scene);
    const Image first = glImage(scene, camera);
    EngineOptions eglOptions, osmesaOptions;
    eglOptions.context = "egl";
    osmesaOptions.context = "osmesa";
    const auto egl = makeGlEngine(scene, eglOptions), osmesa = makeGlEngine(scene, osmesaOptions);
    Camera small = camera;
    small.width = 33;
    for (int i = 0; i < 2; ++i) {
        for (const auto& engine : {egl.get(), osmesa.get()}) {
            FrameReport report;
            EXPECT_EQ(engine->render(small, report).width, 33);
            EXPECT_LE(compareImages(engine->render(camera, report), first).max, 1e-6);
        }
    }
}

// A mesh far from the origin is the same mesh: doubles reach 1e-10 of a cell there.
TEST(GlEngine, FarFromTheOrigin) {
    const Scene scene = fieldScene("bucky:9", Mode::Standard);
    mesh::ScalarMesh moved = *scene.mesh;
    const glm::dvec3 offset(1e6, -2e6, 3e6);
    for (glm::dvec3& position : moved.positions) position += offset;
    Scene movedScene = scene;
    movedScene.mesh = std::make_shared<const mesh::ScalarMesh>(finished(std::move(moved)));
    const Camera camera = fieldCamera(scene);
    Camera movedCamera = camera;
    movedCamera.eye += offset;
    movedCamera.target += offset;
    EXPECT_LE(compareImages(glImage(scene, camera), glImage(movedScene, movedCamera)).max, 1e-5);
}

TEST(GlEngine, CellsSmallerThanAPixelAreNotLost) {
    Scene scene = fieldScene("bucky:24", Mode::Standard);
    Camera camera = fieldCamera(scene);
    camera.width = camera.height = 12;
    expectLikeReference(scene, camera, smoothThreshold);
}

TEST(GlEngine, ReportsWhatItDid) {
    const Scene scene = fieldScene("bucky:9", Mode::Standard);
    const auto engine = makeGlEngine(scene, {});
    EXPECT_EQ(engine->name(), "gl");
    EXPECT_FALSE(engine->renderer().empty());
    ASSERT_NE(engine->table(), nullptr);
    EXPECT_EQ(engine->table()->integral, preint::Integral::Standard);
    Camera camera = fieldCamera(scene);
    FrameReport report;
    engine->render(camera, report);
    std::uint64_t skipped = 0;
    for (const auto& [reason, count] : report.cellsSkipped) skipped += count;
    EXPECT_EQ(report.cellsDrawn + skipped, scene.mesh->cells.size());
    EXPECT_GT(report.cellsDrawn, 0u);
    FrameReport tiles;
    makeEngine(scene, {"cpu", "auto"})->render(camera, tiles);
    EXPECT_NEAR(static_cast<double>(report.fragments) / static_cast<double>(tiles.fragments), 1.0, 0.05)
        << "the tile engine counts the same segments, and those that show nothing";
    for (const char* stage : {"sort", "setup", "upload", "draw", "read back"}) {
        EXPECT_TRUE(report.stageMilliseconds.contains(stage)) << stage;
    }
    double stages = 0;
    for (const auto& [stage, time] : report.stageMilliseconds) stages += time;
    EXPECT_NEAR(stages, report.frameMilliseconds, 0.1 * report.frameMilliseconds + 1.0);
    EXPECT_NE(report.orderMethod, "none");

    // looking away: nothing to draw, no error, all counted
    camera.target = camera.eye + (camera.eye - camera.target);
    FrameReport away;
    for (const glm::vec4& pixel : engine->render(camera, away).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(away.cellsDrawn, 0u);
}

TEST(GlEngine, OrderFreeModesDoNotSort) {
    for (const Mode mode : {Mode::Mip, Mode::Average}) {
        const Scene scene = fieldScene("bucky:9", mode);
        const auto engine = makeGlEngine(scene, {});
        FrameReport report;
        engine->render(fieldCamera(scene), report);
        EXPECT_EQ(report.orderMethod, "none");
        EXPECT_FALSE(report.stageMilliseconds.contains("sort"));
        EXPECT_EQ(engine->table(), nullptr);
    }
}

// Blending the same colour in another order changes roundings only, a few in a row of 30 cells.
TEST(GlEngine, OneColourIsNotSorted) {
    Scene scene = fieldScene("bucky:12", Mode::Standard);
    scene.transferFunction.color = {{0.0, {0.9, 0.75, 0.45}}};
    FrameReport with, without;
    const Image free = makeGlEngine(scene, {})->render(fieldCamera(scene), with);
    scene.settings.order = OrderMethod::Graph;
    const Image sorted = makeGlEngine(scene, {})->render(fieldCamera(scene), without);
    EXPECT_EQ(with.orderMethod, "none");
    EXPECT_EQ(with.cellsSorted, 0u);
    EXPECT_FALSE(with.stageMilliseconds.contains("sort"));
    EXPECT_EQ(without.orderMethod, "mpvo");
    EXPECT_LE(compareImages(free, sorted).max, 1e-6);
}

// Certified keys put what survives culling into the order of the graph of the whole mesh: the picture is the same but
// for cells that do not share a pixel.
TEST(GlEngine, KeysAndGraphGiveTheSamePicture) {
    Scene scene = fieldScene("bucky:12", Mode::Standard);
    FrameReport keys, graph;
    const Image byKeys = makeGlEngine(scene, {})->render(fieldCamera(scene), keys);
    scene.settings.order = OrderMethod::Graph;
    const Image byGraph = makeGlEngine(scene, {})->render(fieldCamera(scene), graph);
    EXPECT_EQ(keys.orderMethod, "power");
    EXPECT_EQ(graph.orderMethod, "mpvo");
    EXPECT_EQ(compareImages(byKeys, byGraph).max, 0.0);
    EXPECT_EQ(keys.cellsSorted, keys.cellsDrawn) << "only what is drawn is sorted, and keeps all relations";
    EXPECT_EQ(graph.cellsSorted, scene.mesh->cells.size());
}

// Most cells lie outside this view and a half is invisible: keys of the rest say the same as the graph of all.
TEST(GlEngine, OnlyWhatIsDrawnIsSorted) {
    Scene scene = fieldScene("marschner-lobb:20", Mode::Standard);
    scene.transferFunction.extinction = {{0.0, 0.0}, {0.5, 0.0}, {1.0, 20.0}};
    Camera camera = fieldCamera(scene);
    camera.fovDegrees = 12;
    FrameReport keys, graph;
    const Image byKeys = makeGlEngine(scene, {})->render(camera, keys);
    scene.settings.order = OrderMethod::Graph;
    const Image byGraph = makeGlEngine(scene, {})->render(camera, graph);
    EXPECT_LT(keys.cellsDrawn, scene.mesh->cells.size() / 2);
    EXPECT_EQ(keys.cellsSorted, keys.cellsDrawn);
    EXPECT_EQ(keys.cellsSkipped, graph.cellsSkipped);
    EXPECT_EQ(compareImages(byKeys, byGraph).max, 0.0);
}

TEST(GlEngine, SkippingInvisibleCellsChangesNothing) {
    Scene scene = fieldScene("bucky:12", Mode::Standard);
    scene.transferFunction.extinction = {{0.0, 0.0}, {0.5, 0.0}, {1.0, 20.0}};
    FrameReport with, without;
    const Image skipped = makeGlEngine(scene, {})->render(fieldCamera(scene), with);
    scene.settings.skipInvisible = false;
    const Image full = makeGlEngine(scene, {})->render(fieldCamera(scene), without);
    EXPECT_GT(with.cellsSkipped["invisible by transfer function"], scene.mesh->cells.size() / 4);
    EXPECT_EQ(without.cellsSkipped.count("invisible by transfer function"), 0u);
    EXPECT_LE(compareImages(skipped, full).max, 1e-7);
}

TEST(GlEngine, InvisibleCellsAreSkippedAndCounted) {
    Scene scene = fieldScene("bucky:12", Mode::Standard);
    scene.transferFunction.extinction = {{0.0, 0.0}, {0.5, 0.0}, {1.0, 20.0}};
    FrameReport report;
    makeGlEngine(scene, {})->render(fieldCamera(scene), report);
    std::uint64_t expected = 0;
    for (mesh::CellIndex cell = 0; cell < scene.mesh->cells.size(); ++cell) {
        bool shows = false;
        for (int k = 0; k < 4; ++k) shows = shows || scene.mesh->scalarAt(cell, k) > 0.5;
        expected += shows ? 0 : 1;
    }
    EXPECT_EQ(report.cellsSkipped["invisible by transfer function"], expected);
    expectLikeReference(scene, fieldCamera(scene), smoothThreshold);
}

TEST(GlEngine, UnknownContextIsAnError) {
    EngineOptions options;
    options.context = "wgl";
    EXPECT_THROW(makeGlEngine(fieldScene("bucky:4", Mode::Standard), options), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::projection
