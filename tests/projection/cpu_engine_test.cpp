// SPDX-License-Identifier: Apache-2.0
//
// Pictures of the tile engine against closed forms, against the reference, and against itself with each shortcut
// switched off.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/task_arena.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/procedural_field.h>
#include <projection/cells/cell_setup.h>
#include <projection/cpu/cpu_engine.h>
#include <projection/reference/reference_ray_caster.h>
#include <projection/repair/exact_repair.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/cpu_pictures.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// Float: rmse up to 3e-7, max up to 2.1e-5 were seen over all functions, modes and views below.
constexpr test::EngineThreshold floatThreshold{2e-6, 1e-4};
// At a silhouette the exponent 1/|cos| of float depends on how nearly a ray grazes: 6.5e-6, 4.3e-4.
constexpr test::EngineThreshold silhouetteThreshold{4e-5, 3e-3};

void expectLikeReference(const Scene& scene, const Camera& camera, test::EngineThreshold threshold) {
    test::expectLike(test::referenceThatShows(scene, camera), scene, camera, {"cpu", "auto"}, threshold);
}

preint::TransferFunction functionOf(const std::string& name, double low, double high, double extent) {
    auto at = [&](double t) { return low + t * (high - low); };
    if (name == "isosurfaces") {
        auto function = isosurfacesFunction(low, high);
        function.extinction.front().extinction /= extent;
        return function;
    }
    auto function = smoothFunction(low, high, 25.0 / extent);
    if (name == "opaque")
        function.extinction = {{at(0.0), 0.0}, {at(0.2), 0.0}, {at(0.3), 400.0 / extent}, {at(1.0), 3000.0 / extent}};
    if (name == "constant") function.color = {{at(0.0), {0.9, 0.5, 0.2}}};
    if (name == "jumps") {
        function.extinction = {{at(0.0), 0.5 / extent},
                               {at(0.4), 1.0 / extent},
                               {at(0.4), 12.0 / extent},
                               {at(0.7), 8.0 / extent},
                               {at(0.7), 0.0}};
        function.color = {{at(0.2), {1, 0, 0}}, {at(0.5), {0, 1, 0}}, {at(0.5), {0, 0, 1}}, {at(1.0), {1, 1, 0}}};
    }
    return function;
}

Scene fieldScene(const std::string& field, const std::string& function, Mode mode, int n = 9) {
    mesh::ScalarMesh m = sampledMesh(mesh::proceduralField(field, n), n);
    const double extent = mode == Mode::ScaleInvariant ? m.scalarMax - m.scalarMin : m.bounds.diagonal() / 1.7;
    const auto transfer = functionOf(function, m.scalarMin, m.scalarMax, extent);
    return sceneOf(std::move(m), transfer, mode);
}

class CpuModes : public testing::TestWithParam<std::tuple<const char*, Mode>> {};

TEST_P(CpuModes, AreLikeTheReference) {
    const auto [field, mode] = GetParam();
    const Scene scene = fieldScene(field, "smooth", mode);
    expectLikeReference(scene, wholeView(*scene.mesh), floatThreshold);
}

INSTANTIATE_TEST_SUITE_P(Fields, CpuModes,
                         testing::Combine(testing::Values("bucky", "coulomb", "marschner-lobb", "hydrogen"),
                                          testing::Values(Mode::Standard, Mode::ScaleInvariant, Mode::Mip,
                                                          Mode::Average, Mode::FirstHit)));

class CpuFunctions : public testing::TestWithParam<std::tuple<const char*, Mode>> {};

TEST_P(CpuFunctions, AreLikeTheReference) {
    const auto [function, mode] = GetParam();
    const Scene scene = fieldScene("bucky", function, mode, 12);
    expectLikeReference(scene, wholeView(*scene.mesh), floatThreshold);
}

INSTANTIATE_TEST_SUITE_P(All, CpuFunctions,
                         testing::Combine(testing::Values("isosurfaces", "opaque", "constant", "jumps"),
                                          testing::Values(Mode::Standard, Mode::ScaleInvariant)));

