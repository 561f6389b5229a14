// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where a ray meets a triangle, in double precision, such that no ray slips through an edge or meets it twice.
#pragma once

#include <array>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <projection/cells/edge_side.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

/// A point of the mesh seen along a ray: offset across the ray (two axes) and distance along it.
struct RayPoint {
    glm::dvec2 across;
    double t;
};

/// Two axes across the ray.
struct RayFrame {
    glm::dvec3 origin, direction, across, other;

    RayFrame() = default;
    explicit RayFrame(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
        const glm::dvec3 a = glm::abs(direction);
        const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                                : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                         : glm::dvec3(0, 0, 1);
        across = glm::normalize(glm::cross(direction, axis));
        other = glm::cross(direction, across);
    }

    RayPoint see(const glm::dvec3& point) const {
        const glm::dvec3 p = point - origin;
        return {{glm::dot(p, across), glm::dot(p, other)}, glm::dot(p, direction)};
    }
};

/// The point a + b·(B − A) + c·(C − A) of a triangle ABC that a ray's line meets.
struct TriangleCrossing {
    double b, c;
    bool positive;  ///< the triangle's corners run counter-clockwise about (across, other)

    /// A value that is linear on the triangle; from differences: exact where all three are the same.
    double blend(double atA, double atB, double atC) const { return atA + b * (atB - atA) + c * (atC - atA); }
};

/// `indices` are the corners' point numbers (edge_side.h). Nothing where the line passes beside the triangle, or where
/// the triangle is a line to it.
inline std::optional<TriangleCrossing> crossTriangle(const std::array<glm::dvec2, 3>& across,
                                                     const std::array<mesh::PointIndex, 3>& indices) {
    const auto& [qa, qb, qc] = across;
    const auto& [a, b, c] = indices;
    const bool positive = passesPositive(qb, qc, b, c);
    if (positive != passesPositive(qc, qa, c, a) || positive != passesPositive(qa, qb, a, b)) return std::nullopt;
    const double wa = edgeSide(qb, qc), wb = edgeSide(qc, qa), wc = edgeSide(qa, qb);
    const double sum = wa + wb + wc;
    if (sum == 0) return std::nullopt;
    return TriangleCrossing{wb / sum, wc / sum, positive};
}

}  // namespace tetralux::projection
