// SPDX-License-Identifier: Apache-2.0
#include <shading/anisotropy.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <mesh/cell_tree.h>
#include <mesh/point_cells.h>

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

using Weights = std::array<double, 4>;

/// Barycentric coordinates of points that fill a tetrahedron evenly: the additive sequence of Roberts, whose three
/// numbers in ascending order cut [0, 1] into four parts.
std::vector<Weights> fillingPoints(int count) {
    constexpr double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    std::vector<Weights> points;
    for (int i = 0; i < count; ++i) {
        double cut[3];
        for (int k = 0; k < 3; ++k) {
            const double x = 0.5 + steps[k] * i;
            cut[k] = x - std::floor(x);
        }
        std::sort(cut, cut + 3);
        points.push_back({cut[0], cut[1] - cut[0], cut[2] - cut[1], 1 - cut[2]});
    }
    return points;
}

/// The moments about one point, gathered cell by cell.
class Neighbourhood {
public:
    Neighbourhood(const mesh::ScalarMesh& mesh, const std::vector<double>& levelSetAreas, mesh::PointIndex point,
                  const glm::dvec3& normal, double radius, double interval)
        : mesh_(mesh),
          areas_(levelSetAreas),
          centre_(mesh.positions[point]),
          normal_(normal),
          scalar_(mesh.scalars[point]),
          perRadius_(1 / radius),
          interval_(interval) {}

    void add(mesh::CellIndex cell, const std::vector<Weights>& filling) {
        const mesh::Tetrahedron& points = mesh_.cells[cell];
        Weights steps;
        for (std::size_t k = 0; k < 4; ++k) steps[k] = mesh_.scalars[points[k]] - scalar_;
        const auto [low, high] = std::minmax_element(steps.begin(), steps.end());
        if (*low > interval_ || *high < -interval_) return;
        std::array<glm::dvec3, 4> corners;  // from the centre, in radii
        for (std::size_t k = 0; k < 4; ++k) corners[k] = (mesh_.positions[points[k]] - centre_) * perRadius_;
        const double area = areas_[cell];
        for (const Weights& w : filling) {
            const double step = w[0] * steps[0] + w[1] * steps[1] + w[2] * steps[2] + w[3] * steps[3];
            const glm::dvec3 x = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2] + w[3] * corners[3];
            const double square = glm::dot(x, x);
            const double apart = step / interval_;
            if (square < 1 && std::abs(apart) <= 1) addPoint(x, area * (1 - square) * (1 - apart * apart));
        }
    }

    Tensor tensor() const {
        Tensor result{};
        if (weight_ > 0)
            std::transform(sum_.begin(), sum_.end(), result.begin(), [&](double s) { return s / weight_; });
        return result;
    }

private:
    void addPoint(const glm::dvec3& x, double weight) {
        const glm::dvec3 d = x - glm::dot(x, normal_) * normal_;
        const double products[6] = {d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
        for (std::size_t i = 0; i < 6; ++i) sum_[i] += weight * products[i];
        weight_ += weight;
    }

    const mesh::ScalarMesh& mesh_;
    const std::vector<double>& areas_;
    const glm::dvec3 centre_, normal_;
    const double scalar_, perRadius_, interval_;
    Tensor sum_{};
    double weight_ = 0;
};

/// Per cell, what its level sets weigh: six times the volume in cubes of `radius`, times how many of `interval` the
/// scalar changes along a radius.
std::vector<double> levelSetAreas(const mesh::ScalarMesh& mesh, double radius, double interval) {
    std::vector<double> areas(mesh.cells.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            std::array<glm::dvec3, 4> corners;
            for (std::size_t k = 0; k < 4; ++k)
                corners[k] = (mesh.positions[mesh.cells[i][k]] - mesh.positions[mesh.cells[i][0]]) / radius;
            areas[i] = mesh::sixVolumes(corners[0], corners[1], corners[2], corners[3]) *
                       glm::length(mesh::cellGradient(mesh, static_cast<mesh::CellIndex>(i)) * (radius / interval));
        }
    });
    return areas;
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
    if (mesh.association == mesh::Association::Cell || !(radius > 0)) return tensors;
    const double interval = settings.interval * (mesh.scalarMax - mesh.scalarMin);
    const std::vector<Weights> filling = fillingPoints(settings.samples);
    const std::vector<double> areas = levelSetAreas(mesh, radius, interval);
    const mesh::CellTree tree(mesh.positions, mesh.cells);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tensors.size(), 64), [&](const auto& range) {
        for (std::size_t point = range.begin(); point != range.end(); ++point) {
            const double magnitude = glm::length(gradients[point]);
            if (!(magnitude > 0)) continue;
            Neighbourhood near(mesh, areas, static_cast<mesh::PointIndex>(point), gradients[point] / magnitude, radius,
                               interval);
            tree.forEachNear(mesh.positions[point], radius, [&](mesh::CellIndex cell) { near.add(cell, filling); });
            tensors[point] = near.tensor();
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