double ramp(const glm::dvec3& p) {
    return 0.5 * p.x + 0.3 * p.y + 0.2 * p.z;
}

TEST(CpuEngine, ConstantExtinctionIsBeerLambert) {
    const double extinction = 1.5;
    Scene scene = sceneOf(boxMesh(5, ramp), constantFunction(extinction));
    const Camera camera = cameraAt({2.1, 1.7, 2.6});
    const CameraFrame frame = cameraFrame(camera);
    for (bool orderFree : {true, false}) {
        CpuSkips skips;
        skips.orderFree = orderFree;
        const Image image = cpuImage(scene, camera, skips);
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                const auto [in, out] = pathInBox(pixelRay(frame, x + frame.sampleShift.x, y + frame.sampleShift.y),
                                                 glm::dvec3(0), glm::dvec3(1));
                const double opacity = 1 - std::exp(-extinction * std::max(0.0, out - in));
                ASSERT_NEAR(image.at(x, y).w, opacity, 2e-6) << x << ", " << y;
                ASSERT_NEAR(image.at(x, y).x, 0.8 * opacity, 2e-6);
            }
    }
}

TEST(CpuEngine, OneTetrahedronOfOnePixelToWholeImage) {
    Scene scene = sceneOf(unitTetrahedron({0, 1, 0.3, 0.6}), smoothFunction(0, 1, 8));
    for (double distance : {0.4, 2.0, 20.0, 60.0})
        expectLikeReference(
            scene, cameraAt(glm::dvec3(0.25) + distance * glm::dvec3(0.5, 0.6, 0.62), glm::dvec3(0.25), 49, 41),
            floatThreshold);
}

TEST(CpuEngine, EyeInsideTheMesh) {
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::Mip, Mode::Average}) {
        Scene scene = fieldScene("bucky", "smooth", mode);
        Camera camera = cameraAt({0.41, 0.52, 0.47}, {0.9, 0.4, 0.3});
        camera.fovDegrees = 80;
        expectLikeReference(scene, camera, floatThreshold);
    }
}

TEST(CpuEngine, ViewsAlongAxesOfAGrid) {
    const Scene scene = fieldScene("bucky", "smooth", Mode::Standard, 8);
    for (const auto& [width, height] : {std::pair{33, 41}, std::pair{40, 32}, std::pair{1, 1}, std::pair{65, 3}})
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 eye(0.5);
            eye[axis] = 3.5;
            Camera camera = cameraAt(eye, glm::dvec3(0.5), width, height);
            if (axis == 1) camera.up = {0, 0, 1};
            expectLikeReference(scene, camera, floatThreshold);
        }
}

TEST(CpuEngine, OrthographicViews) {
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::Average}) {
        const Scene scene = fieldScene("hydrogen", "smooth", mode);
        Camera camera = wholeView(*scene.mesh);
        camera.orthographicHeight = 1.2 * scene.mesh->bounds.diagonal();
        expectLikeReference(scene, camera, floatThreshold);
        camera.eye = scene.mesh->bounds.centre() +
                     0.03 * (camera.eye - camera.target);  // what lies behind the eye's plane is not seen
        expectLikeReference(scene, camera, floatThreshold);
    }
}

TEST(CpuEngine, CellData) {
    mesh::ScalarMesh m = jitteredBoxMesh(6, 0.2, 7, ramp);
    std::vector<double> values;
    for (mesh::CellIndex c = 0; c < m.cells.size(); ++c) values.push_back(m.scalarAt(c, 0));
    m.scalars = values;
    m.association = mesh::Association::Cell;
    m = finished(std::move(m));
    for (Mode mode : {Mode::Standard, Mode::Mip, Mode::FirstHit})
        expectLikeReference(sceneOf(m, smoothFunction(m.scalarMin, m.scalarMax, 6), mode), cameraAt({2.0, 1.8, 2.4}),
                            floatThreshold);
}

