// SPDX-License-Identifier: Apache-2.0
#include <shading/level_set_points.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <mesh/tet/vertex_buckets.h>
#include <shading/widest.h>

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
    : cubes_(mesh, radius), perRadius_(1 / radius), perInterval_(1 / interval) {
    scalarOrigin_ = 0.5 * mesh.scalarMin + 0.5 * mesh.scalarMax;
    layPoints(mesh, pointsPerCell);
}

void LevelSetPoints::layPoints(const mesh::ScalarMesh& mesh, int pointsPerCell) {
    const std::vector<Weights> filling = fillingPoints(pointsPerCell);
    const std::size_t perCell = filling.size();
    const auto placeOfItem = [&](std::size_t item) {
        const mesh::Tetrahedron& corners = mesh.cells[item / perCell];
        const Weights& w = filling[item % perCell];
        glm::dvec3 sum(0);
        for (std::size_t k = 0; k < 4; ++k) sum += w[k] * cubes_.fromOrigin(mesh.positions[corners[k]]);
        return sum;
    };
    const auto scalarOfItem = [&](std::size_t item) {
        const mesh::Tetrahedron& corners = mesh.cells[item / perCell];
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
            sum += filling[item % perCell][k] * ((mesh.scalars[corners[k]] - scalarOrigin_) * perInterval_);
        return static_cast<float>(sum);
    };
    const mesh::VertexBuckets<std::uint64_t> buckets(
        mesh.cells.size() * perCell, cubes_.count(),
        [&](std::size_t item) { return cubes_.cubeOf(cubes_.placeOf(placeOfItem(item))); });
    const std::vector<float> areas = levelSetAreas(mesh, perRadius_, perInterval_);

    starts_.assign(cubes_.count() + 1, 0);
    for (std::size_t cube = 0; cube < cubes_.count(); ++cube)
        starts_[cube + 1] = starts_[cube] + (buckets.end(cube) - buckets.begin(cube) + blockSize - 1) / blockSize;
    heads_.resize(starts_.back());
    for (auto* values : {&x_, &y_, &z_, &scalars_, &areas_}) values->resize(starts_.back() * blockSize);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cubes_.count(), 16), [&](const auto& range) {
        std::vector<Point> points;
        for (std::size_t cube = range.begin(); cube != range.end(); ++cube) {
            points.clear();
            for (std::size_t slot = buckets.begin(cube); slot < buckets.end(cube); ++slot) {
                const std::uint64_t item = buckets.item(slot);
                const glm::dvec3 from = placeOfItem(item);
                const glm::vec3 at(from - cubes_.corner(cubes_.placeOf(from)));
                points.push_back({scalarOfItem(item), at.x, at.y, at.z, areas[item / perCell], item});
            }
            std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
                return a.scalar != b.scalar ? a.scalar < b.scalar : a.item < b.item;
            });
            if (points.empty()) continue;
            Point none = points.back();
            none.area = 0;
            points.resize((starts_[cube + 1] - starts_[cube]) * blockSize, none);
            const std::size_t first = starts_[cube] * blockSize;
            for (std::size_t i = 0; i < points.size(); ++i) {
                x_[first + i] = points[i].x;
                y_[first + i] = points[i].y;
                z_[first + i] = points[i].z;
                scalars_[first + i] = points[i].scalar;
                areas_[first + i] = points[i].area;
                if (i % blockSize == 0) heads_[starts_[cube] + i / blockSize] = points[i].scalar;
            }
        }
    });
}

/// Some blocks of one cube, and where in it the centre is.
struct LevelSetPoints::Run {
    std::size_t first, count;  ///< points
    float x, y, z, scalar;
};

/// Calls `use` for the cubes within the radius, or for those of them that are black on a chessboard: all blocks with
/// points whose scalar is within the interval.
template <bool EverySecond, class Use>
void LevelSetPoints::forRuns(const glm::dvec3& centre, double scalar, float interval, const Use& use) const {
    const glm::dvec3 from = cubes_.fromOrigin(centre);
    const auto step = static_cast<float>((scalar - scalarOrigin_) * perInterval_);
    const float least = step - interval, most = step + interval;
    cubes_.forRows(from - 1.0, from + 1.0, [&](BallCubes::Place place, const BallCubes::Place& last) {
        for (; place[0] <= last[0]; ++place[0]) {
            if (EverySecond && (place[0] + place[1] + place[2]) % 2 != 0) continue;
            const glm::dvec3 fromCube = from - cubes_.corner(place);
            const glm::dvec3 beside = glm::max(glm::max(-fromCube, fromCube - cubes_.side()), glm::dvec3(0));
            if (!(glm::dot(beside, beside) < 1)) continue;
            const std::size_t cube = cubes_.cubeOf(place), begin = starts_[cube], end = starts_[cube + 1];
            const float* heads = heads_.data();
            int below = 0, upTo = 0;
#pragma omp simd reduction(+ : below, upTo)
            for (std::size_t i = begin; i < end; ++i) {
                below += heads[i] < least ? 1 : 0;
                upTo += heads[i] <= most ? 1 : 0;
            }
            const int skipped = std::max(below - 1, 0);
            if (upTo == skipped) continue;
            use(Run{(begin + static_cast<std::size_t>(skipped)) * blockSize,
                    static_cast<std::size_t>(upTo - skipped) * blockSize, static_cast<float>(fromCube.x),
                    static_cast<float>(fromCube.y), static_cast<float>(fromCube.z), step});
        }
    });
}

