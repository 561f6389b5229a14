// SPDX-License-Identifier: Apache-2.0
//
// Light in full: every engine against the reference, and the reference against what must hold whatever the formulas.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/frame/engine_registry.h>
#include <projection/image/image_structure.h>
#include <projection/light/light_frame.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;
using shading::Light;

mesh::ScalarMesh waves() {
    return jitteredBoxMesh(7, 0.2, 3, [](const glm::dvec3& p) {
        return 0.5 * p.x + 0.3 * std::sin(5 * p.y) + 0.4 * p.z * p.z + 0.2 * std::cos(4 * p.x * p.z);
    });
}

Scene litScene(Mode mode) {
    mesh::ScalarMesh m = waves();
    const double low = m.scalarMin, high = m.scalarMax;
    const double extent = mode == Mode::ScaleInvariant ? high - low : 1.0;
    auto function = smoothFunction(low, high, 12.0 / extent);
    return sceneOf(std::move(m), function, mode);
}

Light directional(const glm::dvec3& towards) {
    Light light;
    light.towards = glm::normalize(towards);
    return light;
}

Light point(const glm::dvec3& position, const glm::dvec3& attenuation = {1, 0, 0}) {
    Light light;
    light.kind = Light::Kind::Point;
    light.position = position;
    light.attenuation = attenuation;
    return light;
}

Light head() {
    Light light;
    light.kind = Light::Kind::Head;
    return light;
}

const std::map<std::string, std::function<void(shading::ShadingSettings&)>>& cases() {
    static const std::map<std::string, std::function<void(shading::ShadingSettings&)>> all{
        {"Plain",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6})};
         }},
        {"PointLights",
         [](auto& s) {
             s.lights = {point({1.5, 1.2, 1.8}, {0.5, 0.2, 0.3}), point({0.4, 0.5, 0.6}, {1, 1, 4})};
             s.lights[1].color = {0.9, 0.4, 0.2};
         }},
        {"HeadLight", [](auto& s) { s.lights = {head()}; }},
        {"FadingHeadLight",
         [](auto& s) {
             s.lights = {head(), directional({-0.5, -0.4, -0.7})};
             s.lights[0].attenuation = {0.5, 0.2, 0.3};
             s.material.back.exponent = 9;
         }},
        {"TwoSidedMaterial",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6}), directional({-0.6, 0.2, -0.7})};
             s.lights[0].color = {1.2, 0.9, 0.7};
             s.ambientColor = {0.5, 1, 2};
             s.material.front = {{1, 0.5, 0.2}, 40};
             s.material.back = {{0.1, 0.6, 0.9}, 8};
             s.material.diffuse = 0.7;
             s.material.specularTransmission = 0.6;
             s.material.diffuseTransmission = 0.8;
         }},
        {"BlinnPhong",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6}), head()};
             s.reflectance = shading::Reflectance::BlinnPhong;
         }},
        {"HenyeyGreenstein",
         [](auto& s) {
             s.lights = {directional({-0.4, -0.3, -0.8})};
             s.reflectance = shading::Reflectance::None;
             s.material.phaseAsymmetry = 0.6;
         }},
        {"PhaseAndBlinnPhong",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6}), directional({-0.4, -0.3, -0.8})};
             s.reflectance = shading::Reflectance::BlinnPhong;
             s.material.phaseAsymmetry = -0.3;
             s.material.specularByGradient = shading::GradientSpecular::Absolute;
         }},
        {"Ward",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6})};
             s.reflectance = shading::Reflectance::Ward;
             s.anisotropy.radius = 2;
         }},
        {"Lafortune",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6})};
             s.reflectance = shading::Reflectance::Lafortune;
             s.normals = shading::Normals::Smooth;
             s.anisotropy.radius = 2;
         }},
        {"Shadows",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6}), point({0.5, 1.6, 0.5}), head()};
             s.shadows.on = true;
         }},
        {"SpecularByGradient",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6})};
             s.material.specularByGradient = shading::GradientSpecular::Relative;
         }},
        {"SmoothNormals",
         [](auto& s) {
             s.lights = {directional({0.4, 0.8, 0.6}), point({0.5, 1.4, 0.5})};
             s.normals = shading::Normals::Smooth;
         }},
    };
    return all;
}

