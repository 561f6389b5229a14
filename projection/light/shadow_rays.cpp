// SPDX-License-Identifier: Apache-2.0
#include <projection/light/shadow_rays.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// How far beside a place a line begins, of the mesh's diagonal: more than files that hold floats move a vertex out of
/// a face that is parallel to the light, less than shows.
constexpr double besidePlace = 1e-6;
/// And at most so much of the way into the cell.
constexpr double mostOfTheWay = 0.05;

/// A point of every cell that lies in no plane of a grid's points: weights of its corners.
constexpr std::array<double, 4> insideWeights{0.1327, 0.3719, 0.2884, 0.2070};

/// What a place stands on does not shade it: opaque surfaces count from this on, of the mesh's diagonal.
constexpr double besideSurface = 1e-6;

/// Depth beyond which nothing arrives in float.
constexpr double darkDepth = 100.0;

/// Parts that lie no farther apart than this share of the mesh's diagonal belong to neighbours.
constexpr double joined = 1e-9;

using Triangles = std::vector<mesh::TriangleTree::Corners>;

Triangles trianglesOf(const std::vector<std::shared_ptr<const mesh::SurfaceMesh>>& surfaces) {
    Triangles triangles;
    for (const auto& surface : surfaces)
        for (const auto& [a, b, c] : surface->triangles)
            triangles.push_back({surface->positions[a], surface->positions[b], surface->positions[c]});
    return triangles;
}

/// Whether the line passes through the triangle beyond `least` (Möller & Trumbore 1997). Edges belong to both
/// triangles, so that no light gets through between them.
bool meets(const ShadowLine& line, const mesh::TriangleTree::Corners& triangle, double least) {
    const glm::dvec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
    const glm::dvec3 across = glm::cross(line.direction, v);
    const double whole = glm::dot(u, across);
    if (whole == 0) return false;
    const glm::dvec3 from = line.origin - triangle[0], other = glm::cross(from, u);
    constexpr double rounding = 1e-12;
    const double b = glm::dot(from, across) / whole, c = glm::dot(line.direction, other) / whole;
    if (b < -rounding || c < -rounding || b + c > 1 + rounding) return false;
    const double t = glm::dot(v, other) / whole;
    return t > least && t < line.end;
}

/// The least distance from a face, as a share of the cell's height over it: below 0 outside.
double leastCoordinate(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const glm::dvec3& place) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[mesh.cells[cell][k]];
    const double whole = mesh::sixVolumes(p[0], p[1], p[2], p[3]);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        auto q = p;
        q[k] = place;
        least = std::min(least, mesh::sixVolumes(q[0], q[1], q[2], q[3]) / whole);
    }
    return least;
}

}  // namespace

