// SPDX-License-Identifier: Apache-2.0
// Rays that meet exactly the value of an isosurface where the scalar turns or the mesh begins: s = v is not below v, in
// every pixel, whatever rounding says. The pictures are known.
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <projection/frame/engine_registry.h>
#include <projection/reference/reference_cut.h>
#include <tests/stress/engine_cases.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// nothing but whole isosurfaces, in float; one pixel that falls the other way is 0.24 and more
constexpr Threshold exact{1e-6, 1e-5};

constexpr double isosurfaceOpacity = 0.4;
constexpr float once = 0.4f, twice = 0.64f, never = 0.0f;  // alpha of a ray that crosses the isosurface

preint::TransferFunction oneIsosurface(double value) {
    preint::TransferFunction f;
    f.color = {{0.0, {1, 1, 1}}};
    f.extinction = {{0.0, 0.0}};
    f.isosurfaces = {{value, isosurfaceOpacity, {1, 1, 1}}};
    return f;
}

/// Pixel centres every 1/32 of the unit box and on its middle, seen along `axis` from either side.
Camera latticeCamera(int axis, double side) {
    glm::dvec3 eye(0.5);
    eye[axis] += 2.0 * side;
    Camera camera = cameraAt(eye, glm::dvec3(0.5), 27, 27);
    camera.orthographicHeight = 27.0 / 32.0;
    if (axis == 1) camera.up = {0, 0, 1};
    return camera;
}

TEST(StressPerturbation, OutlinesThroughPixelCentres) {
    // s = ±x + |z − ½|: rays along z turn at the middle of the box, where s = ±x. Where that is below v and the
    // walls are not, v is crossed twice, elsewhere not at all; v is the value of a row of pixel centres, in the middle
    // for both slopes and at the walls for one.
    for (int along = 0; along < 3; ++along)
        for (double slope : {1.0, -1.0})
            for (double side : {1.0, -1.0}) {
                const int across = (along + 1) % 3;
                const auto ramp = [&](const glm::dvec3& p) { return slope * (p[across] - 0.25); };
                Scene scene =
                    sceneOf(boxMesh(3, [&](const glm::dvec3& p) { return ramp(p) + std::abs(p[along] - 0.5); }),
                            oneIsosurface(0.0));
                const Camera camera = latticeCamera(along, side);
                const CameraFrame frame = cameraFrame(camera);
                Image expected(camera.width, camera.height);
                for (int y = 0; y < camera.height; ++y)
                    for (int x = 0; x < camera.width; ++x) {
                        // exact: all numbers here are multiples of 1/64
                        const double middle = ramp(pixelRay(frame, x, y).origin), wall = middle + 0.5;
                        const bool crosses = middle < 0 && !(wall < 0);
                        expected.at(x, y) = glm::vec4(crosses ? twice : never);
                    }
                EXPECT_GT(coveredShare(expected), 0.1);
                EXPECT_LT(coveredShare(expected), 0.9);
                holdEnginesTo(expected, scene, camera, exact,
                              fmt::format("outline on pixel centres, along {} {:+}, slope {:+}", along, side, slope));
            }
}

TEST(StressPerturbation, IsosurfacesOfTheBoundarysOwnValue) {
    // s falls from 1 on one wall to 0 on the other: that of 1 is crossed at the wall itself, that of 0 nowhere
    for (int axis = 0; axis < 3; ++axis)
        for (double value : {1.0, 0.0}) {
            const Scene scene =
                sceneOf(boxMesh(4, [&](const glm::dvec3& p) { return 1 - p[axis]; }), oneIsosurface(value));
            for (double side : {1.0, -1.0}) {
                Camera camera = latticeCamera(axis, side);
                for (bool orthographic : {true, false}) {
                    if (!orthographic) {
                        camera.orthographicHeight = 0;
                        camera.fovDegrees = 20;  // within the nearer wall's outline
                    }
                    Image expected(camera.width, camera.height);
                    for (glm::vec4& pixel : expected.pixels) pixel = glm::vec4(value == 1.0 ? once : never);
                    holdEnginesTo(expected, scene, camera, exact,
                                  fmt::format("isosurface {} of a wall, axis {} {:+} {}", value, axis, side,
                                              orthographic ? "orthographic" : ""));
                }
            }
        }
}

