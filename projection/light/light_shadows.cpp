// SPDX-License-Identifier: Apache-2.0
#include <projection/light/light_shadows.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <mesh/tet/point_cells.h>
#include <projection/light/shadow_rays.h>

namespace tetralux::projection {

namespace {

using shading::Light;

/// Of an area light; they lie in fours about its middle, so that half of it is half of them, and a quarter a quarter.
constexpr int areaSamples = 32;

/// No component zero, so that boxes can be cut (mesh/tet/box_tree.h).
glm::dvec3 unitWithoutZeros(glm::dvec3 direction) {
    direction = glm::normalize(direction);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(direction[axis]) < 1e-12) direction[axis] = 1e-12;
    return direction;
}

/// Point i of a disc of radius 1 across `direction`, evenly spread (Vogel's spiral, four times).
glm::dvec3 discPoint(const glm::dvec3& direction, int i) {
    const glm::dvec3 axis = std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(direction, axis)), b = glm::cross(direction, a);
    const int step = i / 4;
    const double radius = std::sqrt((step + 0.5) / (areaSamples / 4)),
                 angle = step * std::numbers::pi * (3 - std::sqrt(5.0)) + (i % 4) * 0.5 * std::numbers::pi;
    return radius * (std::cos(angle) * a + std::sin(angle) * b);
}

double shadowAt(const ShadowRays& rays, const Light& light, const ShadowStart& start, double softness) {
    const bool point = light.kind == Light::Kind::Point;
    const glm::dvec3 way = point ? light.position - start.place : light.towards;
    if (light.kind == Light::Kind::Head || !(glm::dot(way, way) > 0)) return 1.0;
    const auto lineTo = [&](const glm::dvec3& target) {
        return ShadowLine{start.place, unitWithoutZeros(target),
                          point ? glm::length(target) : std::numeric_limits<double>::infinity()};
    };
    if (!(softness > 0)) return rays.transmittance(start, lineTo(way));
    const glm::dvec3 direction = glm::normalize(way);
    double sum = 0;
    for (int i = 0; i < areaSamples; ++i)
        sum += rays.transmittance(start, lineTo((point ? way : direction) + softness * discPoint(direction, i)));
    return sum / areaSamples;
}

/// Where lines from the vertices of a mesh begin.
class VertexStarts {
public:
    VertexStarts(const mesh::ScalarMesh& mesh, const ShadowRays& rays)
        : mesh_(mesh), rays_(rays), around_(mesh.cells, mesh.positions.size()) {}

    ShadowStart of(std::size_t point) const {
        return {mesh_.positions[point], rays_.within(static_cast<mesh::PointIndex>(point), around_.of(point))};
    }

private:
    const mesh::ScalarMesh& mesh_;
    const ShadowRays& rays_;
    const mesh::PointCells around_;
};

/// Which of a cell's isosurfaces hide its corners from each light.
class CellSurfaces {
public:
    CellSurfaces(const Scene& scene, const ShadowRays& rays, mesh::CellIndex cell) {
        const SurfaceRange surfaces = rays.surfacesIn(cell);
        if (surfaces.empty()) return;
        const mesh::ScalarMesh& mesh = *scene.mesh;
        const glm::dvec3 gradient = mesh::cellGradient(mesh, cell);
        glm::dvec3 centre(0);
        for (const mesh::PointIndex point : mesh.cells[cell]) centre += 0.25 * mesh.positions[point];
        for (const Light& light : scene.settings.shading.lights) {
            const glm::dvec3 way = light.kind == Light::Kind::Point ? light.position - centre : light.towards;
            const bool rises = glm::dot(gradient, way) > 0;
            ends_.emplace_back(rises, rises ? surfaces.to : surfaces.from);
        }
    }

    /// There are none.
    bool empty() const { return ends_.empty(); }
    /// Those between a corner on that level and light `i`.
    SurfaceRange before(std::size_t level, std::size_t i) const {
        const auto [rises, end] = ends_[i];
        return rises ? SurfaceRange{level, end} : SurfaceRange{end, level};
    }
    bool anyBefore(std::size_t level) const {
        for (std::size_t i = 0; i < ends_.size(); ++i)
            if (!before(level, i).empty()) return true;
        return false;
    }
    bool operator<(const CellSurfaces& other) const { return ends_ < other.ends_; }

private:
    /// Per light: whether the scalar rises towards it, and the level on that side of the cell.
    std::vector<std::pair<bool, std::size_t>> ends_;
};

