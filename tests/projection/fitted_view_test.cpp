// SPDX-License-Identifier: Apache-2.0
#include <projection/core/fitted_view.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/frame/engine_registry.h>
#include <projection/frame/shown_points.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

std::vector<glm::dvec3> boxCorners(const glm::dvec3& low, const glm::dvec3& high) {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z);
    return corners;
}

/// Where the points lie in the picture: −1 at the left and bottom edge, 1 at the right and top one.
struct Edges {
    glm::dvec2 low{1e300}, high{-1e300};
};
Edges edgesOf(const Camera& camera, const std::vector<glm::dvec3>& points) {
    const glm::dvec3 f = glm::normalize(camera.target - camera.eye), r = glm::normalize(glm::cross(f, camera.up)),
                     u = glm::cross(r, f);
    const double half = camera.orthographic() ? 0.5 * camera.orthographicHeight
                                              : std::tan(camera.fovDegrees / 360.0 * 3.14159265358979323846);
    Edges edges;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v = p - camera.eye;
        const double depth = camera.orthographic() ? 1.0 : glm::dot(v, f);
        EXPECT_GT(glm::dot(v, f), 0.0);
        const glm::dvec2 at =
            glm::dvec2(glm::dot(v, r) * camera.height / camera.width, glm::dot(v, u)) / (half * depth) -
            camera.windowCentre;
        edges.low = {std::min(edges.low.x, at.x), std::min(edges.low.y, at.y)};
        edges.high = {std::max(edges.high.x, at.x), std::max(edges.high.y, at.y)};
    }
    return edges;
}

TEST(FittedView, HoldsAllAndTouchesTheEdges) {
    const auto points = boxCorners({-2, 5, 1}, {4, 6, 11});
    constexpr double margin = 0.05, edge = 1.0 - 2.0 * margin;
    for (const std::string& name : viewNames())
        for (const glm::ivec2 size : {glm::ivec2(300, 700), glm::ivec2(900, 200), glm::ivec2(256, 256)})
            for (const bool orthographic : {false, true})
                for (const glm::dvec2 off : {glm::dvec2(0), glm::dvec2(0.3, -0.2)}) {
                    Camera camera;
                    camera.width = size.x;
                    camera.height = size.y;
                    camera.orthographicHeight = orthographic ? 1.0 : 0.0;
                    camera.windowCentre = off;
                    const Camera held = fitted(camera, namedView(name), points, {margin, margin, margin, margin});
                    const Edges seen = edgesOf(held, points);
                    EXPECT_GT(std::min(seen.low.x, seen.low.y), -edge - 1e-9) << name;
                    EXPECT_LT(std::max(seen.high.x, seen.high.y), edge + 1e-9) << name;
                    const bool wide = seen.low.x < -edge + 1e-9 && seen.high.x > edge - 1e-9;
                    const bool tall = seen.low.y < -edge + 1e-9 && seen.high.y > edge - 1e-9;
                    EXPECT_TRUE(wide || tall) << name << ": both edges of one direction are touched";
                }
}

TEST(FittedView, LeavesRoomAtOneSide) {
    const auto points = boxCorners({0, 0, 0}, {3, 1, 1});
    for (const bool orthographic : {false, true}) {
        Camera camera;
        camera.orthographicHeight = orthographic ? 1.0 : 0.0;
        const Edges seen = edgesOf(fitted(camera, namedView("z"), points, {0.0, 0.25, 0.0, 0.0}), points);
        EXPECT_NEAR(seen.low.x, -1.0, 1e-9);
        EXPECT_NEAR(seen.high.x, 0.5, 1e-9);
    }
}

