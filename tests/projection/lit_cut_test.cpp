// SPDX-License-Identifier: Apache-2.0
//
// The layer behind a cut, upon which light falls by the cut's normal: closed forms, every engine and path, and what
// must not depend on the mesh.
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/core/clip_region.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

const std::vector<EngineOptions> engines{{"reference", "auto"},
                                         {"cpu", "auto"},
                                         {"gl", "auto", "stream"},
                                         {"gl", "auto", "resident"},
                                         {"gl", "auto", "tiles"}};

constexpr double extinction = 1.7, exponent = 4.0, ambient = 0.2;
const glm::dvec3 color(0.8, 0.5, 0.25);

std::vector<std::shared_ptr<const PixelMapSource>> cutBy(std::vector<HalfSpace> halves, double layer) {
    return {std::make_shared<ClipRegion>(std::move(halves), layer)};
}

/// A cube of constant extinction whose gradient is across `plane`'s normal, towards which the only light shines: by the
/// field's normals there is only ambient light, by the plane's all of it.
Scene cubeLitByItsCut(const HalfSpace& plane, double layer, const mesh::ScalarMesh& cube) {
    Scene scene = sceneOf(cube, constantFunction(extinction, color));
    scene.mapSources = cutBy({plane}, layer);
    scene.settings.shading.lights.push_back({-glm::normalize(plane.normal)});
    scene.settings.shading.ambient = ambient;
    scene.settings.shading.exponent = exponent;
    return scene;
}

/// Light of what lies from the plane to `layer` behind it, and ambient light of all that is left.
glm::dvec4 expected(const HalfSpace& plane, double layer, const Ray& ray) {
    auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
    const glm::dvec3 inwards = glm::normalize(plane.normal);
    const double rate = glm::dot(ray.direction, inwards);
    const double meets = glm::dot(plane.point - ray.origin, inwards) / rate;
    in = std::max(in, meets);
    const auto opacityTo = [&](double t) { return -std::expm1(-extinction * std::max(0.0, t - in)); };
    const double whole = opacityTo(out), lit = opacityTo(std::min(out, meets + layer / rate));
    return {ambient * color * whole + lit * (color + std::pow(rate, exponent)), whole};
}

void expectLightOfTheLayer(const HalfSpace& plane, double layer, const mesh::ScalarMesh& cube, bool orthographic) {
    const Scene scene = cubeLitByItsCut(plane, layer, cube);
    Camera camera = cameraAt(glm::dvec3(0.5) - 2.5 * glm::normalize(plane.normal) + glm::dvec3(0.3, 0.2, 0));
    if (orthographic) camera.orthographicHeight = 1.6;
    const CameraFrame frame = cameraFrame(camera);
    for (const EngineOptions& options : engines) {
        const Image image = pictureOf(scene, camera, options);
        double worst = 0, brightest = 0;
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                const glm::dvec4 value = expected(plane, layer, pixelRay(frame, x, y));
                const glm::dvec4 difference = glm::abs(glm::dvec4(image.at(x, y)) - value);
                worst = std::max({worst, difference.x, difference.y, difference.z, difference.w});
                brightest = std::max(brightest, value.x);
            }
        // samples of the fast engines stand 6e-5 pixels beside the centres
        EXPECT_LE(worst, options.engine == "reference" ? 1e-6 : 5e-5) << options.engine << options.glPath << layer;
        EXPECT_GT(brightest, 0.05);
    }
}

double acrossZ(const glm::dvec3& p) {
    return p.x + 0.5 * p.y;
}

TEST(LitCut, LightsItsLayerByItsNormal) {
    const HalfSpace plane{{0, 0, 0.47}, {0, 0, -1}};
    for (const double layer : {0.01, 0.15, 3.0}) {
        expectLightOfTheLayer(plane, layer, boxMesh(5, acrossZ), false);
        expectLightOfTheLayer(plane, layer, jitteredBoxMesh(5, 0.2, 3, acrossZ), true);
    }
}

TEST(LitCut, MayRunAlongFaces) {
    const HalfSpace plane{{0, 0, 0.5}, {0, 0, -2}};
    for (const double layer : {0.02, 0.25})  // ends within cells, and at faces
        for (const bool orthographic : {false, true})
            expectLightOfTheLayer(plane, layer, boxMesh(5, acrossZ), orthographic);
}

// Without a layer the field's normals are lit right from the plane on.
TEST(LitCut, MayHaveNoLayer) {
    expectLightOfTheLayer({{0, 0, 0.5}, {0, 0, -1}}, 0.0, boxMesh(5, acrossZ), false);
}

// The same medium in ever finer meshes: what light does to a cut is not the mesh's affair.
TEST(LitCut, DoesNotShowTheMesh) {
    const HalfSpace plane{{0.5, 0.5, 0.5}, {-0.3, -0.2, -1}};
    const auto drawn = [&](int n) {
        Scene scene = sceneOf(boxMesh(n, acrossZ), constantFunction(40.0, color));
        scene.mapSources = cutBy({plane}, 0.1);
        scene.settings.shading.lights.push_back({glm::normalize(glm::dvec3(0.2, 0.5, 1))});
        scene.settings.shading.transmission = false;
        return pictureOf(scene, cameraAt({1.1, 1.4, 3}), {"cpu", "auto"});
    };
    const ImageDifference difference = compareImages(drawn(2), drawn(9));
    EXPECT_LE(difference.max, 1e-4);
}

Scene bucky(Mode mode) {
    const mesh::ScalarMesh field = sampledMesh(mesh::proceduralField("bucky", 17), 17);
    const double extent = mode == Mode::ScaleInvariant ? field.scalarMax - field.scalarMin : 1.0;
    Scene scene = sceneOf(field, smoothFunction(field.scalarMin, field.scalarMax, 12.0 / extent), mode);
    scene.settings.shading.lights.push_back({glm::normalize(glm::dvec3(1, 2, 3))});
    return scene;
}

// Along faces, where two cells are met at one distance, and through cells; a box whose edges are met; the eye within a
// layer.
TEST(LitCut, EnginesAgree) {
    const std::vector<std::pair<std::string, std::vector<HalfSpace>>> cuts{
        {"along faces", {{{0, 0, 0.5}, {0, 0, -1}}}},
        {"oblique", {{{0.5, 0.5, 0.55}, {-1, -0.4, 0.3}}}},
        {"box", boxHalfSpaces({0.25, 0.1, 0.2}, {0.75, 0.8, 0.5})},
        {"slab", slabHalfSpaces({0.5, 0.5, 0.5}, {0, 0, 1}, 0.25)}};
    // tables of the default error; sampled beside the centres
    constexpr EngineThreshold threshold{1e-5, 1e-4};
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        const auto& [name, halves] = cuts[k];
        Scene scene = bucky(std::array{Mode::Standard, Mode::Additive, Mode::ScaleInvariant}[k % 3]);
        scene.mapSources = cutBy(halves, cutLayerShare * std::sqrt(3.0));
        const Camera outside = cameraAt({1.9, 1.4, 2.3}), within = cameraAt({0.45, 0.52, 0.498}, {0.1, 0.55, 0.45});
        const Image fromOutside = referenceThatShows(scene, outside, name),
                    fromWithin = referencePicture(scene, within);
        for (const EngineOptions& options : {engines[1], engines[2], engines[4]}) {
            expectLike(fromOutside, scene, outside, options, threshold, name + ' ' + options.glPath);
            expectLike(fromWithin, scene, within, options, threshold, name + " within " + options.glPath);
        }
    }
}

}  // namespace
}  // namespace tetralux::projection