TEST(StressPerturbation, PlateausOfTheIsosurfacesValue) {
    // s rises to 1 in the first third, stays there and falls again: no ray along z is ever above 1
    const auto plateau = [](double z) { return std::min({3 * z, 1.0, 3 * (1 - z)}); };
    for (double turn : {1.0, -1.0}) {
        // turn −1: a valley whose floor is the isosurface: nothing is below it
        const Scene scene =
            sceneOf(boxMesh(4, [&](const glm::dvec3& p) { return turn * plateau(p.z); }), oneIsosurface(turn));
        Camera camera = cameraAt({0.8, 0.7, 3}, glm::dvec3(0.5), 32, 32);
        camera.fovDegrees = 10;  // all rays pass both walls
        Image expected(32, 32);
        for (glm::vec4& pixel : expected.pixels) pixel = glm::vec4(turn > 0 ? twice : never);
        holdEnginesTo(expected, scene, camera, exact, turn > 0 ? "plateau" : "valley");
    }
}

/// Whether `p` lies in the cell, its boundary included.
bool holds(const mesh::ScalarMesh& m, const mesh::Tetrahedron& cell, const glm::dvec3& p) {
    for (const auto& face : mesh::faceVertices) {
        const auto corner = [&](std::size_t k) { return m.positions[cell[static_cast<std::size_t>(face[k])]]; };
        if (mesh::sixVolumes(corner(0), corner(1), corner(2), p) > 1e-12) return false;
    }
    return true;
}

TEST(StressPerturbation, TheFirstHitIsNoCellThatTheRayOnlyTouches) {
    // rays through pixel centres run along diagonals of the cubes' faces, where cells end in edges
    mesh::ScalarMesh m = boxMesh(5, [](const glm::dvec3& p) { return p.x; });
    m.association = mesh::Association::Cell;
    m.scalars.resize(m.cells.size());
    for (std::size_t i = 0; i < m.cells.size(); ++i) m.scalars[i] = std::fmod(0.618 * static_cast<double>(i), 1.0);
    preint::TransferFunction function;
    function.color = {{0.0, {1, 0, 0}}, {1.0, {0, 1, 0.5}}};
    function.extinction = {{0.0, 5.0}};
    const Scene scene = sceneOf(finished(std::move(m)), function, Mode::FirstHit);
    const mesh::ScalarMesh& drawn = *scene.mesh;
    for (int along = 0; along < 3; ++along)
        for (const auto& options : enginesUnderTest()) {
            const Camera camera = latticeCamera(along, 1.0);
            const CameraFrame frame = cameraFrame(camera);
            FrameReport report;
            const Image image = makeEngine(scene, options)->render(camera, report);
            int onEdges = 0;
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    const Ray ray = pixelRay(frame, x, y);
                    const glm::dvec3 justInside = ray.origin + (1.5 + 1e-5) * ray.direction;
                    double nearest = 1.0;
                    int cells = 0;
                    for (std::size_t i = 0; i < drawn.cells.size(); ++i) {
                        if (!holds(drawn, drawn.cells[i], justInside)) continue;
                        ++cells;
                        const glm::dvec3 off = glm::dvec3(image.at(x, y)) - function.colorAt(drawn.scalars[i]);
                        nearest = std::min(nearest, glm::length(off));
                    }
                    onEdges += cells > 1 ? 1 : 0;
                    EXPECT_LT(nearest, 1e-5) << options.engine << ", axis " << along << ", pixel " << x << ' ' << y;
                }
            EXPECT_GT(onEdges, 10) << "no ray runs between cells: nothing was tested";
        }
}

