// SPDX-License-Identifier: Apache-2.0
//
// The boundary of a cube whose scalar is linear: what a ray meets first is known in closed form.
#include <projection/opaque/boundary_surface.h>

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/frame/engine_registry.h>
#include <projection/light/corner_normals.h>
#include <projection/opaque/opaque_layer.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

double linear(const glm::dvec3& x) {
    return 0.2 + 0.5 * x.x + 0.25 * x.y - 0.125 * x.z;
}

preint::TransferFunction grey() {
    preint::TransferFunction function;
    function.color = {{0.0, {0, 0, 0}}, {1.0, {1, 1, 1}}};
    function.extinction = {{0.0, 3.0}};
    return function;
}

Scene cubeWith(const BoundaryLook& look, const std::vector<HalfSpace>& clips = {}) {
    Scene scene = test::sceneOf(test::jitteredBoxMesh(7, 0.16, 5, linear), grey());
    if (!clips.empty()) scene.mapSources.push_back(std::make_shared<const ClipRegion>(clips, 0.01));
    OpaqueObjects objects;
    objects.surfaces = boundarySurfaces(*scene.mesh, clips, look);
    scene.mapSources.push_back(std::make_shared<const OpaqueLayer>(scene, objects));
    return scene;
}

Image pictureOf(const Scene& scene, const Camera& camera, const std::string& engine = "reference") {
    FrameReport report;
    EngineOptions options;
    options.engine = engine;
    return makeEngine(scene, options)->render(camera, report);
}

/// Calls check(pixel, ray, in, out) for pixels well within the cube's outline.
template <class Check>
int forEachInside(const Camera& camera, const glm::dvec3& low, const glm::dvec3& high, const Image& image,
                  const Check& check) {
    const CameraFrame frame = cameraFrame(camera);
    int count = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const Ray ray = pixelRay(frame, x, y);
            const auto [in, out] = test::pathInBox(ray, low, high);
            if (!(out - in > 0.05)) continue;
            ++count;
            check(image.at(x, y), ray, in, out);
        }
    return count;
}

TEST(BoundarySurface, HidesTheVolumeAndHasTheFieldsColours) {
    BoundaryLook look;
    look.flat = true;
    const Camera camera = test::cameraAt({2.1, 1.7, 2.6});
    for (const std::string& engine : engineNames()) {
        const Image image = pictureOf(cubeWith(look), camera, engine);
        const int count = forEachInside(camera, glm::dvec3(0), glm::dvec3(1), image,
                                        [&](const glm::vec4& pixel, const Ray& ray, double in, double) {
                                            EXPECT_NEAR(pixel.x, linear(ray.origin + in * ray.direction), 1e-5)
                                                << engine;
                                            EXPECT_EQ(pixel.w, 1.0f);
                                        });
        EXPECT_GT(count, 300);
    }
}

TEST(BoundarySurface, IsLitByItsOwnFaces) {
    const BoundaryLook look;
    Camera camera = test::cameraAt({0.5, 0.5, 4}, {0.5, 0.5, 0.5});
    camera.orthographicHeight = 1.5;
    const Image straight = pictureOf(cubeWith(look), camera);  // a head light falls on the face straight on
    forEachInside(camera, glm::dvec3(0), glm::dvec3(1), straight,
                  [](const glm::vec4& pixel, const Ray& ray, double in, double) {
                      EXPECT_NEAR(pixel.x, linear(ray.origin + in * ray.direction), 1e-5);
                  });
    Scene lit = cubeWith(look);
    shading::Light light;
    light.towards = glm::normalize(glm::dvec3(0, 3, 4));
    lit = test::sceneOf(test::jitteredBoxMesh(7, 0.16, 5, linear), grey());
    lit.settings.shading.lights = {light};
    lit.settings.shading.ambient = 0.0;
    OpaqueObjects objects;
    objects.surfaces = boundarySurfaces(*lit.mesh, {}, look);
    lit.mapSources.push_back(std::make_shared<const OpaqueLayer>(lit, objects));
    forEachInside(camera, glm::dvec3(0), glm::dvec3(1), pictureOf(lit, camera),
                  [](const glm::vec4& pixel, const Ray& ray, double in, double) {
                      EXPECT_NEAR(pixel.x, 0.8 * linear(ray.origin + in * ray.direction), 1e-5) << "the cosine";
                  });
}

