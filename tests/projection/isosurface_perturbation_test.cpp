// SPDX-License-Identifier: Apache-2.0
//
// Pixels in which floats may cross an isosurface twice at a face, or never: on one tetrahedron, close to the eye.
#include <gtest/gtest.h>

#include <algorithm>

#include <glm/geometric.hpp>

#include <projection/core/perturbed_isosurfaces.h>
#include <projection/repair/isosurface_perturbation.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// The scalar that a pixel's ray has in a face, of corners far apart in depth, is the isosurface's value in float: then
// the pixel is named, and few others are.
TEST(IsosurfacePerturbation, NamesThePixelWhoseRayMeetsTheIsosurfaceInAFace) {
    mesh::ScalarMesh one;
    one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, 2.0}};
    one.cells = {{0, 1, 2, 3}};
    one.scalars = {0.0, 1.0, 0.3, 0.7};
    one = finished(std::move(one));
    const Camera camera = cameraAt({0.9, 0.8, 3.0}, {0.3, 0.3, 0.5}, 96, 96);
    const CameraFrame frame = cameraFrame(camera);
    int met = 0;
    for (std::uint32_t y = 3; y < 96; y += 7)
        for (std::uint32_t x = 2; x < 96; x += 7) {
            const Ray ray = pixelRay(frame, static_cast<int>(x), static_cast<int>(y));
            // the face 0, 1, 3: where it is met, in weights of its corners
            const glm::dvec3 a = one.positions[0], b = one.positions[1] - a, c = one.positions[3] - a;
            const glm::dvec3 normal = glm::cross(b, c);
            const double t = glm::dot(a - ray.origin, normal) / glm::dot(ray.direction, normal);
            const glm::dvec3 p = ray.origin + t * ray.direction - a;
            const double size = glm::dot(normal, normal), u = glm::dot(glm::cross(p, c), normal) / size,
                         v = glm::dot(glm::cross(b, p), normal) / size;
            if (u < 0.05 || v < 0.05 || u + v > 0.95) continue;
            ++met;
            const double scalar = u * one.scalars[1] + v * one.scalars[3];
            preint::TransferFunction function = constantFunction(1.0);
            function.isosurfaces = {{scalar + floatPerturbation, 0.5, glm::dvec3(1)}};
            const Scene scene = sceneOf(one, function, Mode::Standard);
            const auto pixels = perturbedPixels(scene, frame);
            EXPECT_EQ(std::count(pixels.begin(), pixels.end(), y * 96 + x) > 0, true) << x << ' ' << y << ' ' << scalar;
            EXPECT_LT(pixels.size(), 8u);
        }
    EXPECT_GT(met, 10);
}

}  // namespace
}  // namespace tetralux::projection