std::vector<EngineOptions> fastEngines() {
    return {{"cpu", "auto"}, {"gl", "egl"}, {"gl", "osmesa"}};
}

Image referenceOf(const Scene& scene, const Camera& camera) {
    RayCastCounts counts;
    return ReferenceRayCaster(scene).render(camera, counts);
}

class LightCases : public testing::TestWithParam<std::tuple<std::string, Mode>> {};

TEST_P(LightCases, AreTheSameInEveryEngine) {
    const auto [name, mode] = GetParam();
    Scene scene = litScene(mode);
    cases().at(name)(scene.settings.shading);
    scene = withVertexLight(std::move(scene));
    std::vector<Camera> cameras{cameraAt({2.1, 1.7, 2.4}, glm::dvec3(0.5), 40, 32),
                                cameraAt({2.1, 1.7, 2.4}, glm::dvec3(0.5), 40, 32),
                                cameraAt({0.45, 0.55, 0.5}, {0.9, 0.4, 0.2}, 40, 32)};
    cameras[1].orthographicHeight = 1.6;
    cameras[2].fovDegrees = 80;
    // single pixels differ: rims of what first-hit shows, and highlights where the sample shift meets another cell
    const double rmse = mode == Mode::FirstHit ? 2e-3 : 2e-4, max = mode == Mode::FirstHit ? 0.3 : 2e-2;
    scene.settings.shading.silhouette = mode == Mode::Standard;  // where rounding shows most
    std::vector<Image> references;
    for (const Camera& camera : cameras) references.push_back(referenceOf(scene, camera));
    for (const EngineOptions& options : fastEngines()) {
        const auto engine = makeEngine(scene, options);
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            SCOPED_TRACE(options.engine + " " + options.context + ", camera " + std::to_string(i));
            FrameReport report;
            const auto difference = compareImages(engine->render(cameras[i], report), references[i]);
            EXPECT_LE(difference.rmse, rmse);
            EXPECT_LE(difference.max, max);
        }
    }
}

std::vector<std::string> caseNames() {
    std::vector<std::string> names;
    for (const auto& [name, set] : cases()) names.push_back(name);
    return names;
}

std::string caseName(const testing::TestParamInfo<std::tuple<std::string, Mode>>& suite) {
    const std::map<Mode, std::string> modes{
        {Mode::Standard, "Standard"}, {Mode::ScaleInvariant, "ScaleInvariant"}, {Mode::FirstHit, "FirstHit"}};
    return std::get<0>(suite.param) + modes.at(std::get<1>(suite.param));
}

INSTANTIATE_TEST_SUITE_P(All, LightCases,
                         testing::Combine(testing::ValuesIn(caseNames()),
                                          testing::Values(Mode::Standard, Mode::ScaleInvariant, Mode::FirstHit)),
                         caseName);

TEST(Light, FullModelOfPlainSettingsIsThePlainOne) {
    Scene plain = litScene(Mode::ScaleInvariant), full = plain;
    plain.settings.shading.lights = {directional({0.4, 0.8, 0.6}), directional({-1, 0.1, -2})};
    full.settings.shading = plain.settings.shading;
    full.settings.shading.material.front.exponent = full.settings.shading.exponent;  // the same, said twice
    ASSERT_TRUE(plain.settings.shading.plain());
    ASSERT_FALSE(full.settings.shading.plain());
    const Camera camera = cameraAt({2.1, 1.7, 2.4});
    for (const EngineOptions& options : fastEngines()) {
        FrameReport report;
        const Image a = makeEngine(plain, options)->render(camera, report);
        const Image b = makeEngine(full, options)->render(camera, report);
        EXPECT_LE(compareImages(a, b).max, 2e-4) << options.engine;  // float, and pow of another form
    }
}

