// SPDX-License-Identifier: Apache-2.0
#include <projection/order/power_order.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <projection/core/gathered.h>
#include <projection/order/grid_heights.h>

namespace tetralux::projection {

namespace {

/// Rounds of relaxation before what is left counts as failing.
constexpr int mostRounds = 40;

/// How far above the neighbour's continued function a vertex is moved, in squared lengths of the shortest edge at the
/// face: enough for keys of 32 bits to tell the cells apart.
constexpr double wantedMargin = 0.02;

/// Share of the wanted margin that is good enough, and the rounding that no margin may drown in.
constexpr double sufficientShare = 0.25, roundingBound = 1e-12;

/// One inner face's condition: height[apex] − Σ weight[k]·height[cell point k] ≥ margin.
struct FaceCondition {
    std::array<mesh::PointIndex, 5> points;  // the cell's four, then the apex of its neighbour
    std::array<double, 5> weights;           // −λ_k(apex), 1
    double margin;                           // wanted, squared mesh diagonals
    double least;                            // what must be kept beyond rounding

    double excess(const std::vector<double>& heights) const {
        double sum = 0;
        for (std::size_t k = 0; k < 5; ++k) sum += weights[k] * heights[points[k]];
        return sum;
    }
};

class Conditions {
public:
    Conditions(const mesh::ScalarMesh& mesh, const mesh::Adjacency& adjacency)
        : mesh_(mesh), adjacency_(adjacency), scale_(mesh.bounds.diagonal() > 0 ? 1.0 / mesh.bounds.diagonal() : 1.0) {}

    std::size_t faceCount() const { return 4 * mesh_.cells.size(); }

    /// Position in mesh diagonals about the centre of the bounds.
    glm::dvec3 scaled(mesh::PointIndex p) const { return (mesh_.positions[p] - mesh_.bounds.centre()) * scale_; }

    /// True for the faces that carry a condition: inner ones, once.
    bool applies(std::size_t face) const {
        const mesh::CellIndex other = adjacency_.neighbours[face / 4][face % 4];
        return other != mesh::Adjacency::noNeighbour && face / 4 < other;
    }

    FaceCondition at(std::size_t face) const {
        const auto cell = static_cast<mesh::CellIndex>(face / 4);
        const mesh::Tetrahedron& points = mesh_.cells[cell];
        FaceCondition condition;
        std::copy(points.begin(), points.end(), condition.points.begin());
        condition.points[4] = apexOf(adjacency_.neighbours[cell][face % 4], cell);

        const glm::dvec3 a = scaled(points[0]);
        const glm::dvec3 ab = scaled(points[1]) - a, ac = scaled(points[2]) - a, ad = scaled(points[3]) - a,
                         ap = scaled(condition.points[4]) - a;
        const double inverse = 1.0 / glm::dot(ab, glm::cross(ac, ad));
        const double b = glm::dot(ap, glm::cross(ac, ad)) * inverse, c = glm::dot(ap, glm::cross(ad, ab)) * inverse,
                     d = glm::dot(ap, glm::cross(ab, ac)) * inverse;
        condition.weights = {-(1.0 - b - c - d), -b, -c, -d, 1.0};
        const glm::dvec3 bc = ac - ab, bd = ad - ab, cd = ad - ac;
        const double shortest = std::min({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ad, ad), glm::dot(bc, bc),
                                          glm::dot(bd, bd), glm::dot(cd, cd)});
        condition.margin = wantedMargin * shortest;
        double magnitude = 0;
        for (double w : condition.weights) magnitude += std::abs(w);
        condition.least = std::max(sufficientShare * condition.margin, roundingBound * magnitude);
        return condition;
    }

    /// Faces whose condition does not hold well enough, in ascending order.
    std::vector<std::size_t> failing(const std::vector<double>& heights) const {
        auto all = gathered<std::size_t>(faceCount(), [&](std::size_t face, auto& found) {
            if (!applies(face)) return;
            const FaceCondition condition = at(face);
            if (!(condition.excess(heights) >= condition.least)) found.push_back(face);
        });
        std::sort(all.begin(), all.end());
        return all;
    }

private:
    /// The vertex of `cell` that it does not share with `neighbour`.
    mesh::PointIndex apexOf(mesh::CellIndex cell, mesh::CellIndex neighbour) const {
        for (std::size_t k = 0; k < 4; ++k)
            if (adjacency_.neighbours[cell][k] == neighbour) return mesh_.cells[cell][k];
        return mesh_.cells[cell][0];
    }