TEST(CpuEngine, SilhouettesAndLight) {
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::FirstHit})
        for (int what = 1; what < 4; ++what) {
            Scene scene = fieldScene("bucky", what == 3 ? "isosurfaces" : "smooth", mode);
            scene.settings.shading.silhouette = (what & 1) != 0;
            if (what & 2)
                scene.settings.shading.lights = {{glm::normalize(glm::dvec3(0.4, 0.8, 0.6))},
                                                 {glm::normalize(glm::dvec3(-1, 0.2, 0.1))}};
            expectLikeReference(scene, wholeView(*scene.mesh), silhouetteThreshold);
        }
}

// Float; where a ray grazes an isosurface 1/|n·d| carries the rounding of n·d a thousandfold.
constexpr test::EngineThreshold variantThreshold{1e-5, 1e-3};

// Colour maps as they come in files: cells cross dozens of nodes.
TEST(CpuEngine, FunctionsOfManyNodes) {
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (int nodes : {64, 256, 1000})
            for (bool rough : {false, true}) {
                Scene scene = fieldScene("bucky", "smooth", mode);
                const preint::TransferFunction few = scene.transferFunction;
                const double low = scene.mesh->scalarMin, range = scene.mesh->scalarMax - low;
                scene.transferFunction = {};
                for (int i = 0; i < nodes; ++i) {
                    const double x = i / (nodes - 1.0), s = low + x * range;
                    const double other = rough ? 0.1 * (i * 7919 % 13) : 0.5 + 0.5 * std::sin(9 * x);
                    scene.transferFunction.color.push_back(
                        {s, glm::mix(few.colorAt(s), glm::dvec3(x, other, 1 - x), 0.4)});
                    scene.transferFunction.extinction.push_back({s, few.extinctionAt(s) * (0.2 + other)});
                }
                if (nodes == 64) scene.transferFunction.isosurfaces = {{low + 0.4 * range, 0.3, {1, 1, 1}}};
                expectLikeReference(scene, wholeView(*scene.mesh), floatThreshold);
            }
}

TEST(CpuEngine, QuickVariantsAreTheGeneralOnes) {
    for (int what = 0; what < 64; ++what) {
        Scene scene = fieldScene("bucky", (what & 1) != 0 ? "isosurfaces" : "smooth",
                                 (what & 2) != 0 ? Mode::Standard : Mode::ScaleInvariant);
        auto& shading = scene.settings.shading;
        const bool lit = (what & 4) != 0;
        shading.silhouette = (what & 8) != 0 || !lit;
        shading.exponent = (what & 16) != 0 ? 12.5 : 32.0;
        if (lit) {
            shading.lights = {{glm::normalize(glm::dvec3(0.4, 0.8, 0.6))}, {glm::normalize(glm::dvec3(-1, 0.2, 0.1))}};
            shading.transmission = (what & 8) != 0;
        }
        Camera camera = wholeView(*scene.mesh);
        if ((what & 32) != 0) camera.orthographicHeight = 1.6 * scene.mesh->bounds.diagonal();
        expectLikeGeneral(scene, camera, variantThreshold, std::to_string(what));
    }
}

