// SPDX-License-Identifier: Apache-2.0
#include <projection/gl_cell_outline.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <mesh/tet_mesh.h>

namespace tetralux::projection {
namespace {

using Corners = std::array<glm::dvec2, 4>;

// Below this, 1 + cos of the turn at a corner: the corner's miter would reach 30 margins far.
constexpr double sharpestCorner = 2e-3;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// A box along the hull's longest chord, grown by `margin`: covers needles and flat cells, whose hull has no usable
// corners.
CellOutline boxOutline(const Corners& corners, double margin) {
    glm::dvec2 chord(1, 0);
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const glm::dvec2 difference = corners[j] - corners[i];
            const double squared = glm::dot(difference, difference);
            if (squared > longest) {
                longest = squared;
                chord = difference;
            }
        }
    }
    const glm::dvec2 along = glm::normalize(chord), across(-along.y, along.x);
    glm::dvec2 low(0), high(0);  // relative to corner 0, along and across
    for (std::size_t i = 1; i < 4; ++i) {
        const glm::dvec2 offset(glm::dot(corners[i] - corners[0], along), glm::dot(corners[i] - corners[0], across));
        low = glm::min(low, offset);
        high = glm::max(high, offset);
    }
    low -= margin;
    high += margin;
    const auto at = [&](double a, double b) { return glm::vec2(corners[0] + a * along + b * across); };
    return {at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
}

// The convex polygon `hull` (count corners, counter-clockwise) with every edge moved outwards by `margin`. False when a
// corner is too sharp for that.
bool growPolygon(const Corners& hull, std::size_t count, double margin, CellOutline& outline) {
    Corners normal;  // of the edge from corner i to the next, outwards
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 edge = hull[i + 1 < count ? i + 1 : 0] - hull[i];
        const double squared = glm::dot(edge, edge);
        if (!(squared > 0)) return false;
        normal[i] = glm::dvec2(edge.y, -edge.x) * (1.0 / std::sqrt(squared));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 &before = normal[i > 0 ? i - 1 : count - 1], &after = normal[i];
        const double turn = 1.0 + glm::dot(before, after);
        if (turn < sharpestCorner) return false;
        outline[i] = glm::vec2(hull[i] + (margin / turn) * (before + after));
    }
    if (count == 3) outline[3] = outline[2];
    return true;
}

}  // namespace

CellOutline cellOutline(const Corners& corners, double margin) {
    // Twice the projected area of each face, signed; the four sum to zero, so the hull is the union of the faces of
    // positive sign: one face, or two that share an edge, or all but one.
    std::array<double, 4> area;
    std::array<std::size_t, 4> positive, negative;
    std::size_t positives = 0, negatives = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& face = mesh::faceVertices[k];
        const glm::dvec2 &a = corners[static_cast<std::size_t>(face[0])],
                         &b = corners[static_cast<std::size_t>(face[1])],
                         &c = corners[static_cast<std::size_t>(face[2])];
        area[k] = cross(b - a, c - a);
        if (area[k] > 0) {
            positive[positives++] = k;
        } else {
            negative[negatives++] = k;
        }
    }
    Corners hull;
    std::size_t count = 3;
    if (positives == 1 || positives == 3) {
        const std::size_t face = positives == 1 ? positive[0] : negative[0];
        for (std::size_t i = 0; i < 3; ++i) hull[i] = corners[static_cast<std::size_t>(mesh::faceVertices[face][i])];
        if (positives == 3) std::swap(hull[1], hull[2]);  // that face shows its back: turn it counter-clockwise
    } else if (positives == 2) {
        // the positive faces are opposite `positive[0]` and `positive[1]` and share the edge of the other two corners
        hull = {corners[positive[0]], corners[negative[0]], corners[positive[1]], corners[negative[1]]};
        if (cross(hull[2] - hull[0], hull[3] - hull[1]) < 0) std::swap(hull[1], hull[3]);
        count = 4;
        // The two triangles of the quadrilateral meet along corners 0 and 2: a short seam shades fewer blocks of pixels
        // twice.
        const glm::dvec2 seam = hull[2] - hull[0], other = hull[3] - hull[1];
        if (glm::dot(other, other) < glm::dot(seam, seam)) hull = {hull[1], hull[2], hull[3], hull[0]};
    } else {
        return boxOutline(corners, margin);
    }
    CellOutline outline;
    return growPolygon(hull, count, margin, outline) ? outline : boxOutline(corners, margin);
}

CellOutline rectangleOutline(const PixelRect& rect) {
    const float x0 = static_cast<float>(rect.x0) - 0.5f, x1 = static_cast<float>(rect.x1) - 0.5f;
    const float y0 = static_cast<float>(rect.y0) - 0.5f, y1 = static_cast<float>(rect.y1) - 0.5f;
    return {glm::vec2(x0, y0), glm::vec2(x1, y0), glm::vec2(x1, y1), glm::vec2(x0, y1)};
}

}  // namespace tetralux::projection