    const mesh::ScalarMesh& mesh_;
    const mesh::Adjacency& adjacency_;
    double scale_;
};

/// Moves the heights of the five points by the least amount that gives the condition its margin.
void satisfy(const FaceCondition& condition, std::vector<double>& heights) {
    double norm = 0;
    for (double w : condition.weights) norm += w * w;
    const double step = (condition.margin - condition.excess(heights)) / norm;
    if (!(step > 0) || !std::isfinite(step)) return;
    for (std::size_t k = 0; k < 5; ++k) heights[condition.points[k]] += step * condition.weights[k];
}

}  // namespace

namespace {

/// Of a grid, the heights that it has by construction if they hold at every face; else |x|², for a start.
struct FirstHeights {
    std::vector<double> heights;
    std::vector<std::size_t> failing;

    FirstHeights(const mesh::ScalarMesh& mesh, const Conditions& conditions) {
        std::vector<glm::dvec3> points(mesh.positions.size());
        for (std::size_t p = 0; p < points.size(); ++p) points[p] = conditions.scaled(static_cast<mesh::PointIndex>(p));
        if (!mesh.cells.empty()) {
            if (std::optional<std::vector<double>> ofGrid = gridHeights(points, mesh.cells[0])) {
                failing = conditions.failing(*ofGrid);
                if (failing.empty()) {
                    heights = std::move(*ofGrid);
                    return;
                }
            }
        }
        for (const glm::dvec3& x : points) heights.push_back(glm::dot(x, x));
        failing = conditions.failing(heights);
    }
};

}  // namespace

PowerOrder::PowerOrder(const mesh::ScalarMesh& mesh, const mesh::Adjacency& adjacency) {
    const Conditions conditions(mesh, adjacency);
    FirstHeights first(mesh, conditions);
    heights_ = std::move(first.heights);
    std::vector<std::size_t> failing = std::move(first.failing);
    for (int round = 0; round < mostRounds && !failing.empty(); ++round) {
        for (std::size_t face : failing) satisfy(conditions.at(face), heights_);
        const std::size_t before = failing.size();
        failing = conditions.failing(heights_);
        if (round > 8 && failing.size() > before - before / 50)
            break;  // no longer getting better: no such heights exist
    }
    failingFaces_ = failing.size();
}

namespace {

using std::max, std::min;
using wide = double;
#define TETRALUX_CELL_FUNCTION inline
#include <projection/order/order_position.glsl>
#undef TETRALUX_CELL_FUNCTION

}  // namespace

std::uint32_t orderedKey(double key, double nearest, double farthest) {
    return static_cast<std::uint32_t>(orderPosition(key, nearest, farthest));
}

namespace {

constexpr unsigned digitBits = 11;
constexpr std::size_t digits = std::size_t{1} << digitBits;
using Histogram = std::array<std::uint32_t, digits>;

}  // namespace

void radixSort(std::vector<KeyedCell>& cells, std::vector<KeyedCell>& scratch) {
    scratch.resize(cells.size());
    constexpr std::size_t blockSize = std::size_t{1} << 16;
    const std::size_t blocks = (cells.size() + blockSize - 1) / blockSize;
    std::vector<Histogram> places(blocks);
    for (unsigned shift = 0; shift < 32; shift += digitBits) {
        auto digitOf = [shift](const KeyedCell& c) { return (c.key >> shift) & (digits - 1); };
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
            places[block].fill(0);
            const std::size_t end = std::min(cells.size(), (block + 1) * blockSize);
            for (std::size_t i = block * blockSize; i < end; ++i) ++places[block][digitOf(cells[i])];
        });
        std::uint32_t start = 0;
        for (std::size_t digit = 0; digit < digits; ++digit)
            for (std::size_t block = 0; block < blocks; ++block) {
                const std::uint32_t count = places[block][digit];
                places[block][digit] = start;
                start += count;
            }
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
            const std::size_t end = std::min(cells.size(), (block + 1) * blockSize);
            for (std::size_t i = block * blockSize; i < end; ++i)
                scratch[places[block][digitOf(cells[i])]++] = cells[i];
        });
        cells.swap(scratch);
    }
}

}  // namespace tetralux::projection
