// SPDX-License-Identifier: Apache-2.0
//
// Slices that let part of the volume behind them through, colours that tell the distance, shadows of opaque surfaces:
// closed forms in every engine, and every engine against the reference.
#include <projection/frame/translucent_slices.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/io/read_mesh.h>
#include <preint/exact_integral.h>
#include <projection/core/clip_region.h>
#include <projection/light/light_frame.h>
#include <projection/opaque/opaque_layer.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// Tables of the default error, no edge but the slices' own rims, which the closed form leaves out.
constexpr double closedFormTolerance = 1e-4;
// Rims of slices and surfaces may fall into a neighbouring pixel.
constexpr EngineThreshold edged{2e-3, 0.6};
constexpr EngineThreshold smooth{1e-4, 2e-3};

const std::vector<EngineOptions> everyEngine{{"reference", "auto"}, {"cpu", "auto"}, {"gl", "auto"}};

double linear(const glm::dvec3& x) {
    return 0.2 + 0.5 * x.x + 0.25 * x.y - 0.125 * x.z;
}

preint::TransferFunction hybridFunction() {
    preint::TransferFunction function = smoothFunction(0.0, 1.0, 4.0);
    function.isosurfaces = {{0.4, 0.5, {0.2, 0.9, 0.9}}};
    return function;
}

Scene withSlices(Scene scene, std::vector<Slice> slices) {
    OpaqueObjects objects;
    objects.slices = std::move(slices);
    scene.mapSources.push_back(std::make_shared<const OpaqueLayer>(scene, objects));
    return scene;
}

/// The ray through a unit cube of a linear field with slices, in closed form.
glm::dvec4 expectedPixel(const Scene& scene, const std::vector<Slice>& slices, const Ray& ray, bool& edge) {
    const preint::ExactIntegral exact(scene.transferFunction);
    const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
    struct Stop {
        double t;
        const Slice* slice;
    };
    std::vector<Stop> stops;
    for (const Slice& slice : slices) {
        const double t = glm::dot(slice.point - ray.origin, slice.normal) / glm::dot(ray.direction, slice.normal);
        edge = edge || std::min(std::abs(t - in), std::abs(t - out)) < 0.03;
        if (t > in && t < out) stops.push_back({t, &slice});
    }
    std::sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.t < b.t; });
    stops.push_back({out, nullptr});
    glm::dvec4 pixel(0);
    double begin = in;
    for (const auto& [t, slice] : stops) {
        if (!(t > begin)) break;
        const auto part =
            exact.segment(linear(ray.origin + begin * ray.direction), linear(ray.origin + t * ray.direction), t - begin,
                          integralOf(scene.settings.mode));
        pixel += (1.0 - pixel.w) * glm::dvec4(part.color, part.opacity());
        if (slice != nullptr) {
            const glm::dvec3 color = scene.transferFunction.colorAt(linear(ray.origin + t * ray.direction));
            pixel += (1.0 - pixel.w) * slice->opacity * glm::dvec4(color, 1.0);
        }
        begin = t;
    }
    return pixel;
}

TEST(TranslucentSlices, SlicesOfSomeOpacityInClosedForm) {
    const std::vector<Slice> slices{{{0.5, 0.5, 0.45}, {0.2, -0.1, 1}, 0.5},
                                    {{0.5, 0.4, 0.5}, {0, 1, 0.2}, 0.25},
                                    {{0.3, 0.5, 0.5}, {1, 0, 0}, 1.0}};
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const bool parallel : {false, true}) {
            const Scene scene = withSlices(sceneOf(jitteredBoxMesh(7, 0.2, 5, linear), hybridFunction(), mode), slices);
            Camera camera = cameraAt({2.1, 1.7, 2.6});
            if (parallel) camera.orthographicHeight = 1.6;
            const CameraFrame frame = cameraFrame(camera);
            for (const EngineOptions& options : everyEngine) {
                const Image image = pictureOf(scene, camera, options);
                double worst = 0;
                int compared = 0;
                for (int y = 0; y < camera.height; ++y)
                    for (int x = 0; x < camera.width; ++x) {
                        const Ray ray = pixelRay(frame, x, y);
                        const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
                        bool edge = out < in + 0.05;
                        const glm::dvec4 expected = edge ? glm::dvec4(0) : expectedPixel(scene, slices, ray, edge);
                        if (edge) continue;
                        ++compared;
                        for (int c = 0; c < 4; ++c)
                            worst = std::max(worst, std::abs(expected[c] - static_cast<double>(image.at(x, y)[c])));
                    }
                std::printf("%s max %.1e of %d\n", options.engine.c_str(), worst, compared);
                EXPECT_LE(worst, closedFormTolerance) << options.engine;
                EXPECT_GT(compared, 300);
            }
        }
}

