// SPDX-License-Identifier: Apache-2.0
// The yardstick itself against closed forms and against a march through the mesh that shares nothing with it.
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/reference/reference_ray_caster.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

Image render(const Scene& scene, const Camera& camera) {
    RayCastCounts counts;
    return ReferenceRayCaster(scene).render(camera, counts);
}

/// Largest difference of alpha from `expected(ray)` over the image; float pixels carry 6e-8.
double worstAlpha(const Scene& scene, const Camera& camera, const std::function<double(const Ray&)>& expected) {
    const Image image = render(scene, camera);
    const CameraFrame frame = cameraFrame(camera);
    double worst = 0, strongest = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            worst = std::max(worst, std::abs(image.at(x, y).w - expected(pixelRay(frame, x, y))));
            strongest = std::max(strongest, static_cast<double>(image.at(x, y).w));
        }
    EXPECT_GT(strongest, 0.1) << "the picture is empty: nothing was tested";
    return worst;
}

double pathLength(const Ray& ray) {
    const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
    return std::max(0.0, out - in);
}

const glm::dvec3 outside{1.9, 1.4, 2.3};

TEST(Reference, ConstantExtinctionFollowsThePathLength) {
    const Scene scene = sceneOf(boxMesh(5, [](auto&) { return 0.7; }), constantFunction(1.5));
    auto expected = [](const Ray& ray) { return -std::expm1(-1.5 * pathLength(ray)); };
    EXPECT_LT(worstAlpha(scene, cameraAt(outside), expected), 1e-7);
    EXPECT_LT(worstAlpha(scene, cameraAt({0.4, 0.5, 0.45}, {0.9, 0.6, 0.7}), expected), 1e-7) << "eye inside";
}

TEST(Reference, ViewAlongTheGridsAxisLosesAndDoublesNothing) {
    // odd size: the middle column and row of rays lie exactly in faces, the central ray on vertices
    const Scene scene = sceneOf(boxMesh(5, [](auto&) { return 0.7; }), constantFunction(1.5));
    auto expected = [](const Ray& ray) { return -std::expm1(-1.5 * pathLength(ray)); };
    EXPECT_LT(worstAlpha(scene, cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 41, 41), expected), 1e-7);
    Camera parallel = cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 65, 65);
    parallel.orthographicHeight = 65.0 / 64.0 * 1.5;
    const Image image = render(scene, parallel);
    for (int y = 12; y < 53; ++y)
        for (int x = 12; x < 53; ++x) EXPECT_NEAR(image.at(x, y).w, -std::expm1(-1.5), 1e-7) << x << ' ' << y;
}

TEST(Reference, LinearFieldHasItsClosedForm) {
    // s = x, τ(s) = 3s: ∫τ dt along the ray is 3·(mean of x at entry and exit)·path
    preint::TransferFunction ramp = constantFunction(0);
    ramp.extinction = {{0.0, 0.0}, {1.0, 3.0}};
    const Scene scene = sceneOf(boxMesh(4, [](const glm::dvec3& p) { return p.x; }), ramp);
    EXPECT_LT(worstAlpha(scene, cameraAt(outside),
                         [](const Ray& ray) {
                             const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
                             if (out <= in) return 0.0;
                             const double x = ray.origin.x + ray.direction.x * 0.5 * (in + out);
                             return -std::expm1(-3.0 * x * (out - in));
                         }),
              1e-7);
}

TEST(Reference, ScaleInvariantDependsOnTheVariationOfTheScalarOnly) {
    auto variation = [](const Ray& ray) {
        const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
        return out > in ? std::abs(ray.direction.y) * (out - in) : 0.0;
    };
    const Scene scene =
        sceneOf(boxMesh(4, [](const glm::dvec3& p) { return p.y; }), constantFunction(2), Mode::ScaleInvariant);
    EXPECT_LT(worstAlpha(scene, cameraAt(outside), [&](const Ray& r) { return -std::expm1(-2 * variation(r)); }), 1e-7);
}