TEST(BoundarySurface, CutsAreClosed) {
    BoundaryLook look;
    look.flat = true;
    const std::vector<HalfSpace> clips{{{0.5, 0.5, 0.6}, {0, 0, -1}}, {{0.7, 0, 0}, {-1, 0, 0}}};
    const Camera camera = test::cameraAt({2.1, 1.7, 2.6});
    for (const std::string& engine : engineNames()) {
        const int count = forEachInside(
            camera, glm::dvec3(0), glm::dvec3(0.7, 1, 0.6), pictureOf(cubeWith(look, clips), camera, engine),
            [&](const glm::vec4& pixel, const Ray& ray, double in, double) {
                EXPECT_NEAR(pixel.x, linear(ray.origin + in * ray.direction), 1e-5) << engine;
                EXPECT_EQ(pixel.w, 1.0f);
            });
        EXPECT_GT(count, 150);
    }
}

TEST(BoundarySurface, OpacityLetsTheVolumeThrough) {
    BoundaryLook look;
    look.flat = true;
    look.opacity = 0.25;
    look.color = glm::dvec3(0, 0, 1);
    const Camera camera = test::cameraAt({2.1, 1.7, 2.6});
    for (const std::string& engine : engineNames()) {
        forEachInside(camera, glm::dvec3(0), glm::dvec3(1), pictureOf(cubeWith(look), camera, engine),
                      [&](const glm::vec4& pixel, const Ray&, double in, double out) {  // front, volume, back
                          EXPECT_NEAR(pixel.w, 1.0 - 0.75 * 0.75 * std::exp(-3.0 * (out - in)),
                                      engine == "reference" ? 2e-7 : 5e-6)
                              << engine;
                      });
    }
}

TEST(BoundarySurface, EdgesAreAsWideAsTheySay) {
    BoundaryLook look;
    look.flat = true;
    look.color = glm::dvec3(1);
    look.edges = SurfaceEdges{3.0, {0, 0, 0}};
    Scene scene = test::sceneOf(test::unitTetrahedron({0, 0, 0, 0}), grey());
    OpaqueObjects objects;
    objects.surfaces = boundarySurfaces(*scene.mesh, {}, look);
    scene.mapSources.push_back(std::make_shared<const OpaqueLayer>(scene, objects));
    Camera camera = test::cameraAt({0.25, 0.25, -4}, {0.25, 0.25, 0.25});  // the face z = 0, seen straight on
    camera.orthographicHeight = 1.6;
    camera.width = camera.height = 64;
    const CameraFrame frame = cameraFrame(camera);
    const double pixel = 1.6 / 64;
    const Image image = pictureOf(scene, camera);
    int dark = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 at = pixelRay(frame, x, y).origin;
            const double inside = std::min({at.x, at.y, (1.0 - at.x - at.y) / std::sqrt(2.0)}) / pixel;
            if (inside < 0.0) continue;
            const double cover = std::clamp(2.0 - inside, 0.0, 1.0);  // half the width and half a pixel
            EXPECT_NEAR(image.at(x, y).x, 1.0 - cover, 1e-4) << x << " " << y;
            dark += cover > 0.99 ? 1 : 0;
        }
    EXPECT_GT(dark, 30);
}

TEST(CornerNormals, FollowTheFeatureAngle) {
    mesh::SurfaceMesh roof;  // two triangles bent by 90°
    roof.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    roof.triangles = {{0, 1, 2}, {1, 0, 3}};
    EXPECT_NEAR(glm::dot(cornerNormals(roof, 40.0)[0][0], glm::dvec3(0, 0, 1)), 1.0, 1e-12);
    EXPECT_LT(glm::dot(cornerNormals(roof, 91.0)[0][0], glm::dvec3(0, 0, 1)), 0.8);
}

}  // namespace
}  // namespace tetralux::projection
