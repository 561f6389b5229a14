// SPDX-License-Identifier: Apache-2.0
//
// What scale-invariant rendering promises (Kraus 2005): no dependence on size, isosurfaces of uniform opacity, N of
// them converging to the constant function, finite silhouettes.
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/io/read_mesh.h>
#include <preint/equidistant_isosurfaces.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

Scene fieldScene(const std::string& source, Mode mode) {
    auto read = mesh::readMesh(source);
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    return sceneOf(std::move(selected.mesh), constantFunction(1.0), mode);
}

Camera cameraOf(const Scene& scene, int size = 64) {
    Camera camera = cameraAt({0, 0, 0}, scene.mesh->bounds.centre(), size, size);
    camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
    return camera;
}

const std::vector<EngineOptions> everyEngine{{"reference", "auto"}, {"cpu", "auto"}, {"gl", "auto"}};

TEST(ScaleInvariance, AThousandfoldMeshGivesTheSamePicture) {
    Scene scene = fieldScene("hydrogen:11", Mode::ScaleInvariant);
    const double range = scene.mesh->scalarMax - scene.mesh->scalarMin;
    scene.transferFunction = smoothFunction(scene.mesh->scalarMin, scene.mesh->scalarMax, 8.0 / range);
    scene.transferFunction.isosurfaces = {{scene.mesh->scalarMin + 0.4 * range, 0.5, {1, 0, 0}}};
    Camera camera = cameraOf(scene);
    Scene large = scene;
    mesh::ScalarMesh scaled = *scene.mesh;
    for (glm::dvec3& p : scaled.positions) p *= 1000.0;
    large.mesh = std::make_shared<const mesh::ScalarMesh>(finished(std::move(scaled)));
    Camera far = camera;
    far.eye *= 1000.0;
    far.target *= 1000.0;
    for (const bool silhouette : {false, true})
        for (const auto& options : everyEngine) {
            scene.settings.shading.silhouette = large.settings.shading.silhouette = silhouette;
            const Image a = pictureOf(scene, camera, options), b = pictureOf(large, far, options);
            EXPECT_LE(compareImages(a, b).max, 1e-5) << options.engine << silhouette;
        }
    // which is not so of the standard integral
    scene.settings.mode = large.settings.mode = Mode::Standard;
    EXPECT_GT(compareImages(pictureOf(scene, camera, everyEngine[0]), pictureOf(large, far, everyEngine[0])).max, 0.1);
}

/// Pixels whose ray, and those of all neighbours, cross the value exactly twice.
std::vector<std::size_t> pixelsThatCrossTwice(Scene scene, const Camera& camera, double value) {
    scene.transferFunction.extinction = {{0.0, 0.0}};
    scene.transferFunction.isosurfaces = {{value, 0.5, {1, 1, 1}}};
    const Image image = pictureOf(scene, camera, everyEngine[0]);
    std::vector<std::size_t> pixels;
    for (int y = 1; y + 1 < camera.height; ++y)
        for (int x = 1; x + 1 < camera.width; ++x) {
            bool twice = true;
            for (int i = -1; i <= 1; ++i)
                for (int j = -1; j <= 1; ++j) twice = twice && std::abs(image.at(x + i, y + j).w - 0.75f) < 1e-6f;
            if (twice) pixels.push_back(static_cast<std::size_t>(y * camera.width + x));
        }
    return pixels;
}

// A surface of some thickness in data space, drawn about three charges: the field is steep near some parts of it and
// flat near others.
TEST(ScaleInvariance, IsosurfacesOfThreeCoulombPotentialsAreUniform) {
    Scene scene = fieldScene("coulomb:24", Mode::ScaleInvariant);
    const Camera camera = cameraOf(scene, 96);
    const double low = scene.mesh->scalarMin, range = scene.mesh->scalarMax - low;
    const double value = low + 0.35 * range, half = 0.01 * range;
    // both edges of the layer crossed twice, and not only near the middle: then the whole layer is
    std::vector<std::size_t> pixels = pixelsThatCrossTwice(scene, camera, value + half);
    const std::vector<std::size_t> outer = pixelsThatCrossTwice(scene, camera, value - half);
    std::erase_if(pixels, [&](std::size_t p) { return !std::binary_search(outer.begin(), outer.end(), p); });
    ASSERT_GT(pixels.size(), 100u);
    scene.transferFunction = constantFunction(0.0);
    const double tau = std::log(2.0) / (2 * half);  // opacity 1/2 of one layer
    scene.transferFunction.extinction = {
        {value - half, 0}, {value - half, tau}, {value + half, tau}, {value + half, 0}};
    const auto spread = [&](const EngineOptions& options) {
        const Image image = pictureOf(scene, camera, options);
        float least = 1, most = 0;
        for (std::size_t p : pixels) {
            least = std::min(least, image.pixels[p].w);
            most = std::max(most, image.pixels[p].w);
        }
        return std::pair(least, most);
    };
    for (const auto& options : everyEngine) {
        const auto [least, most] = spread(options);
        EXPECT_NEAR(least, 0.75f, 1e-4) << options.engine;
        EXPECT_NEAR(most, 0.75f, 1e-4) << options.engine;
    }
    scene.settings.mode = Mode::Standard;
    scene.transferFunction.extinction = {{value - half, 0}, {value - half, 20}, {value + half, 20}, {value + half, 0}};
    const auto [least, most] = spread(everyEngine[0]);
    EXPECT_GT(most - least, 0.2f * most);
}