ShadowRays::ShadowRays(const Scene& scene)
    : mesh_(*scene.mesh),
      tree_(mesh_.positions, mesh_.cells),
      triangles_(trianglesOf(scene.shadowCasters)),
      triangleTree_(triangles_),
      exact_(scene.transferFunction),
      scaleInvariant_(integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant) {
    for (const auto& source : scene.mapSources)
        if (auto region = std::dynamic_pointer_cast<const ClipRegion>(source)) regions_.push_back(std::move(region));
    if (mesh_.association == mesh::Association::Cell) return;
    std::vector<preint::Isosurface> surfaces = scene.transferFunction.isosurfaces;
    std::sort(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    for (const preint::Isosurface& surface : surfaces) {
        if (!(surface.opacity > 0)) continue;
        surfaces_.push_back(surface.value);
        surfaceDepths_.push_back(-std::log1p(-surface.opacity));
    }
}

std::size_t ShadowRays::level(double scalar) const {
    return static_cast<std::size_t>(std::upper_bound(surfaces_.begin(), surfaces_.end(), scalar) - surfaces_.begin());
}

SurfaceRange ShadowRays::surfacesIn(mesh::CellIndex cell) const {
    double low = mesh_.scalarAt(cell, 0), high = low;
    for (int k = 1; k < 4; ++k) {
        low = std::min(low, mesh_.scalarAt(cell, k));
        high = std::max(high, mesh_.scalarAt(cell, k));
    }
    return {level(low), level(high)};
}

/// `way` to a point inside the cell, and how much of it lines begin from the place.
double ShadowRays::shareOfWay(const glm::dvec3& place, mesh::CellIndex cell, glm::dvec3& way) const {
    const mesh::Tetrahedron& corners = mesh_.cells[cell];
    way = glm::dvec3(0);
    for (std::size_t k = 0; k < 4; ++k) way += insideWeights[k] * (mesh_.positions[corners[k]] - place);
    const double distance = glm::length(way);
    return distance > 0 ? std::min(besidePlace * mesh_.bounds.diagonal() / distance, mostOfTheWay) : 0.0;
}

glm::dvec3 ShadowRays::within(const glm::dvec3& place, mesh::CellIndex cell) const {
    glm::dvec3 way;
    const double share = shareOfWay(place, cell, way);
    return place + share * way;
}

glm::dvec3 ShadowRays::within(mesh::PointIndex vertex, std::span<const mesh::CellIndex> around) const {
    const glm::dvec3 place = mesh_.positions[vertex];
    glm::dvec3 best = place;
    std::pair<bool, double> merit(false, 0.0);  // on the vertex's side, volume
    for (const mesh::CellIndex cell : around) {
        std::array<glm::dvec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = mesh_.positions[mesh_.cells[cell][k]];
        glm::dvec3 way;
        const double share = shareOfWay(place, cell, way);
        bool sameSide = true;
        if (hasSurfaces()) {
            const double scalar = mesh_.scalars[vertex];
            double step = 0;
            for (int k = 0; k < 4; ++k)
                step += insideWeights[static_cast<std::size_t>(k)] * (mesh_.scalarAt(cell, k) - scalar);
            sameSide = level(scalar + share * step) == level(scalar);
        }
        const std::pair here(sameSide, mesh::sixVolumes(p[0], p[1], p[2], p[3]));
        if (!(here > merit)) continue;
        merit = here;
        best = place + share * way;
    }
    return best;
}

glm::dvec3 ShadowRays::within(const glm::dvec3& place) const {
    const glm::dvec3 reach(besidePlace * mesh_.bounds.diagonal());
    constexpr double outside = -1e-6;  // of a cell's height: what rounding of the place amounts to
    double best = outside;
    std::optional<mesh::CellIndex> found;
    tree_.forEachInBox(place - reach, place + reach, [&](mesh::CellIndex cell) {
        const double least = leastCoordinate(mesh_, cell, place);
        if (!(least > best)) return;
        best = least;
        found = cell;
    });
    return found ? within(place, *found) : place;
}

double ShadowRays::transmittance(const ShadowStart& start, const ShadowLine& line) const {
    if (hidden(start, line)) return 0;
    const ShadowLine inside{start.within, line.direction, line.end};
    const glm::dvec2 shown = shownOf(inside);
    double depth = 0;
    thread_local std::vector<Part> parts;
    parts.clear();
    tree_.forEachAlong(inside.origin, inside.direction, inside.end, [&](mesh::CellIndex cell) {
        const Part part = partIn(cell, inside);
        if (!(part.end > part.begin)) return true;
        depth += smoothDepth(part, shown);
        if (hasSurfaces()) parts.push_back(part);
        return depth < darkDepth;
    });
    if (depth < darkDepth && hasSurfaces()) depth += surfaceDepth(start, parts, shown);
    return std::exp(-depth);
}

ShadowRays::Part ShadowRays::partIn(mesh::CellIndex cell, const ShadowLine& line) const {
    const mesh::Tetrahedron& corners = mesh_.cells[cell];
    std::array<glm::dvec3, 4> v;  // relative to the line's origin
    for (std::size_t k = 0; k < 4; ++k) v[k] = mesh_.positions[corners[k]] - line.origin;
    double in = 0, out = line.end, front = 0, back = 0;
    std::array<double, 4> constant, slope;  // six volumes on each face, as functions of t
    double whole = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& face = mesh::faceVertices[k];
        const glm::dvec3 &a = v[static_cast<std::size_t>(face[0])], &b = v[static_cast<std::size_t>(face[1])],
                         &c = v[static_cast<std::size_t>(face[2])];
        const glm::dvec3 inwards = glm::cross(c - a, b - a);
        constant[k] = -glm::dot(inwards, a);
        slope[k] = glm::dot(inwards, line.direction);
        whole += constant[k];
        if (slope[k] > 0) in = std::max(in, -constant[k] / slope[k]);
        if (slope[k] < 0) out = std::min(out, -constant[k] / slope[k]);
        if (slope[k] == 0 && constant[k] < 0) return {};
    }
    if (!(out > in) || !(whole > 0)) return {};
    const double origin = mesh_.scalarAt(cell, 0);
    for (int k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double step = (mesh_.scalarAt(cell, k) - origin) / whole;
        front += step * std::max(0.0, constant[i] + in * slope[i]);
        back += step * std::max(0.0, constant[i] + out * slope[i]);
    }
    return {in, out, origin + front, origin + back};
}