TEST(FittedView, LooksFromTheNamedSide) {
    const auto points = boxCorners({0, 0, 0}, {1, 2, 3});
    EXPECT_GT(fitted({}, namedView("x"), points, {}).eye.x, 1.0);
    EXPECT_LT(fitted({}, namedView("-y"), points, {}).eye.y, 0.0);
    EXPECT_EQ(namedView("z").up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(namedView("y").up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(namedView("xy").forward, glm::dvec3(0, 0, -1));
    const ViewDirection side = namedView("xz");  // PyVista: x to the right, z up
    EXPECT_EQ(glm::cross(side.forward, side.up), glm::dvec3(1, 0, 0));
    EXPECT_THROW(namedView("front"), std::runtime_error);
}

TEST(FittedView, OfPointsWithoutExtent) {
    const std::vector<glm::dvec3> one{{3, 4, 5}};
    const Camera camera = fitted({}, namedView("iso"), one, {});
    EXPECT_NEAR(glm::distance(camera.eye, one[0]), 1.0, 1e-12);
    const std::vector<glm::dvec3> line{{0, 0, 0}, {0, 0, 9}};  // along the view
    const Camera along = fitted({}, namedView("z"), line, {});
    EXPECT_GT(along.eye.z, 9.0);
    EXPECT_THROW(fitted({}, namedView("z"), {}, {}), std::runtime_error);
    EXPECT_THROW(fitted({}, {{0, 0, 1}, {0, 0, 1}}, one, {}), std::runtime_error);
}

/// vtkCamera 9 at (0, 0, 5), looking at the origin, up y: positions after Azimuth(30), Elevation(20), view up after
/// Roll(40).
TEST(FittedView, TurnsAsVtkDoes) {
    Camera camera;
    camera.eye = {0, 0, 5};
    const double d = 3.14159265358979323846 / 180.0;
    Camera after = turned(camera, {30, 0, 0});
    EXPECT_LT(glm::distance(after.eye, glm::dvec3(5 * std::sin(30 * d), 0, 5 * std::cos(30 * d))), 1e-12);
    after = turned(camera, {0, 20, 0});
    EXPECT_LT(glm::distance(after.eye, glm::dvec3(0, 5 * std::sin(20 * d), 5 * std::cos(20 * d))), 1e-12);
    EXPECT_EQ(after.up, camera.up);
    after = turned(camera, {0, 0, 40});
    EXPECT_LT(glm::distance(after.up, glm::dvec3(std::sin(40 * d), std::cos(40 * d), 0)), 1e-12);
    EXPECT_LT(glm::distance(after.eye, camera.eye), 1e-12);
    EXPECT_NEAR(zoomed(camera, 2.0).fovDegrees, 15.0, 1e-12);
    camera.orthographicHeight = 6.0;
    EXPECT_NEAR(zoomed(camera, 2.0).orthographicHeight, 3.0, 1e-12);
    EXPECT_THROW(zoomed(camera, 0.0), std::runtime_error);
}

Scene cube(const preint::TransferFunction& function) {
    return test::sceneOf(test::boxMesh(9, [](const glm::dvec3& x) { return x.x; }), function);
}

mesh::BoundingBox boundsOf(const std::vector<glm::dvec3>& points) {
    mesh::BoundingBox box{points.front(), points.front()};
    for (const glm::dvec3& p : points)
        for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis], p[axis]);
            box.high[axis] = std::max(box.high[axis], p[axis]);
        }
    return box;
}

TEST(ShownPoints, AreOfWhatShows) {
    preint::TransferFunction upper;  // from x = 0.5 on
    upper.color = {{0, {1, 1, 1}}};
    upper.extinction = {{0.5, 0.0}, {0.5, 5.0}};
    const mesh::BoundingBox half = boundsOf(shownPoints(cube(upper), {}));
    EXPECT_NEAR(half.low.x, 0.5, 0.125 + 1e-9) << "to within a cell";
    EXPECT_EQ(half.high, glm::dvec3(1));
    EXPECT_EQ(boundsOf(shownPoints(cube(upper), {}, false)).low, glm::dvec3(0));
    SceneParts clipped;
    clipped.clips = {{{0, 0.3, 0}, {0, 1, 0}}, {{0, 0.9, 0}, {0, -2, 0}}};
    const mesh::BoundingBox slab = boundsOf(shownPoints(cube(upper), clipped));
    EXPECT_NEAR(slab.low.y, 0.3, 1e-12);
    EXPECT_NEAR(slab.high.y, 0.9, 1e-12);
}

TEST(ShownPoints, TellWhyAPictureIsEmpty) {
    preint::TransferFunction function;
    function.color = {{0, {1, 1, 1}}};
    function.extinction = {{0, 1}};
    const Scene scene = cube(function);
    const Camera camera = test::cameraAt({2, 2, 3});
    SceneParts parts;
    parts.clips = {{{0, 0, 5}, {0, 0, 1}}};
    EXPECT_NE(whyEmpty(scene, parts, camera).find("clipping planes"), std::string::npos);
    Camera away = camera;
    away.target = {4, 4, 6};
    EXPECT_NE(whyEmpty(scene, {}, away).find("behind the eye"), std::string::npos);
    Camera beside = camera;
    beside.target = {8, 2, -3};
    EXPECT_NE(whyEmpty(scene, {}, beside).find("beside the picture"), std::string::npos);
    function.extinction = {{0, 0}};
    EXPECT_NE(whyEmpty(cube(function), {}, camera).find("transfer function"), std::string::npos);
}

}  // namespace
}  // namespace tetralux::projection