TEST(EquidistantIsosurfaces, ConvergeToTheFunctionAsOneOverN) {
    Scene scene = fieldScene("bucky:12", Mode::ScaleInvariant);
    const double low = scene.mesh->scalarMin, high = scene.mesh->scalarMax;
    scene.transferFunction = constantFunction(1.5 / (high - low));
    const Camera camera = cameraOf(scene);
    const Image limit = pictureOf(scene, camera, everyEngine[0]);
    const preint::TransferFunction constant = scene.transferFunction;
    std::vector<double> errors;
    for (int count : {32, 64, 128, 256, 512, 1024}) {
        scene.transferFunction = preint::equidistantIsosurfaces(constant, count, low, high);
        ASSERT_EQ(scene.transferFunction.isosurfaces.size(), static_cast<std::size_t>(count));
        errors.push_back(compareImages(pictureOf(scene, camera, everyEngine[1]), limit).rmse);
    }
    // single steps scatter, since it is chance how many surfaces a rise of the scalar meets
    for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i] / errors[i - 1], 0.75) << i;
    const double order = std::log2(errors.front() / errors.back()) / 5.0;
    EXPECT_NEAR(order, 1.0, 0.12);
    EXPECT_LT(errors.back(), 5e-3);
}

TEST(EquidistantIsosurfaces, HaveTheDepthOfTheirSteps) {
    const auto function = preint::equidistantIsosurfaces(smoothFunction(0, 1, 10.0), 5, 0, 1);
    ASSERT_EQ(function.isosurfaces.size(), 5u);
    for (int i = 0; i < 5; ++i) {
        const auto& surface = function.isosurfaces[static_cast<std::size_t>(i)];
        EXPECT_NEAR(surface.value, 0.1 + 0.2 * i, 1e-12);
        EXPECT_NEAR(surface.opacity, -std::expm1(-0.2 * smoothFunction(0, 1, 10.0).extinctionAt(surface.value)), 1e-12);
    }
    EXPECT_EQ(function.extinctionAt(0.5), 0.0);
}

// Rays that run exactly within the isosurfaces of a plane field: k is infinite.
TEST(Silhouettes, GrazingRaysAreFinite) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const bool surfaces : {false, true})
            for (const bool approximate : {false, true}) {
                Scene scene = sceneOf(boxMesh(5, [](const glm::dvec3& p) { return p.z; }), constantFunction(3.0), mode);
                if (surfaces) scene.transferFunction.isosurfaces = {{0.5, 0.6, {1, 0, 0}}, {0.25, 1.0, {0, 1, 0}}};
                scene.settings.shading.silhouette = true;
                scene.settings.shading.approximateSilhouette = approximate;
                scene.settings.shading.lights.push_back({glm::dvec3(0, 0.6, 0.8)});
                for (const bool parallel : {true, false}) {
                    Camera camera = cameraAt({3.0, 0.5, 0.5}, glm::dvec3(0.5), 33, 33);
                    if (parallel) camera.orthographicHeight = 33.0 / 32.0 * 1.25;
                    for (const auto& options : everyEngine)
                        for (const glm::vec4& pixel : pictureOf(scene, camera, options).pixels)
                            for (int channel = 0; channel < 4; ++channel) {
                                ASSERT_TRUE(std::isfinite(pixel[channel])) << options.engine;
                                ASSERT_GE(pixel[channel], 0.0f);
                                ASSERT_LE(pixel[channel], channel == 3 ? 1.0f : 3.0f);
                            }
                }
            }
}

// Equation 16 by hand on one layer: α' = min(1, α·k).
TEST(Silhouettes, ApproximateIsOpacityTimesK) {
    Scene scene =
        sceneOf(boxMesh(2, [](const glm::dvec3& p) { return p.z; }), constantFunction(0.0), Mode::ScaleInvariant);
    scene.transferFunction.isosurfaces = {{0.5, 0.3, {1, 0, 0}}};
    scene.settings.shading.silhouette = true;
    scene.settings.shading.approximateSilhouette = true;
    const Camera camera = cameraAt({0.5, -2.0, 2.0});
    const CameraFrame frame = cameraFrame(camera);
    const Image image = pictureOf(scene, camera, everyEngine[0]);
    int met = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const Ray ray = pixelRay(frame, x, y);
            const glm::dvec3 hit = ray.origin + (0.5 - ray.origin.z) / ray.direction.z * ray.direction;
            if (hit.x < 0.01 || hit.x > 0.99 || hit.y < 0.01 || hit.y > 0.99) continue;
            ++met;
            EXPECT_NEAR(image.at(x, y).w, std::min(1.0, 0.3 / std::abs(ray.direction.z)), 1e-6);
        }
    EXPECT_GT(met, 100);
}

