// SPDX-License-Identifier: Apache-2.0
#include <shading/level_set_points.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/vertex_buckets.h>

namespace tetralux::shading {

namespace {

using Weights = std::array<double, 4>;

struct Point {
    float scalar, x, y, z, area;
    std::uint64_t item;  ///< cell and number within it: settles the order of equal scalars
};

/// Per cell |∇s|·V, in intervals, radii and cubes of radii, up to a factor.
std::vector<float> levelSetAreas(const mesh::ScalarMesh& mesh, double perRadius, double perInterval) {
    std::vector<float> areas(mesh.cells.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            std::array<glm::dvec3, 4> corners;
            for (std::size_t k = 0; k < 4; ++k)
                corners[k] = (mesh.positions[mesh.cells[i][k]] - mesh.positions[mesh.cells[i][0]]) * perRadius;
            const double volume = mesh::sixVolumes(corners[0], corners[1], corners[2], corners[3]);
            const glm::dvec3 gradient = mesh::cellGradient(mesh, static_cast<mesh::CellIndex>(i));
            areas[i] = static_cast<float>(volume * glm::length(gradient * (perInterval / perRadius)));
        }
    });
    return areas;
}

}  // namespace

std::vector<Weights> fillingPoints(int count) {
    constexpr double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    std::vector<Weights> points;
    if (count == 4) {
        Weights weights;
        for (std::size_t i = 0; i < 4; ++i) {
            weights.fill((5 - std::sqrt(5.0)) / 20);
            weights[i] = (5 + 3 * std::sqrt(5.0)) / 20;
            points.push_back(weights);
        }
        return points;
    }
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

LevelSetPoints::LevelSetPoints(const mesh::ScalarMesh& mesh, double radius, double interval, int pointsPerCell)
    : perRadius_(1 / radius), perInterval_(1 / interval), origin_(mesh.bounds.low) {
    scalarOrigin_ = 0.5 * mesh.scalarMin + 0.5 * mesh.scalarMax;
    layCubes(mesh);
    const std::vector<Weights> filling = fillingPoints(pointsPerCell);
    const std::size_t perCell = filling.size(), count = mesh.cells.size() * perCell;
    const auto placeOfItem = [&](std::size_t item) {
        const mesh::Tetrahedron& corners = mesh.cells[item / perCell];
        const Weights& w = filling[item % perCell];
        glm::dvec3 sum(0);
        for (std::size_t k = 0; k < 4; ++k) sum += w[k] * ((mesh.positions[corners[k]] - origin_) * perRadius_);
        return sum;
    };
    const auto scalarOfItem = [&](std::size_t item) {
        const mesh::Tetrahedron& corners = mesh.cells[item / perCell];
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
            sum += filling[item % perCell][k] * ((mesh.scalars[corners[k]] - scalarOrigin_) * perInterval_);
        return static_cast<float>(sum);
    };
    const std::size_t cubes = counts_[0] * counts_[1] * counts_[2];
    const mesh::VertexBuckets<std::uint64_t> buckets(
        count, cubes, [&](std::size_t item) { return cubeOf(placeOf(placeOfItem(item))); });
    const std::vector<float> areas = levelSetAreas(mesh, perRadius_, perInterval_);

    starts_.resize(cubes + 1);
    for (auto* values : {&x_, &y_, &z_, &scalars_, &areas_}) values->resize(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cubes, 16), [&](const auto& range) {
        std::vector<Point> points;
        for (std::size_t cube = range.begin(); cube != range.end(); ++cube) {
            const std::size_t first = buckets.begin(cube), last = buckets.end(cube);
            points.clear();
            for (std::size_t slot = first; slot < last; ++slot) {
                const std::uint64_t item = buckets.item(slot);
                const glm::dvec3 from = placeOfItem(item);
                const Place place = placeOf(from);
                const glm::vec3 at(from - side_ * glm::dvec3(place[0], place[1], place[2]));
                points.push_back({scalarOfItem(item), at.x, at.y, at.z, areas[item / perCell], item});
            }
            std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
                return a.scalar != b.scalar ? a.scalar < b.scalar : a.item < b.item;
            });
            for (std::size_t i = 0; i < points.size(); ++i) {
                x_[first + i] = points[i].x;
                y_[first + i] = points[i].y;
                z_[first + i] = points[i].z;
                scalars_[first + i] = points[i].scalar;
                areas_[first + i] = points[i].area;
            }
            starts_[cube + 1] = last;
        }
    });
}