TEST(StressPerturbation, TheFirstHitSeenFromAVertex) {
    // most cells about the eye end right there, where they show nothing
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    mesh::ScalarMesh m = boxMesh(4, [&](const glm::dvec3&) { return share(random); });
    preint::TransferFunction function;
    function.color = {{0.0, {1, 0.2, 0}}, {0.4, {0.1, 0.8, 0.9}}, {1.0, {0, 0.3, 1}}};
    function.extinction = {{0.0, 9.0}, {0.3, 0.0}, {0.7, 0.0}, {1.0, 4.0}};
    const Scene scene = sceneOf(finished(std::move(m)), function, Mode::FirstHit);
    for (const glm::dvec3& eye : {glm::dvec3(0.25, 0.5, 0.5), glm::dvec3(0.0), glm::dvec3(0.375, 0.5, 0.5)}) {
        Camera camera = cameraAt(eye, {0.6, 0.55, 0.63}, 40, 40);
        camera.fovDegrees = 70;
        const Image expected = referenceImage(scene, camera);
        EXPECT_GT(coveredShare(expected), 0.5);
        // a table's mean colours, to 5e-4
        holdEnginesTo(expected, scene, camera, {2e-4, 5e-3}, fmt::format("first hit from {:.3f}", eye.x));
    }
}

/// Two cells that share a face, from random points; scalars of 0 … 1.
Scene twoCells(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const auto at = [&](double x, double y, double z) {
        return glm::dvec3(x, y, z) + 0.3 * glm::dvec3(share(random), share(random), share(random));
    };
    mesh::ScalarMesh m;
    m.positions = {at(0, 0, -1), at(-1, -1, 0), at(1, -1, 0), at(0, 1, 0), at(0, 0, 1)};
    m.cells = {{0, 1, 2, 3}, {4, 1, 3, 2}};
    for (std::size_t i = 0; i < 5; ++i) m.scalars.push_back(share(random));
    m.scalars[0] = 0.0;
    m.scalars[4] = share(random) < 0.5 ? 0.05 : 1.0;  // turns at the face or goes on
    return sceneOf(finished(std::move(m)), oneIsosurface(0.5));
}

TEST(StressPerturbation, ValuesThatFloatTakesForOthers) {
    // v lies beside the scalar that a ray has where it enters, passes a face or leaves by less than float tells
    std::mt19937 random(7);
    int tried = 0;
    for (int mesh = 0; mesh < 6; ++mesh) {
        Scene scene = twoCells(random);
        const Camera camera = cameraAt({0.3, 0.2, mesh % 2 == 0 ? -6.0 : 6.0}, {0.1, 0.1, 0}, 24, 24);
        const int x = 9 + mesh % 5, y = 10 + mesh % 3;
        const RayFrame ray(pixelRay(cameraFrame(camera), x, y));
        const auto first = cut(ray, *scene.mesh, 0), second = cut(ray, *scene.mesh, 1);
        if (!first || !second) continue;
        for (double near : {first->scalarIn, first->scalarOut, second->scalarIn, second->scalarOut})
            for (double beside : {-5e-8, 1e-7, 4e-7}) {
                const double value = near + beside;
                scene.transferFunction = oneIsosurface(value);
                const auto crosses = [&](const RaySegment& s) { return (s.scalarIn < value) != (s.scalarOut < value); };
                const int times = crosses(*first) + crosses(*second);
                const Image expected = referenceImage(scene, camera);
                ASSERT_NEAR(expected.at(x, y).w, times == 0 ? never : times == 1 ? once : twice, 1e-6);
                holdEnginesTo(expected, scene, camera, exact, fmt::format("mesh {}, {:.3f} {:+}", mesh, near, beside));
                ++tried;
            }
    }
    EXPECT_GT(tried, 50);
}

}  // namespace
}  // namespace tetralux::projection