// Equation 11 under Equations 15 and 16: the opacity that is enhanced is min(1, τ·P), 1 − exp(−τ·P) in no case.
TEST(Silhouettes, OfLinearSamplesEnhanceTheirOpacity) {
    Scene scene = sceneOf(unitTetrahedron({0.0, 1.0, 0.3, 0.7}), smoothFunction(0, 1, 1.5));
    const Camera camera = cameraAt({1.3, 1.1, 1.6}, glm::dvec3(0.25), 21, 19);
    const glm::dvec3 gradient(1.0, 0.3, 0.7);
    scene.settings.classification = Classification::PostLinear;
    scene.settings.shading.silhouette = true;
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const bool approximate : {false, true})
            for (const auto& options : everyEngine) {
                scene.settings.mode = mode;
                scene.settings.shading.approximateSilhouette = approximate;
                const Image image = pictureOf(scene, camera, options);
                const ReferenceRayCaster caster(scene);
                int met = 0;
                for (int y = 0; y < camera.height; ++y)
                    for (int x = 0; x < camera.width; ++x) {
                        const auto segments = caster.segmentsAt(camera, x, y);
                        if (segments.empty()) continue;
                        ++met;
                        const auto& s = segments.front();
                        const double tau = scene.transferFunction.extinctionAt(0.5 * (s.scalarIn + s.scalarOut));
                        const double rise = std::abs(s.scalarOut - s.scalarIn), length = s.tOut - s.tIn;
                        const double alpha = std::min(1.0, tau * (mode == Mode::Standard ? length : rise));
                        const double k = glm::length(gradient) * length / rise;
                        const double wanted = approximate ? std::min(1.0, alpha * k) : 1.0 - std::pow(1.0 - alpha, k);
                        ASSERT_NEAR(image.at(x, y).w, wanted, 1e-5) << options.engine << approximate;
                    }
                EXPECT_GT(met, 50);
            }
}

// Equation 18 on a plane field: depth times |g|, which is 1 range per diagonal here but for the diagonal's √3.
TEST(GradientOpacity, MultipliesDepthByTheMagnitude) {
    Scene scene = sceneOf(boxMesh(3, [](const glm::dvec3& p) { return p.z; }), constantFunction(0.7));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    scene.settings.shading.gradientOpacity = 0.5;
    const Image scaled = pictureOf(scene, camera, everyEngine[0]);
    scene.settings.shading.gradientOpacity = 0;
    scene.transferFunction = constantFunction(0.7 * 0.5 * std::sqrt(3.0));
    EXPECT_LE(compareImages(scaled, pictureOf(scene, camera, everyEngine[0])).max, 1e-6);
}

// Equations 10 and 11 on one cell: one sample in the middle.
TEST(Classification, SamplesTheMiddle) {
    Scene scene = sceneOf(unitTetrahedron({0.0, 1.0, 0.3, 0.7}), smoothFunction(0, 1, 4.0));
    const Camera camera = cameraAt({1.3, 1.1, 1.6}, glm::dvec3(0.25), 21, 19);
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const Classification classification :
             {Classification::Post, Classification::PostLinear, Classification::Pre}) {
            scene.settings.mode = mode;
            scene.settings.classification = classification;
            const Image image = pictureOf(scene, camera, everyEngine[0]);
            const ReferenceRayCaster caster(scene);
            int met = 0;
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    const auto segments = caster.segmentsAt(camera, x, y);
                    if (segments.empty()) continue;
                    ++met;
                    const auto& s = segments.front();
                    const Ray ray = pixelRay(cameraFrame(camera), x, y);
                    const glm::dvec3 p = ray.origin + 0.5 * (s.tIn + s.tOut) * ray.direction;
                    const double middle = 0.5 * (s.scalarIn + s.scalarOut);
                    double tau = scene.transferFunction.extinctionAt(middle);
                    glm::dvec3 color = scene.transferFunction.colorAt(middle);
                    if (classification == Classification::Pre) {
                        const double weights[4] = {1 - p.x - p.y - p.z, p.x, p.y, p.z};
                        const double scalars[4] = {0.0, 1.0, 0.3, 0.7};
                        tau = 0;
                        color = glm::dvec3(0);
                        for (int k = 0; k < 4; ++k) {
                            tau += weights[k] * scene.transferFunction.extinctionAt(scalars[k]);
                            color += weights[k] * scene.transferFunction.colorAt(scalars[k]);
                        }
                    }
                    const double path = mode == Mode::Standard ? s.tOut - s.tIn : std::abs(s.scalarOut - s.scalarIn);
                    const double alpha = classification == Classification::PostLinear ? std::min(1.0, tau * path)
                                                                                      : -std::expm1(-tau * path);
                    ASSERT_NEAR(image.at(x, y).w, alpha, 1e-6);
                    ASSERT_NEAR(image.at(x, y).x, alpha * color.x, 1e-6);
                }
            EXPECT_GT(met, 50);
        }
}

}  // namespace
}  // namespace tetralux::projection