TEST(Light, PointLightFarAwayIsDirectional) {
    Scene near = litScene(Mode::Standard), far = near;
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    near.settings.shading.lights = {directional(towards)};
    far.settings.shading.lights = {point(glm::dvec3(0.5) + 1e7 * towards)};
    const Camera camera = cameraAt({2.1, 1.7, 2.4});
    EXPECT_LE(compareImages(referenceOf(near, camera), referenceOf(far, camera)).max, 1e-5);
}

TEST(Light, AttenuationIsInMeshUnits) {
    // a slab seen from far away: the light stands 3 from where its middle is, and 1/(1 + 2·3 + 0.5·9) of it arrives
    Scene scene =
        sceneOf(boxMesh(2, [](const glm::dvec3& p) { return p.z; }, {-0.001, -0.001, 0}, {0.001, 0.001, 0.001}),
                constantFunction(4000.0));
    scene.settings.shading.ambient = 0;
    scene.settings.shading.lights = {point({0, 0, 3.0005})};
    const Camera camera = cameraAt({0, 0, 2}, {0, 0, 0}, 1, 1);
    const glm::vec4 whole = referenceOf(scene, camera).at(0, 0);
    scene.settings.shading.lights.front().attenuation = {1, 2, 0.5};
    const glm::vec4 attenuated = referenceOf(scene, camera).at(0, 0);
    ASSERT_GT(whole.x, 0.1f);
    EXPECT_NEAR(attenuated.x / whole.x, 1.0 / 11.5, 1e-4);
}

/// Transmittance at every vertex to the scene's first light.
std::vector<double> shadowsOf(const Scene& scene) {
    const auto light = vertexLightOf(scene);
    std::vector<double> shadows;
    for (std::size_t i = 0; i < scene.mesh->positions.size(); ++i)
        shadows.push_back(static_cast<double>(light->of(i)[light->shadowAt]));
    return shadows;
}

TEST(Shadows, OfASlabAreBeerLambert) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        // s = 2z: extinction 1.3 per length, or 0.65 per unit of s
        Scene scene = sceneOf(jitteredBoxMesh(6, 0.2, 8, [](const glm::dvec3& p) { return 2 * p.z; }),
                              constantFunction(mode == Mode::Standard ? 1.3 : 0.65), mode);
        scene.settings.shading.lights = {directional({0, 0, 1})};
        scene.settings.shading.shadows.on = true;
        const auto shadows = shadowsOf(scene);
        for (std::size_t i = 0; i < shadows.size(); ++i) {
            const glm::dvec3& p = scene.mesh->positions[i];
            EXPECT_NEAR(shadows[i], std::exp(-1.3 * (1 - p.z)), 1e-5) << p.x << " " << p.y << " " << p.z;
        }
    }
}

TEST(Shadows, OfIsosurfacesAndPointLights) {
    Scene scene = sceneOf(boxMesh(6, [](const glm::dvec3& p) { return p.z; }), constantFunction(0.0));
    scene.transferFunction.isosurfaces = {{0.55, 0.4, {1, 1, 1}}};
    scene.settings.shading.lights = {point({0.3, 0.4, 0.9})};
    scene.settings.shading.shadows.on = true;
    const auto shadows = shadowsOf(scene);
    for (std::size_t i = 0; i < shadows.size(); ++i)
        EXPECT_NEAR(shadows[i], scene.mesh->positions[i].z < 0.55 ? 0.6 : 1.0, 1e-6);
}

TEST(Shadows, AreWhatRaysOfTheReferenceFind) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        Scene scene = litScene(mode);
        const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.5, 0.7));
        scene.settings.shading.lights = {directional(towards)};
        scene.settings.shading.shadows.on = true;
        const auto shadows = shadowsOf(scene);
        scene.settings.shading = {};
        const ReferenceRayCaster caster(scene);
        for (std::size_t i = 0; i < shadows.size(); i += 7) {
            const glm::dvec3& p = scene.mesh->positions[i];
            if (std::min({p.x, p.y, p.z}) < 0.01 || std::max({p.x, p.y, p.z}) > 0.99) continue;
            const Camera camera = cameraAt(p, p + towards, 1, 1);
            const double alpha = static_cast<double>(referenceOf(scene, camera).at(0, 0).w);
            EXPECT_NEAR(shadows[i], 1 - alpha, 2e-5);
        }
    }
}