Scene litBall(Mode mode) {
    auto read = mesh::readMesh("bucky:12");
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    const double low = selected.mesh.scalarMin, high = selected.mesh.scalarMax;
    const double extent = mode == Mode::ScaleInvariant ? high - low : 1.0;
    Scene scene = sceneOf(std::move(selected.mesh), smoothFunction(low, high, 12.0 / extent), mode);
    scene.settings.shading.lights = {{glm::normalize(glm::dvec3(0.4, 0.8, 0.6))}};
    return scene;
}

const Camera ballCamera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 80, 64);

TEST(TranslucentSlices, IsTheSameInEveryEngine) {
    const std::vector<Slice> slices{{{0.5, 0.5, 0.5}, {0.3, -0.2, 1}, 0.4}, {{0.5, 0.5, 0.3}, {0, 1, 0.1}, 0.7}};
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::FirstHit, Mode::Absorption}) {
        Scene scene = litBall(mode);
        scene.settings.shading.silhouette = true;
        // what is first seen must be more than a breath for engines to agree on it
        if (mode == Mode::FirstHit) scene.transferFunction.extinction = {{0.3, 0.0}, {0.3, 1.0}};
        scene.mapSources.push_back(
            std::make_shared<const ClipRegion>(std::vector<HalfSpace>{{{0.5, 0.5, 0.7}, {0.1, 0.2, -1}}}, 0.01));
        expectEnginesAgree(withSlices(scene, slices), ballCamera, edged,
                           "translucent " + std::to_string(static_cast<int>(mode)), mode == Mode::Standard);
    }
    Scene adaptive = litBall(Mode::Standard);
    adaptive.settings.adaptive = AdaptiveSettings{};
    expectEnginesAgree(withSlices(adaptive, slices), ballCamera, edged, "adaptive");
}

TEST(TranslucentSlices, ClearSlicesDoNotShow) {
    for (const EngineOptions& options : everyEngine) {
        Scene plain = litBall(Mode::ScaleInvariant);
        plain.settings.shading = {};
        const Scene sliced = withSlices(plain, {{{0.5, 0.5, 0.5}, {0.3, -0.2, 1}, 0.0}});
        // parts of a segment in its place: exact but for tables
        EXPECT_LE(compareImages(pictureOf(plain, ballCamera, options), pictureOf(sliced, ballCamera, options)).max,
                  1e-4)
            << options.engine;
    }
}

TEST(TranslucentSlices, ModesThatComposeNoPartsAreRefused) {
    EXPECT_THROW(withSlices(litBall(Mode::Mip), {{{0.5, 0.5, 0.5}, {0, 0, 1}, 0.5}}), std::runtime_error);
    EXPECT_THROW(withSlices(litBall(Mode::Standard), {{{0.5, 0.5, 0.5}, {0, 0, 1}, 1.5}}), std::runtime_error);
    EXPECT_NO_THROW(withSlices(litBall(Mode::Mip), {{{0.5, 0.5, 0.5}, {0, 0, 1}, 1.0}}));
}

TEST(TranslucentSlices, FragmentsInNoOrderOrOutsideAreRefused) {
    const auto check = [](std::vector<TranslucentFragment> translucent) {
        PixelMaps maps;
        maps.translucent = std::move(translucent);
        checkPixelMaps({cameraAt({2, 2, 2}, glm::dvec3(0.5), 4, 3), &maps});
    };
    EXPECT_NO_THROW(check({{3, 1.0, {}}, {3, 2.0, {}}, {11, 0.5, {}}}));
    EXPECT_THROW(check({{3, 2.0, {}}, {3, 1.0, {}}}), std::runtime_error);
    EXPECT_THROW(check({{4, 1.0, {}}, {3, 2.0, {}}}), std::runtime_error);
    EXPECT_THROW(check({{12, 1.0, {}}}), std::runtime_error);
}

TEST(DepthColor, IsTheIntegralOverTheDistance) {
    const double tau = 2.0;
    const glm::dvec3 near{0.8, 0.5, 0.25};
    Scene scene = sceneOf(boxMesh(25, linear), constantFunction(tau, near));
    scene.settings.shading.depthColor = shading::DepthColor{{0.1, 0.2, 0.9}, 0.8};
    for (const bool parallel : {false, true}) {
        Camera camera = cameraAt({0.52, 0.47, 2.5}, {0.52, 0.47, 0.5}, 9, 9);
        if (parallel) camera.orthographicHeight = 0.5;
        const DepthRange range = depthRange(scene.mesh->bounds, camera);
        const Ray ray = pixelRay(cameraFrame(camera), 4, 4);
        const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
        glm::dvec3 expected(0);
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double t = in + (out - in) * (i + 0.5) / steps, share = 0.8 * range.shareAt(t);
            expected += (out - in) / steps * tau * std::exp(-tau * (t - in)) *
                        ((1 - share) * near + share * glm::dvec3(0.1, 0.2, 0.9));
        }
        for (const EngineOptions& options : everyEngine) {
            const glm::vec4 pixel = pictureOf(scene, camera, options).at(4, 4);
            // a segment has the share of its middle: of a length l it errs by τ·l²/12 of what the share changes per
            // length
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1e-4) << options.engine << parallel;
        }
    }
}

