// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/isolines.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/tet/plane_cut.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::mesh {
namespace {

double linear(const glm::dvec3& x) {
    return x.x + 2 * x.y;
}

TEST(Isolines, OfALinearScalarAreStraightAndWhole) {
    const SurfaceMesh cut = cutByPlane(test::jitteredBoxMesh(6, 0.3, 7, linear), {0.5, 0.5, 0.37}, {0, 0, 1});
    const std::vector<double> values{-1.0, 0.5, 1.5, 4.0};  // the first and the last one are nowhere
    double length[4] = {};
    for (const IsolineSegment& segment : isolines(cut, values)) {
        EXPECT_NEAR(linear(segment.from), values[segment.value], 1e-14);
        EXPECT_NEAR(linear(segment.to), values[segment.value], 1e-14);
        length[segment.value] += glm::distance(segment.from, segment.to);
    }
    // across the unit square: from (0.5, 0) to (0, 0.25), and from (1, 0.25) to (0, 0.75)
    EXPECT_NEAR(length[1], std::hypot(0.5, 0.25), 1e-12);
    EXPECT_NEAR(length[2], std::hypot(1.0, 0.5), 1e-12);
    EXPECT_EQ(length[0] + length[3], 0.0);
}

TEST(Isolines, ValuesOfCornersCountFromAbove) {
    SurfaceMesh square;  // two triangles, with a diagonal from 1 to 2
    square.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    square.triangles = {{0, 1, 2}, {1, 3, 2}};
    const auto count = [&](const std::vector<double>& scalars) {
        square.scalars = scalars;
        return isolines(square, {1.0}).size();
    };
    EXPECT_EQ(count({0, 1, 1, 1}), 1u) << "the diagonal, of the triangle with something below";
    EXPECT_EQ(count({2, 1, 1, 2}), 0u);
    EXPECT_EQ(count({1, 1, 1, 1}), 0u);
    EXPECT_EQ(count({1, 0, 0, 0}), 0u) << "a point";
    EXPECT_EQ(count({0, 0, 2, 2}), 2u);
}

TEST(Isolines, OfCellsRunBetweenThem) {
    ScalarMesh cube = test::boxMesh(3, linear);
    cube.association = Association::Cell;
    cube.scalars.clear();
    for (const Tetrahedron& cell : cube.cells) {
        double x = 0;
        for (const PointIndex p : cell) x += 0.25 * cube.positions[p].x;
        cube.scalars.push_back(x < 0.5 ? 0.0 : 1.0);
    }
    double length = 0;
    const SurfaceMesh cut = cutByPlane(cube, {0.5, 0.5, 0.25}, {0, 0, 1});
    for (const IsolineSegment& segment : isolines(cut, {0.0, 0.4, 1.0, 1.1})) {
        EXPECT_TRUE(segment.value == 1 || segment.value == 2);
        EXPECT_NEAR(segment.from.x, 0.5, 1e-14);
        EXPECT_NEAR(segment.to.x, 0.5, 1e-14);
        length += glm::distance(segment.from, segment.to);
    }
    EXPECT_NEAR(length, 2.0, 1e-12) << "twice, for two values";
}

}  // namespace
}  // namespace tetralux::mesh