TEST(Shadows, OfAnAreaLightAreSofter) {
    // an opaque plate in the middle of clear space: behind its rim the hard shadow is all or nothing
    Scene scene =
        sceneOf(boxMesh(13, [](const glm::dvec3& p) { return p.z > 0.66 && p.z < 0.8 && p.x < 0.5 ? 1.0 : 0.0; }),
                constantFunction(0.0));
    scene.transferFunction.extinction = {{0.2, 0.0}, {0.5, 200.0}};
    scene.settings.shading.lights = {directional({0, 0, 1})};
    scene.settings.shading.shadows.on = true;
    const auto between = [](const std::vector<double>& values) {
        return std::count_if(values.begin(), values.end(), [](double t) { return t > 0.1 && t < 0.9; });
    };
    const auto hard = between(shadowsOf(scene));
    scene.settings.shading.shadows.softness = 0.3;
    EXPECT_GT(between(shadowsOf(scene)), 2 * hard + 20);
}

TEST(Light, SmoothNormalsOfALinearFieldAreThoseOfTheCells) {
    Scene scene = sceneOf(jitteredBoxMesh(6, 0.3, 5, [](const glm::dvec3& p) { return p.x + 2 * p.y - p.z; }),
                          smoothFunction(-1, 3, 8));
    scene.settings.shading.lights = {directional({0.2, 0.7, 0.6})};
    const Camera camera = cameraAt({2.1, 1.7, 2.4});
    const Image cells = referenceOf(scene, camera);
    scene.settings.shading.normals = shading::Normals::Smooth;
    EXPECT_LE(compareImages(cells, referenceOf(scene, camera)).max, 1e-5);
}

// Ament & Dachsbacher 2015, Figure 7: on the Marschner–Lobb signal a highlight that follows the field's fibres shows
// more structure than the same lobe at γ = 0. Ward's, whose norm dims it as it grows, only where it is bright (k_s =
// 16).
TEST(Light, AnisotropicLightShowsMoreStructureThanItsLobe) {
    Scene scene = sceneOf(sampledMesh(mesh::proceduralField("marschner-lobb", 41), 41), {}, Mode::Standard);
    scene.transferFunction.color = {{0.0, {0.75, 0.6, 0.45}}};
    const auto at = [&](double t) {
        return scene.mesh->scalarMin + t * (scene.mesh->scalarMax - scene.mesh->scalarMin);
    };
    scene.transferFunction.extinction = {{at(0.5), 0}, {at(0.53), 60}};
    Camera camera = cameraAt({2.6, 1.9, 4.2}, glm::dvec3(0), 128, 128);
    camera.up = {0, 0, 1};
    auto& shading = scene.settings.shading;
    shading.lights = {directional({1, 1, 2})};
    shading.transmission = false;
    shading.normals = shading::Normals::Smooth;
    shading.reflectance = shading::Reflectance::Ward;
    scene = withVertexLight(std::move(scene));  // the same for all that follow
    const auto draw = [&](shading::Reflectance reflectance, double kappa, double gamma) {
        shading.reflectance = reflectance;
        shading.anisotropy.kappa = kappa;
        shading.anisotropy.gamma = gamma;
        FrameReport report;
        return makeEngine(scene, {"cpu", "auto"})->render(camera, report);
    };
    const Image unlit = draw(shading::Reflectance::None, 1, 0);
    const auto rise = [&](shading::Reflectance reflectance, double kappa) {
        return structureScore(unlit, draw(reflectance, kappa, 10)) / structureScore(unlit, draw(reflectance, kappa, 0));
    };
    EXPECT_GT(rise(shading::Reflectance::Lafortune, 10), 1.4);
    EXPECT_GT(rise(shading::Reflectance::Lafortune, 30), 1.8);
    shading.material.specular = 16;
    EXPECT_GT(rise(shading::Reflectance::Ward, 0.05), 1.05);
}

}  // namespace
}  // namespace tetralux::projection