/// Point, head and coloured lights within and around the unit cube, attenuated and not, and a material of its own.
void setLocalLights(int which, bool halfway, const glm::dvec3& centre, shading::ShadingSettings& shading) {
    using shading::Light;
    Light point, near, head, colored;
    point.kind = near.kind = Light::Kind::Point;
    point.position = centre + glm::dvec3(0.9, 1.1, 0.8);
    near.position = centre;  // a vertex of some meshes: all around it is lit from there
    near.color = {0.5, 0.8, 1.0};
    near.attenuation = {0.8, 0.5, 2.0};
    head.kind = Light::Kind::Head;
    colored.towards = glm::normalize(glm::dvec3(-0.3, 0.6, -0.7));
    colored.color = {1.0, 0.7, 0.3};
    if (which == 0) shading.lights = {head};
    if (which == 1) shading.lights = {point};
    if (which == 2) {
        head.attenuation = {0.5, 0.1, 0.05};
        shading.lights = {colored, near, head};
        shading.ambientColor = {0.4, 1.0, 0.7};
        shading.material.diffuse = 0.8;
        shading.material.specularTransmission = 0.6;
        shading.material.front = shading.material.back = {{1.0, 0.9, 0.4}, 20.0};
    }
    shading.reflectance = halfway ? shading::Reflectance::BlinnPhong : shading::Reflectance::Phong;
    if (halfway && which == 0) shading.lights.push_back({glm::normalize(glm::dvec3(0.4, 0.8, 0.6))});
}

TEST(CpuEngine, LocalLightsAreTheGeneralLight) {
    for (int what = 0; what < 48; ++what) {
        Scene scene = fieldScene("bucky", (what & 1) != 0 ? "isosurfaces" : "smooth",
                                 (what & 2) != 0 ? Mode::Standard : Mode::ScaleInvariant);
        auto& shading = scene.settings.shading;
        setLocalLights(what / 16, (what & 4) != 0, scene.mesh->bounds.centre(), shading);
        shading.silhouette = (what & 4) == 0;
        shading.exponent = (what & 4) != 0 ? 12.5 : 32.0;
        Camera camera = wholeView(*scene.mesh);
        if ((what & 8) != 0) camera.orthographicHeight = 1.6 * scene.mesh->bounds.diagonal();
        expectLikeGeneral(scene, camera, variantThreshold, std::to_string(what));
    }
}

TEST(CpuEngine, RandomMeshesNeedNoCertificate) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const auto holed = carved(jitteredBoxMesh(7, 0.25, seed, ramp), [](const glm::dvec3& p) {
            return std::abs(p.x - 0.5) > 0.2 || std::abs(p.y - 0.4) > 0.25;
        });
        const Scene scene = sceneOf(holed, smoothFunction(0, 1, 8));
        const Camera camera = cameraAt({2.3, 1.2 - 0.5 * seed, 1.9});
        RayCastCounts counts;
        const Image reference = ReferenceRayCaster(scene).render(camera, counts);
        FrameReport report;
        const Image image = withExactRepair(makeCpuEngineWith(scene, {}), scene)->render(camera, report);
        EXPECT_LE(compareImages(image, reference).rmse, floatThreshold.rmse) << report.orderMethod;
    }
}

TEST(CpuEngine, UnitsDoNotMatter) {
    const Scene plain = sceneOf(jitteredBoxMesh(6, 0.2, 3, ramp), smoothFunction(0, 1, 6));
    const Camera camera = cameraAt({2.1, 1.5, 2.2});
    const Image expected = cpuImage(plain, camera);
    for (double scale : {1e-12, 1e12})
        for (double shift : {0.0, 1e6}) {
            mesh::ScalarMesh m = *plain.mesh;
            auto moved = [&](const glm::dvec3& p) { return scale * (p + shift); };
            for (auto& p : m.positions) p = moved(p);
            for (auto& s : m.scalars) s = 1e9 + 1e-3 * s;
            m = finished(std::move(m));
            auto function = smoothFunction(1e9, 1e9 + 1e-3, 6 / scale);
            Camera there = camera;
            there.eye = moved(camera.eye);
            there.target = moved(camera.target);
            // scalars of 1e9 keep 1e-4 of a range of 1e-3; positions of 1e6 keep 1e-10
            EXPECT_LE(compareImages(cpuImage(sceneOf(std::move(m), function), there), expected).rmse, 1e-4)
                << scale << " " << shift;
        }
}