TEST(DepthColor, IsTheSameInEveryEngine) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::Additive, Mode::FirstHit})
        for (const bool lit : {false, true}) {
            Scene scene = litBall(mode);
            if (!lit) scene.settings.shading.lights.clear();
            scene.settings.shading.depthColor = shading::DepthColor{};
            if (mode == Mode::FirstHit) scene.transferFunction.extinction = {{0.3, 0.0}, {0.3, 1.0}};
            Camera camera = ballCamera;
            if (lit) camera.orthographicHeight = 1.6;
            expectEnginesAgree(scene, camera, mode == Mode::FirstHit || lit ? edged : smooth,
                               "depth colour " + std::to_string(static_cast<int>(mode)));
        }
}

/// The square 0.2 ≤ x, y ≤ 0.7 at z = 0.8.
std::shared_ptr<const mesh::SurfaceMesh> plate() {
    auto plate = std::make_shared<mesh::SurfaceMesh>();
    plate->positions = {{0.2, 0.2, 0.8}, {0.7, 0.2, 0.8}, {0.7, 0.7, 0.8}, {0.2, 0.7, 0.8}};
    plate->triangles = {{0, 1, 2}, {0, 2, 3}};
    return plate;
}

Scene platedScene(double extinction) {
    Scene scene = sceneOf(jitteredBoxMesh(9, 0.2, 4, linear), constantFunction(extinction));
    scene.settings.shading.lights = {{glm::dvec3(0, 0, 1)}};
    scene.settings.shading.shadows.on = true;
    scene.shadowCasters = {plate()};
    return scene;
}

TEST(SurfaceShadows, FallOnTheVolume) {
    const Scene scene = platedScene(1.3);
    const auto light = vertexLightOf(scene);
    int dark = 0;
    for (std::size_t i = 0; i < scene.mesh->positions.size(); ++i) {
        const glm::dvec3& p = scene.mesh->positions[i];
        const double beside = std::max({0.2 - p.x, 0.2 - p.y, p.x - 0.7, p.y - 0.7});
        if (std::abs(beside) < 1e-5 || std::max(p.x, p.y) > 1 - 1e-6) continue;  // rims
        const bool hidden = beside < 0 && p.z < 0.8 - 1e-5;
        dark += hidden ? 1 : 0;
        EXPECT_NEAR(light->of(i)[light->shadowAt], hidden ? 0.0 : std::exp(-1.3 * (1 - p.z)),
                    2e-6);  // rays begin some 1e-6 off the vertex
    }
    EXPECT_GT(dark, 50);
}

TEST(SurfaceShadows, FallOnSlicesAndSurfacesAndAreTheSameInEveryEngine) {
    Scene scene = platedScene(0.0);
    scene.settings.shading.ambient = 0.25;
    const auto colorAt = [&](const OpaqueObjects& objects, double x) {
        PixelMaps maps;
        OpaqueLayer(scene, objects).apply(cameraAt({x, 0.45, 0.75}, {x, 0.45, 0.1}, 9, 9), maps);
        return glm::dvec3(maps.behind[4 * 9 + 4]);
    };
    const OpaqueObjects slice{{{{0.5, 0.5, 0.4}, {0, 0, 1}}}, {}};
    const glm::dvec3 color = scene.transferFunction.colorAt(0.5);
    EXPECT_NEAR(colorAt(slice, 0.45).x, 0.25 * color.x, 1e-6);
    EXPECT_NEAR(colorAt(slice, 0.85).x, color.x, 1e-6);
    OpaqueSurface floor;
    auto square = std::make_shared<mesh::SurfaceMesh>(*plate());
    for (glm::dvec3& p : square->positions) p = {1.3 * (p.x - 0.05), p.y, 0.3};
    floor.mesh = square;
    floor.color = {1, 1, 1};
    const OpaqueObjects surface{{}, {floor}};
    EXPECT_NEAR(colorAt(surface, 0.45).x, 0.25, 1e-6);
    EXPECT_NEAR(colorAt(surface, 0.8).x, 1.0, 1e-6);
    scene.shadowCasters.push_back(square);  // does not shade itself
    EXPECT_NEAR(colorAt(surface, 0.8).x, 1.0, 1e-6);

    Scene ball = litBall(Mode::Standard);
    ball.settings.shading.shadows.on = true;
    ball.shadowCasters = {plate()};
    OpaqueSurface shown;
    shown.mesh = plate();
    ball.mapSources.push_back(std::make_shared<const OpaqueLayer>(ball, OpaqueObjects{{}, {shown}}));
    expectEnginesAgree(ball, ballCamera, edged, "surface shadows", true);
}

}  // namespace
}  // namespace tetralux::projection