TEST(Reference, SilhouettesOfALinearFieldDoNotDependOnTheAngle) {
    // τ constant, g = (0, 1, 0): k·τ·|Δs| = τ·|g|·l per cell, and the cells' depths add up to τ·path
    Scene scene =
        sceneOf(boxMesh(4, [](const glm::dvec3& p) { return p.y; }), constantFunction(2), Mode::ScaleInvariant);
    scene.settings.shading.silhouette = true;
    EXPECT_LT(worstAlpha(scene, cameraAt(outside), [](const Ray& r) { return -std::expm1(-2 * pathLength(r)); }), 1e-7);
    // rays exactly along the isosurfaces: cosine 0, still finite
    EXPECT_LT(worstAlpha(scene, cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 41, 41),
                         [](const Ray& r) { return -std::expm1(-2 * pathLength(r)); }),
              1e-6);
}

TEST(Reference, LightOnALinearFieldIsThatOfOneSurface) {
    // one cell thick in the sense of light: thin extinction, so α ≈ depth and every cell gets the same light
    Scene scene =
        sceneOf(boxMesh(2, [](const glm::dvec3& p) { return p.z; }), constantFunction(1e-4, {0.5, 0.25, 1.0}));
    scene.settings.shading.lights = {{glm::normalize(glm::dvec3(0, 1, 1))}};
    scene.settings.shading.ambient = 0.2;
    scene.settings.shading.exponent = 8;
    const Camera camera = cameraAt({0.5, 0.5, 4}, glm::dvec3(0.5), 41, 41);
    const Image image = render(scene, camera);
    // n = +z, v = +z in the middle: reflection, (l·n) = √½, r·v = √½
    const double lambert = std::sqrt(0.5), specular = std::pow(std::sqrt(0.5), 8), alpha = image.at(20, 20).w;
    EXPECT_NEAR(image.at(20, 20).x, alpha * (0.2 * 0.5 + 0.5 * lambert + specular), 1e-4 * alpha);
    EXPECT_NEAR(image.at(20, 20).z, alpha * (0.2 * 1.0 + 1.0 * lambert + specular), 1e-4 * alpha);
    // light from behind is transmitted: |l·n| the same, the specular lobe is about −l = (0, −1, 1)/√2 and in the
    // material's colour; weight 1 − α ≈ 1
    scene.settings.shading.lights = {{glm::normalize(glm::dvec3(0, 1, -1))}};
    const Image behind = render(scene, camera);
    EXPECT_NEAR(behind.at(20, 20).x, alpha * 0.5 * (0.2 + lambert + specular), 1e-3 * alpha);
    scene.settings.shading.transmission = false;
    EXPECT_NEAR(render(scene, camera).at(20, 20).x, alpha * 0.2 * 0.5, 1e-4 * alpha);
}

TEST(Reference, OrderFreeModesHaveTheirClosedForms) {
    preint::TransferFunction gray = constantFunction(1);
    gray.color = {{0.0, glm::dvec3(0)}, {1.0, glm::dvec3(1)}};
    const Camera camera = cameraAt(outside);
    const CameraFrame frame = cameraFrame(camera);
    const auto field = [](const glm::dvec3& p) { return p.x; };
    const Image mip = render(sceneOf(boxMesh(4, field), gray, Mode::Mip), camera);
    const Image average = render(sceneOf(boxMesh(4, field), gray, Mode::Average), camera);
    const Image first = render(sceneOf(boxMesh(4, field), gray, Mode::FirstHit), camera);
    int hits = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const Ray ray = pixelRay(frame, x, y);
            const auto [in, out] = pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
            if (out - in < 1e-6) continue;
            ++hits;
            const double xIn = ray.origin.x + in * ray.direction.x, xOut = ray.origin.x + out * ray.direction.x;
            EXPECT_NEAR(mip.at(x, y).x, std::max(xIn, xOut), 1e-6);
            EXPECT_NEAR(average.at(x, y).x, 0.5 * (xIn + xOut), 1e-6);
            EXPECT_EQ(first.at(x, y).w, 1.0f);
            EXPECT_LT(first.at(x, y).x, xIn + 1e-6);       // the scalar falls along the ray,
            EXPECT_GT(first.at(x, y).x, xIn - 0.5 / 3.0);  // and the first cell is a third of the box
        }
    EXPECT_GT(hits, 100);
}

