// SPDX-License-Identifier: Apache-2.0
#include <projection/order/grid_heights.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tetralux::projection {

namespace {

/// e: large enough for keys to tell the cells of a box apart, small beside the change of slope that x² has.
constexpr double productShare = 0.25;

/// How much the height beyond a wall exceeds the continued one, at least, in squares of the wider of both distances.
constexpr double wallMargin = 0.02;

using Lines = std::array<std::vector<double>, 3>;

/// Which way the diagonals go along each axis, if the cell follows three edges of a box from one end of it to the
/// other.
std::optional<glm::dvec3> diagonalOf(const std::vector<glm::dvec3>& points, const mesh::Tetrahedron& cell) {
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) {
            const glm::dvec3 d = points[cell[b]] - points[cell[a]];
            if (d.x != 0 && d.y != 0 && d.z != 0)
                return glm::dvec3(d.x > 0 ? 1 : -1, d.y > 0 ? 1 : -1, d.z > 0 ? 1 : -1);
        }
    return std::nullopt;
}

/// Number of axis-parallel edges: three for a path along a box.
int axisParallelEdges(const std::vector<glm::dvec3>& points, const mesh::Tetrahedron& cell) {
    int edges = 0;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) {
            const glm::dvec3 d = points[cell[b]] - points[cell[a]];
            edges += (d.x != 0) + (d.y != 0) + (d.z != 0) == 1 ? 1 : 0;
        }
    return edges;
}

/// The distinct coordinates along each axis, ascending; nothing if they cross in another number of points. Gives up as
/// soon as there are too many, in a mesh without lines after some cube root of its points.
std::optional<Lines> linesOf(const std::vector<glm::dvec3>& points) {
    Lines lines;
    for (const glm::dvec3& p : points)
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<double>& known = lines[static_cast<std::size_t>(axis)];
            const auto at = std::lower_bound(known.begin(), known.end(), p[axis]);
            if (at != known.end() && *at == p[axis]) continue;
            known.insert(at, p[axis]);
            if (lines[0].size() * lines[1].size() * lines[2].size() > points.size()) return std::nullopt;
        }
    if (lines[0].size() * lines[1].size() * lines[2].size() != points.size()) return std::nullopt;
    return lines;
}

double widestGap(const std::vector<double>& lines) {
    double widest = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) widest = std::max(widest, lines[i] - lines[i - 1]);
    return widest;
}

/// F at each line: its slope grows at line i by the distance of the lines beside it, by `steepest` and by the margin.
std::vector<double> convexOver(const std::vector<double>& lines, double steepest) {
    std::vector<double> slopes{0.0};
    for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
        const double before = lines[i] - lines[i - 1], after = lines[i + 1] - lines[i];
        const double wide = std::max(before, after), narrow = std::min(before, after);
        slopes.push_back(slopes.back() + before + after + steepest + wallMargin * wide * wide / narrow);
    }
    const double middle = slopes.back() / 2;  // level in the middle, for the smallest heights
    std::vector<double> heights{0.0};
    for (std::size_t i = 1; i < lines.size(); ++i)
        heights.push_back(heights.back() + (slopes[i - 1] - middle) * (lines[i] - lines[i - 1]));
    return heights;
}

}  // namespace

std::optional<std::vector<double>> gridHeights(const std::vector<glm::dvec3>& points, const mesh::Tetrahedron& first) {
    const std::optional<glm::dvec3> diagonal = diagonalOf(points, first);
    if (!diagonal || axisParallelEdges(points, first) != 3) return std::nullopt;
    const std::optional<Lines> lines = linesOf(points);
    if (!lines) return std::nullopt;

    glm::dvec3 widest;
    for (int axis = 0; axis < 3; ++axis) widest[axis] = widestGap((*lines)[static_cast<std::size_t>(axis)]);
    Lines convex;
    for (int axis = 0; axis < 3; ++axis) {
        const double others = widest.x + widest.y + widest.z - widest[axis];
        convex[static_cast<std::size_t>(axis)] =
            convexOver((*lines)[static_cast<std::size_t>(axis)], productShare * others);
    }
    std::vector<double> heights(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 8192), [&](const auto& range) {
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
            const glm::dvec3 turned = points[p] * *diagonal;
            double height = -productShare * (turned.x * turned.y + turned.y * turned.z + turned.z * turned.x);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::vector<double>& along = (*lines)[axis];
                const auto at = std::lower_bound(along.begin(), along.end(), points[p][static_cast<int>(axis)]);
                height += convex[axis][static_cast<std::size_t>(at - along.begin())];
            }
            heights[p] = height;
        }
    });
    return heights;
}

}  // namespace tetralux::projection