/// A vertex as corner of cells with the same isosurfaces: one row of attributes.
struct SurfaceCorner {
    mesh::PointIndex point;
    const CellSurfaces* surfaces;
};

/// Numbers the corners that need rows of their own from `first` on, and lets their cells refer to them.
std::vector<SurfaceCorner> surfaceCorners(const Scene& scene, const ShadowRays& rays,
                                          std::map<CellSurfaces, std::uint32_t>& cases,
                                          std::vector<mesh::Tetrahedron>& corners) {
    const mesh::ScalarMesh& mesh = *scene.mesh;
    std::vector<SurfaceCorner> found;
    std::unordered_map<std::uint64_t, mesh::PointIndex> rows;  // by case and point
    for (mesh::CellIndex cell = 0; cell < mesh.cells.size(); ++cell) {
        CellSurfaces surfaces(scene, rays, cell);
        if (surfaces.empty()) continue;
        const auto number = static_cast<std::uint32_t>(cases.size());
        const auto [place, isNew] = cases.emplace(std::move(surfaces), number);
        for (mesh::PointIndex& corner : corners[cell]) {
            if (!place->first.anyBefore(rays.level(mesh.scalars[corner]))) continue;
            const auto next = static_cast<mesh::PointIndex>(mesh.positions.size() + found.size());
            const auto [row, added] = rows.emplace(std::uint64_t{place->second} << 32 | corner, next);
            if (added) found.push_back({corner, &place->first});
            corner = row->second;
        }
    }
    return found;
}

}  // namespace

ShadowAt shadowsOf(const Scene& scene) {
    const auto rays = std::make_shared<const ShadowRays>(scene);
    return [mesh = scene.mesh, rays, softness = scene.settings.shading.shadows.softness](const Light& light,
                                                                                         const glm::dvec3& place) {
        return shadowAt(*rays, light, {place, rays->within(place)}, softness);
    };
}

void addShadows(const Scene& scene, shading::VertexLight& light) {
    const auto& settings = scene.settings.shading;
    const mesh::ScalarMesh& mesh = *scene.mesh;
    const ShadowRays rays(scene);
    const VertexStarts starts(mesh, rays);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.positions.size(), 64), [&](const auto& range) {
        for (std::size_t vertex = range.begin(); vertex != range.end(); ++vertex) {
            const ShadowStart start = starts.of(vertex);
            for (std::size_t i = 0; i < settings.lights.size(); ++i)
                light.of(vertex)[static_cast<std::size_t>(light.shadowAt) + i] =
                    static_cast<float>(shadowAt(rays, settings.lights[i], start, settings.shadows.softness));
        }
    });
}

void addSurfaceShadows(const Scene& scene, shading::VertexLight& light) {
    const auto& settings = scene.settings.shading;
    const mesh::ScalarMesh& mesh = *scene.mesh;
    const ShadowRays rays(scene);
    if (!rays.hasSurfaces()) return;
    const VertexStarts starts(mesh, rays);
    std::map<CellSurfaces, std::uint32_t> cases;
    std::vector<mesh::Tetrahedron> corners(mesh.cells.begin(), mesh.cells.end());
    const std::vector<SurfaceCorner> own = surfaceCorners(scene, rays, cases, corners);
    if (own.empty()) return;
    light.corners = std::move(corners);
    const std::size_t points = mesh.positions.size();
    light.values.resize((points + own.size()) * static_cast<std::size_t>(light.stride));
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, own.size(), 64), [&](const auto& range) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
            const SurfaceCorner& corner = own[k];
            std::copy_n(light.of(corner.point), light.stride, light.of(points + k));
            ShadowStart start = starts.of(corner.point);
            const std::size_t level = rays.level(mesh.scalars[corner.point]);
            for (std::size_t i = 0; i < settings.lights.size(); ++i) {
                start.passed = corner.surfaces->before(level, i);
                if (start.passed.empty()) continue;
                light.of(points + k)[static_cast<std::size_t>(light.shadowAt) + i] =
                    static_cast<float>(shadowAt(rays, settings.lights[i], start, settings.shadows.softness));
            }
        }
    });
}

}  // namespace tetralux::projection
