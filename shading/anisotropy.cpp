// SPDX-License-Identifier: Apache-2.0
#include <shading/anisotropy.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <mesh/point_cells.h>
#include <shading/level_set_points.h>

namespace tetralux::shading {

namespace {

double meanEdge(const mesh::ScalarMesh& mesh) {
    double sum = 0;
    for (const mesh::Tetrahedron& cell : mesh.cells)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = i + 1; k < 4; ++k)
                sum += glm::length(mesh.positions[cell[k]] - mesh.positions[cell[i]]);
    return mesh.cells.empty() ? 0.0 : sum / (6.0 * static_cast<double>(mesh.cells.size()));
}

/// (I − n nᵀ) M (I − n nᵀ) / Σ w.
Tensor inTangentPlane(const PointMoments& moments, const glm::dvec3& normal) {
    if (!(moments.weight > 0)) return Tensor{};
    const glm::dmat3 matrix(moments.xx, moments.xy, moments.xz, moments.xy, moments.yy, moments.yz, moments.xz,
                            moments.yz, moments.zz);
    const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(normal, normal);
    const glm::dmat3 found = across * matrix * across / moments.weight;
    return {found[0][0], found[1][1], found[2][2], found[0][1], found[0][2], found[1][2]};
}

/// Every tensor becomes the mean over the corners of the cells around its point.
std::vector<Tensor> smoothed(const mesh::ScalarMesh& mesh, const std::vector<Tensor>& tensors) {
    const mesh::PointCells around(mesh.cells, mesh.positions.size());
    std::vector<Tensor> result = tensors;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tensors.size(), 1024), [&](const auto& range) {
        for (std::size_t point = range.begin(); point != range.end(); ++point) {
            Tensor sum{};
            for (const mesh::CellIndex cell : around.of(point))
                for (const mesh::PointIndex corner : mesh.cells[cell])
                    for (std::size_t i = 0; i < 6; ++i) sum[i] += tensors[corner][i];
            const double count = 4.0 * static_cast<double>(around.of(point).size());
            if (count > 0)
                for (std::size_t i = 0; i < 6; ++i) result[point][i] = sum[i] / count;
        }
    });
    return result;
}

}  // namespace

std::vector<Tensor> levelSetTensors(const mesh::ScalarMesh& mesh, const std::vector<glm::dvec3>& gradients,
                                    const AnisotropySettings& settings) {
    std::vector<Tensor> tensors(mesh.positions.size(), Tensor{});
    const double radius = settings.radius * meanEdge(mesh);
    const double interval = settings.interval * (mesh.scalarMax - mesh.scalarMin);
    if (mesh.association == mesh::Association::Cell || !(radius > 0) || !(interval > 0)) return tensors;
    const LevelSetPoints points(mesh, radius, interval, settings.samples);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tensors.size(), 64), [&](const auto& range) {
        for (std::size_t point = range.begin(); point != range.end(); ++point) {
            const double magnitude = glm::length(gradients[point]);
            if (!(magnitude > 0)) continue;
            tensors[point] =
                inTangentPlane(points.near(mesh.positions[point], mesh.scalars[point]), gradients[point] / magnitude);
        }
    });
    for (int i = 0; i < settings.smoothing; ++i) tensors = smoothed(mesh, tensors);
    return tensors;
}

Anisotropy anisotropyAcross(const Tensor& tensor, const glm::dvec3& normal) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(normal, axis)), b = glm::cross(normal, a);
    const auto product = [&](const glm::dvec3& u, const glm::dvec3& v) {
        return tensor[0] * u.x * v.x + tensor[1] * u.y * v.y + tensor[2] * u.z * v.z +
               tensor[3] * (u.x * v.y + u.y * v.x) + tensor[4] * (u.x * v.z + u.z * v.x) +
               tensor[5] * (u.y * v.z + u.z * v.y);
    };
    const double mean = 0.5 * (product(a, a) + product(b, b)), half = 0.5 * (product(a, a) - product(b, b));
    const double root = std::hypot(half, product(a, b)), angle = 0.5 * std::atan2(product(a, b), half);
    return {mean - root, mean + root, std::cos(angle) * a + std::sin(angle) * b};
}

}  // namespace tetralux::shading