/// From where to where the line is within the clip regions.
glm::dvec2 ShadowRays::shownOf(const ShadowLine& line) const {
    glm::dvec2 shown(0.0, line.end);
    for (const auto& region : regions_) {
        const glm::dvec2 within = region->within({line.origin, line.direction});
        shown = {std::max(shown.x, within.x), std::min(shown.y, within.y)};
    }
    return shown;
}

bool ShadowRays::hidden(const ShadowStart& start, const ShadowLine& line) const {
    const double beside = besideSurface * mesh_.bounds.diagonal();
    const ShadowLine from{start.place, line.direction, line.end};
    bool hit = false;
    triangleTree_.forEachAlong(from.origin, from.direction, from.end, [&](std::uint32_t triangle) {
        hit = meets(from, triangles_[triangle], beside);
        return !hit;
    });
    return hit;
}

double ShadowRays::smoothDepth(Part part, const glm::dvec2& shown) const {
    const double begin = std::max(part.begin, shown.x), end = std::min(part.end, shown.y);
    if (!(end > begin)) return 0;
    const auto scalarAt = [&](double t) {
        return glm::mix(part.front, part.back, (t - part.begin) / (part.end - part.begin));
    };
    if (begin > part.begin || end < part.end) part = {begin, end, scalarAt(begin), scalarAt(end)};
    const double step = part.back - part.front;
    const double integral = exact_.extinctionIntegral(part.back) - exact_.extinctionIntegral(part.front);
    if (scaleInvariant_) return std::abs(integral);
    // a small step cancels in the integral: its mean is then that of the middle
    const double least =
        1e-9 * std::max({std::abs(part.front), std::abs(part.back), mesh_.scalarMax - mesh_.scalarMin});
    const double mean =
        std::abs(step) > least ? integral / step : exact_.valueFromAbove(part.front + 0.5 * step).extinction;
    return (part.end - part.begin) * mean;
}

/// Of the isosurfaces that the line crosses. It is followed from level to level (ShadowRays::level), so that a surface
/// in a face is crossed once, whatever rounding says. What is cut off has levels too: a corner there may be behind a
/// surface that is partly shown.
double ShadowRays::surfaceDepth(const ShadowStart& start, std::vector<Part>& parts, const glm::dvec2& shown) const {
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.begin < b.begin; });
    const double gap = joined * mesh_.bounds.diagonal();
    thread_local std::vector<char> passes;  // of the surfaces start.passed
    passes.assign(start.passed.empty() ? 0 : start.passed.to - start.passed.from, 0);
    const auto passesFirst = [&](std::size_t surface) {
        if (surface < start.passed.from || surface >= start.passed.to) return false;
        return std::exchange(passes[surface - start.passed.from], 1) == 0;
    };
    double depth = 0, end = -std::numeric_limits<double>::infinity();
    std::size_t here = 0;
    for (const Part& part : parts) {
        if (part.begin > end + gap) here = level(part.front);
        for (const std::size_t next = level(part.back); here != next;) {
            const std::size_t crossed = here < next ? here++ : --here;
            if (!passesFirst(crossed) && part.contains(surfaces_[crossed], shown)) depth += surfaceDepths_[crossed];
        }
        end = std::max(end, part.end);
    }
    return depth;
}

}  // namespace tetralux::projection
