// SPDX-License-Identifier: Apache-2.0
#include <projection/light/light_shadows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <mesh/tet/cell_tree.h>
#include <mesh/tet/triangle_tree.h>
#include <preint/exact_integral.h>

namespace tetralux::projection {

namespace {

using shading::Light;

constexpr double besideVertex = 1e-7;  // of the mesh's diagonal
const glm::dvec3 besideDirection = glm::normalize(glm::dvec3(0.4142135, 0.7320508, 0.2360679));

/// What a place stands on does not shade it: opaque surfaces count from this on, of the mesh's diagonal.
constexpr double besideSurface = 1e-6;

constexpr int areaSamples = 16;

/// Depth beyond which nothing arrives in float.
constexpr double darkDepth = 100.0;

/// From a vertex to a light: x = origin + t·direction, 0 ≤ t ≤ end. `direction` is a unit vector.
struct Line {
    glm::dvec3 origin, direction;
    double end;
};

/// The part of a line in one cell and the scalars at its ends.
struct Part {
    double length = 0, front = 0, back = 0;
};

Part partIn(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const Line& line) {
    const mesh::Tetrahedron& corners = mesh.cells[cell];
    std::array<glm::dvec3, 4> v;  // relative to the line's origin
    for (std::size_t k = 0; k < 4; ++k) v[k] = mesh.positions[corners[k]] - line.origin;
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
    const double origin = mesh.scalarAt(cell, 0);
    for (int k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double step = (mesh.scalarAt(cell, k) - origin) / whole;
        front += step * std::max(0.0, constant[i] + in * slope[i]);
        back += step * std::max(0.0, constant[i] + out * slope[i]);
    }
    return {out - in, origin + front, origin + back};
}

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
bool meets(const Line& line, const mesh::TriangleTree::Corners& triangle, double least) {
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

class ShadowRays {
public:
    explicit ShadowRays(const Scene& scene)
        : mesh_(*scene.mesh),
          tree_(mesh_.positions, mesh_.cells),
          triangles_(trianglesOf(scene.shadowCasters)),
          surfaces_(triangles_),
          beside_(besideSurface * mesh_.bounds.diagonal()),
          exact_(scene.transferFunction),
          scaleInvariant_(integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant) {}

    double transmittance(const Line& line) const {
        if (hidden(line)) return 0;
        double depth = 0;
        tree_.forEachAlong(line.origin, line.direction, line.end, [&](mesh::CellIndex cell) {
            depth += depthOf(partIn(mesh_, cell, line));
            return depth < darkDepth;
        });
        return std::exp(-depth);
    }

private:
    bool hidden(const Line& line) const {
        bool hit = false;
        surfaces_.forEachAlong(line.origin, line.direction, line.end, [&](std::uint32_t triangle) {
            hit = meets(line, triangles_[triangle], beside_);
            return !hit;
        });
        return hit;
    }

    double depthOf(const Part& part) const {
        if (!(part.length > 0)) return 0;
        double depth = 0;
        for (const preint::Isosurface& surface : exact_.function().isosurfaces)
            if ((part.front < surface.value) != (part.back < surface.value)) depth -= std::log1p(-surface.opacity);
        const double step = part.back - part.front;
        const double integral = exact_.extinctionIntegral(part.back) - exact_.extinctionIntegral(part.front);
        if (scaleInvariant_) return depth + std::abs(integral);
        // a small step cancels in the integral: its mean is then that of the middle
        const double least =
            1e-9 * std::max({std::abs(part.front), std::abs(part.back), mesh_.scalarMax - mesh_.scalarMin});
        const double mean =
            std::abs(step) > least ? integral / step : exact_.valueFromAbove(part.front + 0.5 * step).extinction;
        return depth + part.length * mean;
    }

    const mesh::ScalarMesh& mesh_;
    const mesh::CellTree tree_;
    const Triangles triangles_;
    const mesh::TriangleTree surfaces_;
    const double beside_;
    const preint::ExactIntegral exact_;
    const bool scaleInvariant_;
};

/// No component zero, so that boxes can be cut (mesh/tet/cell_tree.h).
glm::dvec3 unitWithoutZeros(glm::dvec3 direction) {
    direction = glm::normalize(direction);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(direction[axis]) < 1e-12) direction[axis] = 1e-12;
    return direction;
}

/// Point i of a disc of radius 1 across `direction`, evenly spread (Vogel's spiral).
glm::dvec3 discPoint(const glm::dvec3& direction, int i) {
    const glm::dvec3 axis = std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(direction, axis)), b = glm::cross(direction, a);
    const double radius = std::sqrt((i + 0.5) / areaSamples), angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    return radius * (std::cos(angle) * a + std::sin(angle) * b);
}

double shadowAt(const ShadowRays& rays, const Light& light, const glm::dvec3& origin, double softness) {
    const bool point = light.kind == Light::Kind::Point;
    const glm::dvec3 way = point ? light.position - origin : light.towards;
    if (!(glm::dot(way, way) > 0)) return 1.0;
    const auto lineTo = [&](const glm::dvec3& target) {
        return Line{origin, unitWithoutZeros(target),
                    point ? glm::length(target) : std::numeric_limits<double>::infinity()};
    };
    if (!(softness > 0)) return rays.transmittance(lineTo(way));
    const glm::dvec3 direction = glm::normalize(way);
    double sum = 0;
    for (int i = 0; i < areaSamples; ++i)
        sum += rays.transmittance(lineTo((point ? way : direction) + softness * discPoint(direction, i)));
    return sum / areaSamples;
}

}  // namespace

ShadowAt shadowsOf(const Scene& scene) {
    const auto rays = std::make_shared<const ShadowRays>(scene);
    const glm::dvec3 beside = besideVertex * scene.mesh->bounds.diagonal() * besideDirection;
    return [mesh = scene.mesh, rays, beside, softness = scene.settings.shading.shadows.softness](
               const Light& light, const glm::dvec3& place) {
        return light.kind == Light::Kind::Head ? 1.0 : shadowAt(*rays, light, place + beside, softness);
    };
}

void addShadows(const Scene& scene, shading::VertexLight& light) {
    const auto& settings = scene.settings.shading;
    const mesh::ScalarMesh& mesh = *scene.mesh;
    const ShadowRays rays(scene);
    const glm::dvec3 beside = besideVertex * mesh.bounds.diagonal() * besideDirection;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.positions.size(), 64), [&](const auto& range) {
        for (std::size_t vertex = range.begin(); vertex != range.end(); ++vertex)
            for (std::size_t i = 0; i < settings.lights.size(); ++i) {
                if (settings.lights[i].kind == Light::Kind::Head) continue;
                light.of(vertex)[static_cast<std::size_t>(light.shadowAt) + i] = static_cast<float>(
                    shadowAt(rays, settings.lights[i], mesh.positions[vertex] + beside, settings.shadows.softness));
            }
    });
}

}  // namespace tetralux::projection
