// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/tet_mesh.h>

#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <glm/geometric.hpp>

#include <mesh/tet/cell_slope.h>
#include <mesh/tet/shared_mark.h>

namespace tetralux::mesh {

double BoundingBox::diagonal() const {
    return glm::length(high - low);
}

double sixVolumes(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

std::vector<std::uint8_t> usedPoints(std::span<const Tetrahedron> cells, std::size_t pointCount) {
    std::vector<std::uint8_t> used(pointCount, 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 16384),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              for (const PointIndex p : cells[i]) {
                                  setMark(used[p]);
                              }
                          }
                      });
    return used;
}

BoundingBox usedBounds(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells) {
    return cells.empty() ? BoundingBox{} : usedBounds(positions, usedPoints(cells, positions.size()));
}

BoundingBox usedBounds(std::span<const glm::dvec3> positions, const std::vector<std::uint8_t>& used) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const BoundingBox nothing{glm::dvec3(infinity), glm::dvec3(-infinity)};
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, positions.size(), 16384), nothing,
        [&](const tbb::blocked_range<std::size_t>& range, BoundingBox box) {
            for (std::size_t p = range.begin(); p != range.end(); ++p) {
                if (used[p] != 0) {
                    box.low = glm::min(box.low, positions[p]);
                    box.high = glm::max(box.high, positions[p]);
                }
            }
            return box;
        },
        [](const BoundingBox& a, const BoundingBox& b) {
            return BoundingBox{glm::min(a.low, b.low), glm::max(a.high, b.high)};
        });
}

glm::dvec3 cellGradient(const ScalarMesh& mesh, CellIndex cell) {
    const CellSlope slope = cellSlope(mesh, cell);
    return slope.magnitude * slope.normal;
}

}  // namespace tetralux::mesh
