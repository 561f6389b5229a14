// SPDX-License-Identifier: Apache-2.0
#include <projection/light/corner_normals.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

}  // namespace

std::vector<std::array<glm::dvec3, 3>> cornerNormals(const mesh::SurfaceMesh& surface, double featureAngle) {
    const double leastCosine = std::cos(featureAngle * std::numbers::pi / 180.0);
    std::vector<glm::dvec3> areas;
    std::vector<std::vector<std::size_t>> around(surface.positions.size());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const auto& [a, b, c] = surface.triangles[i];
        const auto& p = surface.positions;
        areas.push_back(glm::cross(p[b] - p[a], p[c] - p[a]));
        for (const mesh::PointIndex corner : surface.triangles[i]) around[corner].push_back(i);
    }
    std::vector<std::array<glm::dvec3, 3>> normals(surface.triangles.size());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const glm::dvec3 own = unitOrZero(areas[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            glm::dvec3 sum(0);
            for (const std::size_t other : around[surface.triangles[i][k]]) {
                const double along = glm::dot(areas[other], own);
                if (std::abs(along) >= leastCosine * glm::length(areas[other]))
                    sum += along < 0 ? -areas[other] : areas[other];
            }
            normals[i][k] = unitOrZero(sum);
        }
    }
    return normals;
}

}  // namespace tetralux::projection
