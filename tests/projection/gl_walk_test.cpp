// SPDX-License-Identifier: Apache-2.0
//
// What gl does of which it cannot be sure: tables that miss their error, what has opacity, an order that is none.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <projection/frame/engine_registry.h>
#include <projection/gl/gl_engine.h>
#include <projection/gl/gl_walk.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

double waves(const glm::dvec3& p) {
    return 0.5 + 0.5 * std::sin(7 * p.x + 2 * p.y) * std::cos(5 * p.z);
}

/// Neighbouring nodes know nothing of each other: no table of a reasonable size holds it.
preint::TransferFunction roughFunction(int nodes, double tau) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    preint::TransferFunction function;
    for (int i = 0; i < nodes; ++i) {
        const double s = static_cast<double>(i) / (nodes - 1);
        function.color.push_back({s, {share(random), share(random), share(random)}});
        function.extinction.push_back({s, i % 3 == 0 ? 0.0 : tau * share(random)});
    }
    return function;
}

TEST(GlWalk, RoughFunctionsAreLikeTheReference) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::FirstHit, Mode::Additive, Mode::Absorption}) {
        const double tau = mode == Mode::Standard ? 400.0 : 8.0;
        Scene scene = sceneOf(jitteredBoxMesh(4, 0.2, 5, waves), roughFunction(90, tau), mode);
        scene.transferFunction.isosurfaces = {{0.4, 0.5, {1, 0, 0}}};
        const Camera camera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 24, 20);
        const Image exact = pictureOf(scene, camera, {"reference", "auto"});
        float brightest = 1.0f;
        for (const glm::vec4& pixel : exact.pixels) brightest = std::max({brightest, pixel.x, pixel.y, pixel.z});
        // Gauss's rule errs by 1e-6 of a step; floats of scalars at nodes as close as these by 1e-5
        EXPECT_LE(compareImages(pictureOf(scene, camera, {"gl", "auto"}), exact).max, 1e-4 * brightest)
            << static_cast<int>(mode);
    }
}

TEST(GlWalk, OnlyWhereTheTableMissesItsError) {
    Scene scene = sceneOf(boxMesh(3, waves), smoothFunction(0, 1));
    EXPECT_FALSE(makeGlEngine(scene, {})->walksNodes());
    scene.transferFunction = roughFunction(90, 8.0);
    const auto engine = makeGlEngine(scene, {});
    EXPECT_TRUE(engine->walksNodes());
    EXPECT_GT(engine->table()->measuredError, engine->wantedTableError());
    scene.settings.table.size = 64;  // a table that is asked for is taken
    EXPECT_FALSE(makeGlEngine(scene, {})->walksNodes());
}

TEST(GlWalk, PiecesEndWhereZonesDo) {
    preint::TransferFunction function;
    function.color = {{0.0, {1, 0, 0}}, {0.5, {0, 1, 0}}, {1.0, {0, 0, 1}}};
    function.extinction = {{0.0, 0.0}, {0.25, 1.0}, {0.25, 3.0}, {1.0, 2.0}};
    preint::PreintegrationTable table;
    table.zones = {{0.0, 0.25}, {0.25, 1.0}};
    const WalkedPieces pieces = walkedPieces(function, table);
    EXPECT_EQ(pieces.zonePiece, (std::vector<int>{0, 1, 3}));
    ASSERT_EQ(pieces.texels.size(), 9u);
    EXPECT_EQ(pieces.texels[0], glm::vec4(0.0f, 0.25f, 0.0f, 1.0f));
    EXPECT_EQ(glm::vec3(pieces.texels[1]), glm::vec3(0.25f, 0.5f, 3.0f));
    EXPECT_EQ(glm::vec3(pieces.texels[3]), glm::vec3(1, 0, 0)) << "colour at the low end of the first";
    EXPECT_EQ(glm::vec3(pieces.texels[8]), glm::vec3(0, 0, 1)) << "colour at the high end of the last";
}

/// Pixels in which one picture shows something and the other nothing.
std::size_t shownInOne(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += (a.pixels[i].w > 0) != (b.pixels[i].w > 0) ? 1 : 0;
    return count;
}

TEST(GlFirstHit, SamplesBesidePeaksAreNothing) {
    Scene scene = sceneOf(jitteredBoxMesh(4, 0.2, 5, waves), roughFunction(2, 1.0), Mode::FirstHit);
    scene.transferFunction.extinction = {{0.4, 0.0}, {0.45, 5.0}, {0.5, 0.0}};
    scene.transferFunction.isosurfaces = {{0.7, 0.5, {1, 0, 0}}};
    for (const Classification kind : {Classification::Post, Classification::PostLinear, Classification::Pre}) {
        scene.settings.classification = kind;
        const Camera camera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 24, 20);
        EXPECT_EQ(shownInOne(pictureOf(scene, camera, {"gl", "auto"}), referenceThatShows(scene, camera)), 0u)
            << static_cast<int>(kind);
    }
}

TEST(GlFirstHit, WithGradientOpacityPlateausAreNothing) {
    const auto half = [](const glm::dvec3& p) { return std::max(p.x, 0.5); };
    for (const int size : {0, 64}) {  // the table walked and interpolated
        Scene scene = sceneOf(boxMesh(5, half), constantFunction(1.0), Mode::FirstHit);
        scene.settings.shading.gradientOpacity = 1.0;
        scene.settings.table.size = size;
        const Camera camera = cameraAt({0.3, 0.4, 4.0}, glm::dvec3(0.5), 24, 20);
        EXPECT_EQ(shownInOne(pictureOf(scene, camera, {"gl", "auto"}), referenceThatShows(scene, camera)), 0u) << size;
    }
}

TEST(GlCentroidOrder, WhatItSpoilsIsCounted) {
    Scene scene = sceneOf(jitteredBoxMesh(6, 0.25, 5, waves), smoothFunction(0, 1, 5));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const Image exact = pictureOf(scene, camera, {"reference", "auto"});
    for (const OrderMethod order : {OrderMethod::Auto, OrderMethod::Centroid}) {
        scene.settings.order = order;
        FrameReport report;
        const Image image = makeEngine(scene, {.engine = "gl"})->render(camera, report);
        std::uint64_t wrong = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const glm::vec4 difference = glm::abs(image.pixels[i] - exact.pixels[i]);
            wrong += std::max({difference.x, difference.y, difference.z, difference.w}) > 1e-3f ? 1 : 0;
        }
        EXPECT_LE(wrong, report.pixelsWrong);
        EXPECT_EQ(wrong > 0, order == OrderMethod::Centroid);
        EXPECT_EQ(report.pixelsWrong > 0, order == OrderMethod::Centroid);
        EXPECT_EQ(report.pixelsRepaired, 0u);
    }
}

}  // namespace
}  // namespace tetralux::projection
