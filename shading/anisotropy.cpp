// SPDX-License-Identifier: Apache-2.0
#include <shading/anisotropy.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <mesh/tet/point_cells.h>
#include <shading/cut_disc.h>
#include <shading/level_set_points.h>
#include <shading/mesh_border.h>

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

/// An axis that `normal` does not lie along.
glm::dvec3 besides(const glm::dvec3& normal) {
    return std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
}

/// uᵀ T v.
double product(const Tensor& tensor, const glm::dvec3& u, const glm::dvec3& v) {
    return tensor[0] * u.x * v.x + tensor[1] * u.y * v.y + tensor[2] * u.z * v.z + tensor[3] * (u.x * v.y + u.y * v.x) +
           tensor[4] * (u.x * v.z + u.z * v.x) + tensor[5] * (u.y * v.z + u.z * v.y);
}

Tensor tensorOf(const glm::dmat3& matrix) {
    return {matrix[0][0], matrix[1][1], matrix[2][2], matrix[0][1], matrix[0][2], matrix[1][2]};
}

/// (I − n nᵀ) M (I − n nᵀ) / Σ w.
Tensor inTangentPlane(const PointMoments& moments, const glm::dvec3& normal) {
    if (!(moments.weight > 0)) return Tensor{};
    const glm::dmat3 matrix(moments.xx, moments.xy, moments.xz, moments.xy, moments.yy, moments.yz, moments.xz,
                            moments.yz, moments.zz);
    const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(normal, normal);
    return tensorOf(across * matrix * across / moments.weight);
}

/// (λ₂ − λ₁)/(λ₂ + λ₁) of level sets without a direction, as large as filling points may make it by chance: they fill
/// cells evenly, so that errors fall with their number, where those of random points would with its root.
double chance(const PointMoments& moments) {
    constexpr double perPoint = 6.0;
    return moments.squares > 0 ? std::min(perPoint * moments.squares / (moments.weight * moments.weight), 1.0) : 0.0;
}

/// The tensor with what chance may have made of its anisotropy taken out: none is left below it, and half a thousandth
/// less where it is thirty times as much.
Tensor withoutChance(const Tensor& tensor, const glm::dvec3& normal, double chance) {
    const double half = 0.5 * (tensor[0] + tensor[1] + tensor[2]);
    Tensor round{};
    for (std::size_t i = 0; i < 3; ++i)
        round[i] = half * (1 - normal[static_cast<int>(i)] * normal[static_cast<int>(i)]);
    round[3] = -half * normal.x * normal.y;
    round[4] = -half * normal.x * normal.z;
    round[5] = -half * normal.y * normal.z;
    double square = 0;
    for (std::size_t i = 0; i < 6; ++i) square += (i < 3 ? 1 : 2) * std::pow(tensor[i] - round[i], 2);
    const double found = half > 0 ? std::sqrt(0.5 * square) / half : 0;
    const double share = found > chance ? 1 - std::pow(chance / found, 2) : 0.0;
    Tensor result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = round[i] + share * (tensor[i] - round[i]);
    return result;
}

/// Radii: where the scalars that count fill more of the ball its level sets are taken to be flat.
constexpr double thickest = 0.5;

/// What is needed to complete the moments of points near the mesh's border.
struct Surroundings {
    const mesh::ScalarMesh& mesh;
    const LevelSetPoints& points;
    const MeshBorder& border;
    double perRadius;  ///< intervals per radius, for a gradient of one range per diagonal
};

/// Of a point near the border: `found` as it would be if the mesh went on. Where the level set bends by so little that
/// its anisotropy is within `chance` it is round, whatever is seen of it.
Tensor completedAt(const Surroundings& around, mesh::PointIndex point, const glm::dvec3& gradient, const Tensor& found,
                   double chance) {
    const glm::dvec3& place = around.mesh.positions[point];
    const double magnitude = glm::length(gradient), slope = magnitude * around.perRadius;
    BentDisc disc;
    disc.z = gradient / magnitude;
    disc.x = glm::normalize(glm::cross(besides(disc.z), disc.z));
    disc.y = glm::cross(disc.z, disc.x);
    disc.thickness = std::min(1 / slope, 1.0);
    if (disc.thickness < thickest) {
        const Bend bend = around.points.bendNear(place, around.mesh.scalars[point], {disc.x, disc.y, disc.z}, slope);
        disc.xx = bend.xx;
        disc.yy = bend.yy;
        disc.xy = bend.xy;
        const double most = std::max({std::abs(bend.xx), std::abs(bend.yy), std::abs(bend.xy)});
        constexpr double perBend = 0.03;  // of a cylinder whose radius is 1/bend of the neighbourhood's, up to 1
        if (perBend * most * most < chance) return withoutChance(found, disc.z, 1.0);
    }
    const std::optional<SeenDisc> seen = around.border.cut(place, point, disc);
    if (!seen) return found;
    const DiscMoments whole = completed(
        *seen, {product(found, disc.x, disc.x), product(found, disc.y, disc.y), product(found, disc.x, disc.y)});
    const glm::dmat3 matrix = whole.xx * glm::outerProduct(disc.x, disc.x) +
                              whole.yy * glm::outerProduct(disc.y, disc.y) +
                              whole.xy * (glm::outerProduct(disc.x, disc.y) + glm::outerProduct(disc.y, disc.x));
    return tensorOf(matrix);
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
    const MeshBorder border(mesh, radius);
    const Surroundings around{mesh, points, border,
                              radius / mesh.bounds.diagonal() * ((mesh.scalarMax - mesh.scalarMin) / interval)};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tensors.size(), 64), [&](const auto& range) {
        for (std::size_t point = range.begin(); point != range.end(); ++point) {
            const double magnitude = glm::length(gradients[point]);
            if (!(magnitude > 0)) continue;
            const PointMoments moments = points.near(mesh.positions[point], mesh.scalars[point]);
            const glm::dvec3 normal = gradients[point] / magnitude;
            Tensor& tensor = tensors[point];
            tensor = inTangentPlane(moments, normal);
            if (!(moments.weight > 0)) continue;
            const double leeway = chance(moments);
            if (border.isNear(mesh.positions[point]))
                tensor = completedAt(around, static_cast<mesh::PointIndex>(point), gradients[point], tensor, leeway);
            tensor = withoutChance(tensor, normal, leeway);
        }
    });
    for (int i = 0; i < settings.smoothing; ++i) tensors = smoothed(mesh, tensors);
    return tensors;
}

Anisotropy anisotropyAcross(const Tensor& tensor, const glm::dvec3& normal) {
    const glm::dvec3 a = glm::normalize(glm::cross(normal, besides(normal))), b = glm::cross(normal, a);
    const double aa = product(tensor, a, a), bb = product(tensor, b, b), ab = product(tensor, a, b);
    const double mean = 0.5 * (aa + bb), half = 0.5 * (aa - bb);
    const double root = std::hypot(half, ab), angle = 0.5 * std::atan2(ab, half);
    return {mean - root, mean + root, std::cos(angle) * a + std::sin(angle) * b};
}

}  // namespace tetralux::shading
