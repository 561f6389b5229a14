// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_cell_outline.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace tetralux::projection {
namespace {

constexpr double margin = 1.0 / 128;

// Signed distance of a point from the outline's nearest edge, positive inside, whichever way round the polygon runs.
double depthInside(const CellOutline& outline, const glm::dvec2& point) {
    double area = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % 4];
        area += a.x * b.y - a.y * b.x;
    }
    double depth = 1e300;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % 4];
        if (a == b) continue;  // the repeated corner of a triangle
        const glm::dvec2 edge = glm::normalize(b - a), offset = point - a;
        depth = std::min(depth, (edge.x * offset.y - edge.y * offset.x) * (area > 0 ? 1 : -1));
    }
    return depth;
}

void expectHolds(const std::array<glm::dvec2, 4>& corners) {
    const CellOutline outline = cellOutline(corners, margin);
    for (const glm::dvec2& corner : corners) {
        EXPECT_GT(depthInside(outline, corner), 0.99 * margin - 1e-4) << "corner " << corner.x << ' ' << corner.y;
    }
    // not much larger than the hull: no corner of the outline farther than 40 margins from all corners of the cell
    for (const glm::vec2& vertex : outline) {
        double nearest = 1e300, extent = 0;
        for (const glm::dvec2& corner : corners) {
            nearest = std::min(nearest, glm::distance(glm::dvec2(vertex), corner));
            extent = std::max(extent, glm::distance(corners[0], corner));
        }
        EXPECT_LT(nearest, 40 * margin + extent);
        EXPECT_TRUE(std::isfinite(vertex.x) && std::isfinite(vertex.y));
    }
}

TEST(CellOutline, HoldsRandomCells) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> position(0, 20);
    for (int i = 0; i < 20000; ++i) {
        std::array<glm::dvec2, 4> corners;
        for (auto& corner : corners) corner = {position(random), position(random)};
        expectHolds(corners);
    }
}

TEST(CellOutline, HoldsNeedlesAndPoints) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> along(0, 50), across(-1, 1);
    for (const double width : {1e-2, 1e-5, 1e-9, 0.0}) {
        for (int i = 0; i < 2000; ++i) {
            std::array<glm::dvec2, 4> corners;
            for (auto& corner : corners) {
                const double x = along(random);
                corner = {x, 3 + 0.7 * x + width * across(random)};
            }
            expectHolds(corners);
        }
    }
    expectHolds({glm::dvec2(3, 4), {3, 4}, {3, 4}, {3, 4}});
    expectHolds({glm::dvec2(3, 4), {3, 4}, {5, 4}, {5, 4}});
    expectHolds({glm::dvec2(0, 0), {4, 0}, {2, 0}, {2, 3}});  // corner on an edge
}

// The area of a hull with right angles grows by exactly the margin's frame.
TEST(CellOutline, GrowsByTheMargin) {
    const CellOutline square = cellOutline({glm::dvec2(0, 0), {8, 0}, {8, 8}, {0, 8}}, margin);
    for (const glm::vec2& vertex : square) {
        EXPECT_NEAR(std::abs(vertex.x - 4), 4 + margin, 1e-6);
        EXPECT_NEAR(std::abs(vertex.y - 4), 4 + margin, 1e-6);
    }
    // a corner inside the triangle of the others leaves a triangle
    const CellOutline triangle = cellOutline({glm::dvec2(0, 0), {9, 0}, {0, 9}, {2, 2}}, margin);
    EXPECT_EQ(triangle[2], triangle[3]);
}

// What has no hull is drawn as the rectangle of its pixels: where it reaches behind the eye, or too far beyond the
// image.
TEST(CellOutline, CellsWithoutAHullAreRectangles) {
    const CameraFrame frame = cameraFrame({.width = 16, .height = 12});
    for (const glm::dvec3& last : {glm::dvec3(0, 0, -1), {30000, 20, 1}}) {
        const std::array<glm::dvec3, 4> corners{glm::dvec3(-3, -2, 1), {3, -2, 1}, {0, 3, 1}, last};
        PixelRect rect{};
        ASSERT_EQ(coveredPixels(corners, frame, rect), SkipReason::None);
        const CellOutline outline = cellOutline(corners, frame, margin);
        EXPECT_EQ(outline[0], glm::vec2(rect.x0, rect.y0) - 0.5f);
        EXPECT_EQ(outline[2], glm::vec2(rect.x1, rect.y1) - 0.5f);
    }
}

}  // namespace
}  // namespace tetralux::projection