/// Scalar at a point by trying all cells; NaN outside.
double locate(const mesh::ScalarMesh& m, const glm::dvec3& p) {
    for (mesh::CellIndex c = 0; c < m.cells.size(); ++c) {
        const auto& q = m.cells[c];
        const double whole =
            mesh::sixVolumes(m.positions[q[0]], m.positions[q[1]], m.positions[q[2]], m.positions[q[3]]);
        double scalar = 0, least = 1;
        for (int k = 0; k < 4; ++k) {
            std::array<glm::dvec3, 4> v;
            for (std::size_t j = 0; j < 4; ++j) v[j] = static_cast<int>(j) == k ? p : m.positions[q[j]];
            const double weight = mesh::sixVolumes(v[0], v[1], v[2], v[3]) / whole;
            least = std::min(least, weight);
            scalar += weight * m.scalarAt(c, k);
        }
        if (least >= 0) return scalar;
    }
    return std::nan("");
}

TEST(Reference, AgreesWithAMarchThroughANonconvexMesh) {
    auto wave = [](const glm::dvec3& p) { return 0.5 + 0.5 * std::sin(5 * p.x + 3 * p.y) * std::cos(4 * p.z); };
    const mesh::ScalarMesh m = carved(jitteredBoxMesh(5, 0.2, 7, wave),
                                      [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(0.5)) > 0.3; });
    const Scene scene = sceneOf(m, smoothFunction(0, 1, 10));
    const Camera camera = cameraAt(outside, glm::dvec3(0.5), 9, 9);
    const Image image = render(scene, camera);
    const CameraFrame frame = cameraFrame(camera);
    constexpr int steps = 6000;
    int marched = 0;
    for (auto [x, y] : {std::pair{4, 4}, {3, 5}, {5, 3}, {2, 4}}) {
        const Ray ray = pixelRay(frame, x, y);
        const double from = 1.4, to = 3.6, step = (to - from) / steps;
        glm::dvec3 color(0);
        double transmittance = 1;
        for (int i = 0; i < steps; ++i) {
            const double s = locate(m, ray.origin + (from + (i + 0.5) * step) * ray.direction);
            if (std::isnan(s)) continue;
            const double alpha = -std::expm1(-scene.transferFunction.extinctionAt(s) * step);
            color += transmittance * alpha * scene.transferFunction.colorAt(s);
            transmittance *= 1 - alpha;
            ++marched;
        }
        // midpoint steps of 4e-4: their own error is some 1e-4 where the ray enters and leaves
        EXPECT_NEAR(image.at(x, y).w, 1 - transmittance, 1e-3);
        EXPECT_NEAR(image.at(x, y).x, color.x, 1e-3);
        EXPECT_NEAR(image.at(x, y).z, color.z, 1e-3);
    }
    EXPECT_GT(marched, 1000);
}

TEST(Reference, SomePixelsAreTheSameAsAllPixels) {
    const Scene scene = sceneOf(boxMesh(5, [](const glm::dvec3& p) { return p.x * p.y; }), smoothFunction(0, 1, 10));
    const Camera camera = cameraAt(outside);
    const ReferenceRayCaster caster(scene);
    RayCastCounts counts;
    const Image whole = caster.render(camera, counts);
    Image part(camera.width, camera.height);
    const std::vector<std::uint32_t> pixels{5, 480, 950, 951, 1300};
    caster.renderPixels(camera, pixels, part);
    for (std::uint32_t pixel : pixels) EXPECT_EQ(part.pixels[pixel], whole.pixels[pixel]);
    EXPECT_EQ(part.pixels[952], glm::vec4(0));
    EXPECT_EQ(counts.overlaps, 0u);
}

TEST(Reference, EveryRayCrossesEveryIsosurfaceOnce) {
    // s = distance along the view: an isosurface of opacity 0.4 in the middle covers the box whatever the mesh
    preint::TransferFunction isosurface = constantFunction(0);
    isosurface.isosurfaces = {{0.5, 0.4, {1, 0.5, 0}}};
    const Scene scene =
        sceneOf(boxMesh(5, [](const glm::dvec3& p) { return p.z; }), isosurface);  // 0.5 is a plane of vertices
    const Camera camera = cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 33, 33);
    const Image image = render(scene, camera);
    for (int y = 10; y < 23; ++y)
        for (int x = 10; x < 23; ++x) {
            EXPECT_NEAR(image.at(x, y).w, 0.4, 1e-7);
            EXPECT_NEAR(image.at(x, y).x, 0.4, 1e-7);
        }
}

}  // namespace
}  // namespace tetralux::projection