TEST(CpuEngine, DepthsFromNothingToEverything) {
    for (double extinction : {1e-9, 1e-3, 1.0, 1e3, 1e6, 1e12}) {
        Scene scene = sceneOf(boxMesh(4, ramp), smoothFunction(0, 1, extinction));
        const Camera camera = cameraAt({2.1, 1.7, 2.6});
        RayCastCounts counts;
        const ImageDifference difference =
            compareImages(cpuImage(scene, camera), ReferenceRayCaster(scene).render(camera, counts));
        EXPECT_LE(difference.rmse, 5e-5) << extinction;
        EXPECT_LE(difference.max, std::min(2e-3, extinction)) << extinction;
    }
}

TEST(CpuEngine, SkippingInvisibleCellsChangesNothing) {
    Scene scene = fieldScene("bucky", "smooth", Mode::Standard, 12);
    const double low = scene.mesh->scalarMin, range = scene.mesh->scalarMax - low;
    scene.transferFunction.extinction = {{low + 0.6 * range, 0.0}, {low + 0.7 * range, 20.0}, {low + range, 30.0}};
    const Camera camera = wholeView(*scene.mesh);
    CpuSkips all;
    all.invisibleCells = false;
    {  // one in ten is left out: by bits, not by a list
        std::vector<double> largest;
        for (mesh::CellIndex c = 0; c < scene.mesh->cells.size(); ++c)
            largest.push_back(std::max({scene.mesh->scalarAt(c, 0), scene.mesh->scalarAt(c, 1),
                                        scene.mesh->scalarAt(c, 2), scene.mesh->scalarAt(c, 3)}));
        std::sort(largest.begin(), largest.end());
        Scene most = scene;
        most.transferFunction.extinction = {{largest[largest.size() / 10], 0.0}, {low + range, 30.0}};
        FrameReport with;
        const Image skipped = cpuImage(most, camera, with), full = cpuImage(most, camera, all);
        EXPECT_NEAR(static_cast<double>(with.cellsSkipped["invisible by transfer function"]),
                    0.1 * static_cast<double>(largest.size()), 0.02 * static_cast<double>(largest.size()));
        EXPECT_EQ(compareImages(skipped, full).max, 0.0);
    }
    for (bool isosurface : {false, true}) {
        if (isosurface) scene.transferFunction.isosurfaces = {{low + 0.3 * range, 0.3, {1, 1, 1}}};
        FrameReport with, without;
        const Image skipped = cpuImage(scene, camera, with), full = cpuImage(scene, camera, without, all);
        EXPECT_GT(with.cellsSkipped["invisible by transfer function"], scene.mesh->cells.size() / 4);
        EXPECT_EQ(without.cellsSkipped.count("invisible by transfer function"), 0u);
        // With isosurfaces a cell takes the scalar at its face from the cell before, if that was drawn: the last bit
        // may change.
        EXPECT_LE(compareImages(skipped, full).max, isosurface ? 1.2e-7 : 0.0);
    }
}

TEST(CpuEngine, EarlyTerminationChangesLessThanItsBound) {
    const Scene scene = fieldScene("bucky", "opaque", Mode::Standard, 16);
    const Camera camera = wholeView(*scene.mesh, 96, 96);
    CpuSkips all;
    all.earlyTermination = false;
    FrameReport with, without;
    const Image stopped = cpuImage(scene, camera, with), full = cpuImage(scene, camera, without, all);
    EXPECT_LT(with.fragments, without.fragments);
    EXPECT_LE(compareImages(stopped, full).max, 2e-6);
}

TEST(CpuEngine, OrderFreePicturesAreNotSorted) {
    const Scene scene = fieldScene("bucky", "constant", Mode::Standard);
    const Camera camera = wholeView(*scene.mesh);
    CpuSkips sorted;
    sorted.orderFree = false;
    FrameReport with, without;
    const Image free = cpuImage(scene, camera, with), ordered = cpuImage(scene, camera, without, sorted);
    EXPECT_EQ(with.orderMethod, "none");
    EXPECT_EQ(with.stageMilliseconds.count("sort"), 0u);
    EXPECT_EQ(with.cellsSorted, 0u);
    EXPECT_NE(without.orderMethod, "none");
    EXPECT_LE(compareImages(free, ordered).max, 2e-6);
    for (Mode mode : {Mode::Mip, Mode::Average}) {
        FrameReport report;
        cpuImage(fieldScene("bucky", "smooth", mode), camera, report);
        EXPECT_EQ(report.orderMethod, "none");
        EXPECT_EQ(report.stageMilliseconds.count("sort"), 0u);
    }
}