/// Half a radius, so that the cubes about a ball are not much more than the ball; more where that would be more cubes
/// than cells (a mesh with a few fine parts).
void LevelSetPoints::layCubes(const mesh::ScalarMesh& mesh) {
    const glm::dvec3 size = (mesh.bounds.high - mesh.bounds.low) * perRadius_;
    const double most = std::max<double>(64.0, static_cast<double>(mesh.cells.size()));
    const auto along = [&](int axis) { return std::floor(size[axis] / side_) + 1; };
    while (along(0) * along(1) * along(2) > most) side_ *= 1.25;
    for (int axis = 0; axis < 3; ++axis)
        counts_[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(along(axis));
}

/// `fromOrigin` in radii; what lies outside belongs to the cube nearest to it.
LevelSetPoints::Place LevelSetPoints::placeOf(const glm::dvec3& fromOrigin) const {
    Place place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = std::floor(fromOrigin[static_cast<int>(axis)] / side_);
        place[axis] = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(counts_[axis] - 1)));
    }
    return place;
}

PointMoments LevelSetPoints::near(const glm::dvec3& centre, double scalar) const {
    const glm::dvec3 from = (centre - origin_) * perRadius_;
    const auto step = static_cast<float>((scalar - scalarOrigin_) * perInterval_);
    const Place low = placeOf(from - 1.0), high = placeOf(from + 1.0);
    PointMoments sums;
    for (std::size_t k = low[2]; k <= high[2]; ++k)
        for (std::size_t j = low[1]; j <= high[1]; ++j)
            for (std::size_t i = low[0]; i <= high[0]; ++i) {
                const glm::dvec3 fromCube = from - side_ * glm::dvec3(i, j, k);
                const glm::dvec3 beside = glm::max(glm::max(-fromCube, fromCube - side_), glm::dvec3(0));
                if (glm::dot(beside, beside) < 1) addCube(cubeOf({i, j, k}), fromCube, step, sums);
            }
    return sums;
}

void LevelSetPoints::addCube(std::size_t cube, const glm::dvec3& centreFromCube, float scalar,
                             PointMoments& sums) const {
    const auto begin = scalars_.begin() + static_cast<std::ptrdiff_t>(starts_[cube]),
               end = scalars_.begin() + static_cast<std::ptrdiff_t>(starts_[cube + 1]);
    const auto from = std::lower_bound(begin, end, scalar - 1.0f), to = std::upper_bound(from, end, scalar + 1.0f);
    const auto first = static_cast<std::size_t>(from - scalars_.begin());
    const auto count = static_cast<std::size_t>(to - from);
    const float *xs = x_.data() + first, *ys = y_.data() + first, *zs = z_.data() + first;
    const float *scalars = scalars_.data() + first, *areas = areas_.data() + first;
    const glm::vec3 centre(centreFromCube);
    float weight = 0, xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
#pragma omp simd reduction(+ : weight, xx, yy, zz, xy, xz, yz)
    for (std::size_t i = 0; i < count; ++i) {
        const float x = xs[i] - centre.x, y = ys[i] - centre.y, z = zs[i] - centre.z, apart = scalars[i] - scalar;
        const float inside = 1.0f - (x * x + y * y + z * z), alike = 1.0f - apart * apart;
        const float w = areas[i] * (inside > 0.0f ? inside : 0.0f) * (alike > 0.0f ? alike : 0.0f);
        weight += w;
        xx += w * x * x;
        yy += w * y * y;
        zz += w * z * z;
        xy += w * x * y;
        xz += w * x * z;
        yz += w * y * z;
    }
    sums.weight += static_cast<double>(weight);
    sums.xx += static_cast<double>(xx);
    sums.yy += static_cast<double>(yy);
    sums.zz += static_cast<double>(zz);
    sums.xy += static_cast<double>(xy);
    sums.xz += static_cast<double>(xz);
    sums.yz += static_cast<double>(yz);
}

}  // namespace tetralux::shading
