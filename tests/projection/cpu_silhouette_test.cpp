// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes in the tile engine (Kraus 2005, Equations 15 and 17), which has ways of its own for isosurfaces, for
// isosurfaces in a medium and for what has one colour: each against the general way and against the reference.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/tet/procedural_field.h>
#include <projection/cpu/cpu_engine.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/cpu_pictures.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// Cells of a hundred pixels, seen from near by: where the polynomial for an isosurface's opacity over a cell
// (cpu_isosurface_variant.h) would not hold, something else must be taken.
TEST(CpuSilhouettes, IsosurfacesInWideCells) {
    for (int n : {3, 5, 9})
        for (double opacity : {0.02, 0.6, 1.0}) {
            Scene scene = sceneOf(
                jitteredBoxMesh(n, 0.2, 7,
                                [](const glm::dvec3& p) { return glm::dot(p - glm::dvec3(0.5), p - glm::dvec3(0.5)); }),
                constantFunction(0.0), Mode::ScaleInvariant);
            scene.transferFunction.isosurfaces = {{0.09, opacity, {1, 0.4, 0.1}}, {0.3, 0.3 * opacity, {0, 0.4, 1}}};
            scene.settings.shading.silhouette = true;
            for (double fov : {30.0, 100.0}) {
                Camera camera = cameraAt({1.2, 0.9, 1.1});
                camera.width = camera.height = 160;
                camera.fovDegrees = fov;
                // not the reference: whether float meets a surface in this cell or its neighbour, a thousandth of its
                // slope apart, decides single pixels
                expectLikeGeneral(scene, camera, {4e-6, 4e-6}, fmt::format("{} {} {}", n, opacity, fov));
            }
        }
}

/// Colour and extinction below and above isosurfaces at 0.35 and 0.65 of the range.
struct Medium {
    const char* name;
    std::vector<preint::ColorNode> color;
    std::vector<preint::ExtinctionNode> extinction;
};

const std::vector<Medium> media{
    {"thin", {{0, {0.3, 0.3, 0.3}}, {1, {0.7, 0.7, 0.7}}}, {{0, 0.1}, {1, 0.1}}},
    {"colourful", {{0, {0.1, 0.9, 0.2}}, {0.35, {1, 0, 0}}, {0.65, {0, 0.2, 1}}, {1, {1, 1, 0}}}, {{0, 0}, {1, 4}}},
    {"dense", {{0, {0.1, 0.9, 0.2}}, {1, {1, 0.1, 0}}}, {{0, 20}, {0.5, 300}, {1, 50}}},
    {"on one side", {{0, {0.9, 0.9, 0.2}}, {1, {1, 0.1, 0}}}, {{0, 0}, {0.35, 0}, {0.35, 3}, {0.65, 3}, {0.65, 0}}},
};

preint::TransferFunction behind(const Medium& medium, const mesh::ScalarMesh& mesh, Mode mode) {
    preint::TransferFunction function{.color = medium.color,
                                      .extinction = medium.extinction,
                                      .isosurfaces = {{0.35, 0.4, {0.1, 0.4, 0.9}}, {0.65, 0.7, {0.9, 0.5, 0.1}}}};
    function.normalized = function.extinctionPerExtent = true;
    const double range = mesh.scalarMax - mesh.scalarMin;
    return preint::resolved(function, mesh.scalarMin, mesh.scalarMax,
                            mode == Mode::ScaleInvariant ? range : mesh.bounds.diagonal());
}

Scene silhouettesOf(const char* field, const Medium& medium, Mode mode) {
    mesh::ScalarMesh m = sampledMesh(mesh::proceduralField(field, 12), 12);
    const preint::TransferFunction function = behind(medium, m, mode);
    Scene scene = sceneOf(std::move(m), function, mode);
    scene.settings.shading.silhouette = true;
    return scene;
}

// Where a ray grazes a cell's level sets 1/|n·d| carries float's rounding of n·d a thousandfold: up to 3e-6 rmse and
// 3e-4 were seen. `hydrogen` has cells whose gradient is a rounding error, 1e-19.
TEST(CpuSilhouettes, IsosurfacesInMedia) {
    for (const Medium& medium : media)
        for (const char* field : {"bucky", "hydrogen"})
            for (const Mode mode : {Mode::ScaleInvariant, Mode::Standard})
                for (const bool orthographic : {false, true}) {
                    const Scene scene = silhouettesOf(field, medium, mode);
                    Camera camera = wholeView(*scene.mesh, 90, 80);
                    if (orthographic) camera.orthographicHeight = 1.1 * scene.mesh->bounds.diagonal();
                    const std::string what =
                        fmt::format("{} {} {} {}", medium.name, field, static_cast<int>(mode), orthographic);
                    expectLikeGeneral(scene, camera, {2e-6, 1e-4}, what);
                    SCOPED_TRACE(what);
                    expectLike(referenceThatShows(scene, camera), scene, camera, {"cpu", "auto"}, {1e-5, 1e-3});
                }
}

// What has one colour needs no order, silhouettes or not.
TEST(CpuSilhouettes, OneColourNeedsNoOrder) {
    for (const bool isosurface : {false, true})
        for (const Mode mode : {Mode::ScaleInvariant, Mode::Standard, Mode::Absorption})
            for (const bool orthographic : {false, true}) {
                Scene scene = silhouettesOf("bucky", {"", {{0, {0.9, 0.6, 0.2}}}, {{0, 0}, {0.3, 0.5}, {1, 3}}}, mode);
                auto& surfaces = scene.transferFunction.isosurfaces;
                surfaces.resize(isosurface ? 1 : 0);
                for (auto& surface : surfaces) surface.color = {0.9, 0.6, 0.2};
                Camera camera = wholeView(*scene.mesh, 90, 80);
                if (orthographic) camera.orthographicHeight = 1.1 * scene.mesh->bounds.diagonal();
                SCOPED_TRACE(fmt::format("{} {} {}", isosurface, static_cast<int>(mode), orthographic));
                FrameReport report;
                cpuImage(scene, camera, report);
                EXPECT_EQ(report.orderMethod, "none");
                expectLike(referenceThatShows(scene, camera), scene, camera, {"cpu", "auto"}, {1e-5, 1e-3});
            }
}

}  // namespace
}  // namespace tetralux::projection