TEST(CpuEngine, KeepsListsWhileTheCameraStays) {
    const Scene scene = fieldScene("bucky", "smooth", Mode::Standard);
    const Camera first = wholeView(*scene.mesh), second = orbited(first, 0.3);
    auto engine = makeCpuEngineWith(scene, {});
    FrameReport report, again, other, back;
    const Image image = engine->render(first, report);
    EXPECT_TRUE(engine->render(first, again).pixels == image.pixels);
    EXPECT_EQ(again.stageMilliseconds.count("cull"), 0u);
    EXPECT_EQ(again.cellsDrawn, report.cellsDrawn);
    EXPECT_FALSE(engine->render(second, other).pixels == image.pixels);
    EXPECT_TRUE(engine->render(first, back).pixels == image.pixels);
}

TEST(CpuEngine, ThreadsDoNotChangeABit) {
    for (const char* function : {"smooth", "isosurfaces", "constant"}) {
        const Scene scene = fieldScene("bucky", function, Mode::Standard, 14);
        const Camera camera = wholeView(*scene.mesh, 150, 110);
        std::vector<Image> images;
        for (int threads : {1, 2, 5}) {
            tbb::task_arena arena(threads);
            images.push_back(arena.execute([&] { return cpuImage(scene, camera); }));
        }
        EXPECT_TRUE(images[0].pixels == images[1].pixels);
        EXPECT_TRUE(images[0].pixels == images[2].pixels);
    }
}

TEST(CpuEngine, InstructionSetsAgree) {
    const Scene scene = fieldScene("bucky", "smooth", Mode::Standard, 12);
    const Scene lit = [&] {
        Scene s = fieldScene("bucky", "isosurfaces", Mode::ScaleInvariant, 12);
        s.settings.shading.silhouette = true;
        return s;
    }();
    for (const Scene& each : {scene, lit}) {
        const Camera camera = wholeView(*each.mesh, 64, 64);
        const Image best = cpuImage(each, camera);
        for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
            hwy::SetSupportedTargetsForTest(target);
            const Image image = cpuImage(each, camera);
            hwy::SetSupportedTargetsForTest(0);
            EXPECT_LE(compareImages(image, best).rmse, 1e-5) << hwy::TargetName(target);
        }
    }
}

TEST(CpuEngine, CellsOutOfOrderAreNoticed) {
    const Scene scene = fieldScene("bucky", "smooth", Mode::Standard);
    CpuSkips unsorted;
    unsorted.sort = false;
    for (bool orthographic : {false, true}) {
        Camera camera = wholeView(*scene.mesh);
        if (orthographic) camera.orthographicHeight = 1.6;
        FrameReport right, wrong;
        const Image expected = cpuImage(scene, camera, right), image = cpuImage(scene, camera, wrong, unsorted);
        EXPECT_TRUE(right.uncertainPixels.empty());
        std::size_t different = 0;
        for (std::uint32_t i = 0; i < image.pixels.size(); ++i) {
            const glm::vec4 d = glm::abs(image.pixels[i] - expected.pixels[i]);
            if (std::max({d.x, d.y, d.z}) < 1e-4f) continue;
            ++different;
            ASSERT_TRUE(std::binary_search(wrong.uncertainPixels.begin(), wrong.uncertainPixels.end(), i)) << i;
        }
        EXPECT_GT(different, 100u);
    }
}

}  // namespace
}  // namespace tetralux::projection
