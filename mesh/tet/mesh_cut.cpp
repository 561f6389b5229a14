// SPDX-License-Identifier: Apache-2.0
//
// Marching tetrahedra: A. Doi and A. Koide, An Efficient Method of Triangulating Equi-Valued Surfaces by Using
// Tetrahedral Cells, IEICE Transactions E74(1), 1991.
#include <mesh/tet/mesh_cut.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/adjacency.h>

namespace tetralux::mesh {

namespace {

glm::dvec3 placeOn(const EdgePoint& point, std::span<const glm::dvec3> positions) {
    return glm::mix(positions[point.a], positions[point.b], point.fraction);
}

/// The points of a cut, each edge's and each corner's once.
class CutPoints {
public:
    explicit CutPoints(MeshCut& cut) : cut_(cut) {}

    PointIndex of(const EdgePoint& point) {
        const auto [found, isNew] =
            numbers_.try_emplace(std::uint64_t{point.a} << 32 | point.b, static_cast<PointIndex>(cut_.points.size()));
        if (isNew) cut_.points.push_back(point);
        return found->second;
    }
    PointIndex ofCorner(PointIndex corner) { return of({corner, corner, 0.0}); }

private:
    MeshCut& cut_;
    std::unordered_map<std::uint64_t, PointIndex> numbers_;  // by the edge's two points
};

class LevelCutter {
public:
    LevelCutter(std::span<const glm::dvec3> positions, std::span<const double> heights, double level)
        : positions_(positions), heights_(heights), level_(level), points_(cut_) {}

    void add(CellIndex cell, const Tetrahedron& corners) {
        // local numbers, so that the order of the corners tells which way round they are
        std::array<std::size_t, 4> above{}, below{};
        std::size_t aboveCount = 0, belowCount = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const double height = heights_[corners[k]];
            if (!std::isfinite(height)) return;
            (height < level_ ? below[belowCount++] : above[aboveCount++]) = k;
        }
        if (aboveCount == 0 || belowCount == 0) return;
        const auto cross = [&](std::size_t a, std::size_t b) { return onEdge(corners[a], corners[b]); };
        if (aboveCount == 2) {
            // (a, b, c, d) is an even permutation of the corners or an odd one: then c and d change places
            const auto [a, b] = std::pair(above[0], above[1]);
            const bool even = (a == 0 && b != 2) || (a == 1 && b == 2) || (a == 2 && b == 3);
            const auto [c, d] = even ? std::pair(below[0], below[1]) : std::pair(below[1], below[0]);
            const PointIndex ac = cross(a, c), ad = cross(a, d), bc = cross(b, c), bd = cross(b, d);
            addTriangle(cell, {ac, ad, bd});
            addTriangle(cell, {ac, bd, bc});
        } else {
            const bool oneAbove = aboveCount == 1;
            const std::size_t tip = oneAbove ? above[0] : below[0];
            const auto& face = faceVertices[tip];  // counter-clockwise from where the tip is not
            std::array<PointIndex, 3> triangle{};
            for (std::size_t k = 0; k < 3; ++k) triangle[k] = cross(tip, static_cast<std::size_t>(face[k]));
            if (!oneAbove) std::swap(triangle[1], triangle[2]);
            addTriangle(cell, triangle);
        }
    }

    MeshCut take() { return std::move(cut_); }

private:
    /// What has become an edge or a point where the level runs through corners leaves no gap: its neighbours meet.
    void addTriangle(CellIndex cell, const std::array<PointIndex, 3>& triangle) {
        const auto& [a, b, c] = triangle;
        if (a == b || b == c || c == a) return;
        cut_.triangles.push_back(triangle);
        cut_.cells.push_back(cell);
    }

    /// The same for all cells around the edge.
    PointIndex onEdge(PointIndex a, PointIndex b) {
        const auto [low, high] = std::minmax(a, b);
        const EdgePoint point{low, high, (level_ - heights_[low]) / (heights_[high] - heights_[low])};
        const glm::dvec3 place = placeOn(point, positions_);
        if (place == positions_[low]) return points_.ofCorner(low);
        if (place == positions_[high]) return points_.ofCorner(high);
        return points_.of(point);
    }

    const std::span<const glm::dvec3> positions_;
    const std::span<const double> heights_;
    const double level_;
    MeshCut cut_;
    CutPoints points_;
};

void turnOver(MeshCut& cut) {
    for (auto& [a, b, c] : cut.triangles) std::swap(b, c);
}

}  // namespace

MeshCut cutAtLevel(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells,
                   std::span<const double> heights, double level) {
    LevelCutter cutter(positions, heights, level);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) cutter.add(static_cast<CellIndex>(cell), cells[cell]);
    return cutter.take();
}

MeshCut cutAtPlane(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells, const glm::dvec3& point,
                   const glm::dvec3& normal) {
    const auto cutFrom = [&](const glm::dvec3& unitNormal) {
        std::vector<double> heights(positions.size());
        tbb::parallel_for(std::size_t{0}, heights.size(),
                          [&](std::size_t i) { heights[i] = glm::dot(positions[i] - point, unitNormal); });
        return cutAtLevel(positions, cells, heights, 0.0);
    };
    const glm::dvec3 unit = glm::normalize(normal);
    MeshCut cut = cutFrom(unit);
    turnOver(cut);
    // a plane along the mesh's lower boundary has nothing below it: seen from the other side it has
    return cut.triangles.empty() ? cutFrom(-unit) : cut;
}

MeshCut boundaryFaces(std::span<const Tetrahedron> cells, std::size_t pointCount) {
    const Adjacency adjacency = buildAdjacency(cells, pointCount);
    MeshCut cut;
    CutPoints points(cut);
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
        for (std::size_t face = 0; face < 4; ++face) {
            if (adjacency.neighbours[cell][face] != Adjacency::noNeighbour) continue;
            std::array<PointIndex, 3> triangle{};
            for (std::size_t k = 0; k < 3; ++k)
                triangle[k] = points.ofCorner(cells[cell][static_cast<std::size_t>(faceVertices[face][k])]);
            cut.triangles.push_back(triangle);
            cut.cells.push_back(static_cast<CellIndex>(cell));
        }
    return cut;
}

std::vector<glm::dvec3> cutPositions(const MeshCut& cut, std::span<const glm::dvec3> positions) {
    std::vector<glm::dvec3> result(cut.points.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = placeOn(cut.points[i], positions);
    return result;
}

std::vector<double> cutValues(const MeshCut& cut, std::span<const double> values, int components) {
    const auto width = static_cast<std::size_t>(components);
    std::vector<double> result(cut.points.size() * width);
    for (std::size_t i = 0; i < cut.points.size(); ++i)
        for (std::size_t c = 0; c < width; ++c) {
            const auto& [a, b, fraction] = cut.points[i];
            const double atA = values[a * width + c];
            result[i * width + c] = a == b ? atA : std::lerp(atA, values[b * width + c], fraction);
        }
    return result;
}

}  // namespace tetralux::mesh