inline PointMoments LevelSetPoints::nearHere(const glm::dvec3& centre, double scalar) const {
    PointMoments sums;
    forRuns<false>(centre, scalar, 1.0f, [&](const Run& run) {
        const float *xs = x_.data() + run.first, *ys = y_.data() + run.first, *zs = z_.data() + run.first;
        const float *scalars = scalars_.data() + run.first, *areas = areas_.data() + run.first;
        float weight = 0, squares = 0, xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
#pragma omp simd reduction(+ : weight, squares, xx, yy, zz, xy, xz, yz)
        for (std::size_t i = 0; i < run.count; ++i) {
            const float x = xs[i] - run.x, y = ys[i] - run.y, z = zs[i] - run.z, apart = scalars[i] - run.scalar;
            const float inside = 1.0f - (x * x + y * y + z * z), alike = 1.0f - apart * apart;
            const float w = areas[i] * (inside > 0.0f ? inside : 0.0f) * (alike > 0.0f ? alike : 0.0f);
            weight += w;
            squares += w * w;
            xx += w * x * x;
            yy += w * y * y;
            zz += w * z * z;
            xy += w * x * y;
            xz += w * x * z;
            yz += w * y * z;
        }
        sums.weight += static_cast<double>(weight);
        sums.squares += static_cast<double>(squares);
        sums.xx += static_cast<double>(xx);
        sums.yy += static_cast<double>(yy);
        sums.zz += static_cast<double>(zz);
        sums.xy += static_cast<double>(xy);
        sums.xz += static_cast<double>(xz);
        sums.yz += static_cast<double>(yz);
    });
    return sums;
}

inline Bend LevelSetPoints::bendHere(const glm::dvec3& centre, double scalar, const std::array<glm::dvec3, 3>& frame,
                                     double slope) const {
    constexpr float quarter = 0.25f, perQuarter = 4.0f;
    const glm::vec3 a(frame[0]), b(frame[1]), c(frame[2]);
    const auto perSlope = static_cast<float>(1 / slope);
    glm::dmat3 matrix(0);
    glm::dvec3 right(0);
    double sum = 0;
    forRuns<true>(centre, scalar, quarter, [&](const Run& run) {
        const float *xs = x_.data() + run.first, *ys = y_.data() + run.first, *zs = z_.data() + run.first;
        const float *scalars = scalars_.data() + run.first, *areas = areas_.data() + run.first;
        float weight = 0, xxxx = 0, xxxy = 0, xxyy = 0, xyyy = 0, yyyy = 0, xxz = 0, xyz = 0, yyz = 0;
#pragma omp simd reduction(+ : weight, xxxx, xxxy, xxyy, xyyy, yyyy, xxz, xyz, yyz)
        for (std::size_t i = 0; i < run.count; ++i) {
            const float dx = xs[i] - run.x, dy = ys[i] - run.y, dz = zs[i] - run.z;
            const float apart = scalars[i] - run.scalar, share = apart * perQuarter;
            const float x = dx * a.x + dy * a.y + dz * a.z, y = dx * b.x + dy * b.y + dz * b.z;
            const float z = dx * c.x + dy * c.y + dz * c.z - apart * perSlope;
            const float inside = 1.0f - (dx * dx + dy * dy + dz * dz), alike = 1.0f - share * share;
            const float beside = 1.0f - 4.0f * z * z;  // other sheets of the level set do not count
            const float w = areas[i] * (inside > 0.0f ? inside : 0.0f) * (alike > 0.0f ? alike : 0.0f) *
                            (beside > 0.0f ? beside : 0.0f);
            const float xx = x * x, xy = x * y, yy = y * y, wx = w * xx, wy = w * yy, wz = w * z;
            weight += w;
            xxxx += wx * xx;
            xxxy += wx * xy;
            xxyy += wx * yy;
            xyyy += wy * xy;
            yyyy += wy * yy;
            xxz += wz * xx;
            xyz += wz * xy;
            yyz += wz * yy;
        }
        sum += static_cast<double>(weight);
        matrix[0] += glm::dvec3(xxxx, xxyy, xxxy);
        matrix[1] += glm::dvec3(xxyy, yyyy, xyyy);
        matrix[2] += glm::dvec3(xxxy, xyyy, xxyy);
        right += glm::dvec3(xxz, yyz, xyz);
    });
    if (!(sum > 0)) return {};
    constexpr double ridge = 1e-3;  // of ρ⁴: where there are few points, a plane
    for (int i = 0; i < 3; ++i) matrix[i][i] += ridge * sum;
    const glm::dvec3 found = glm::inverse(matrix) * right;
    const auto bounded = [](double bend) { return std::clamp(bend, -1.0, 1.0); };  // no circle within the ball
    return {bounded(2 * found.x), bounded(2 * found.y), bounded(found.z)};
}

TETRALUX_WIDE PointMoments LevelSetPoints::nearWide(const glm::dvec3& centre, double scalar) const {
    return nearHere(centre, scalar);
}

PointMoments LevelSetPoints::near(const glm::dvec3& centre, double scalar) const {
    return hasWideVectors() ? nearWide(centre, scalar) : nearHere(centre, scalar);
}

TETRALUX_WIDE Bend LevelSetPoints::bendWide(const glm::dvec3& centre, double scalar,
                                            const std::array<glm::dvec3, 3>& frame, double slope) const {
    return bendHere(centre, scalar, frame, slope);
}

Bend LevelSetPoints::bendNear(const glm::dvec3& centre, double scalar, const std::array<glm::dvec3, 3>& frame,
                              double slope) const {
    return hasWideVectors() ? bendWide(centre, scalar, frame, slope) : bendHere(centre, scalar, frame, slope);
}

}  // namespace tetralux::shading
