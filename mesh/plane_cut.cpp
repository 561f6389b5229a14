// SPDX-License-Identifier: Apache-2.0
#include <mesh/plane_cut.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::mesh {

namespace {

/// Cuts cell by cell; what lies exactly on the plane counts as above it, everywhere alike.
class PlaneCutter {
public:
    PlaneCutter(const ScalarMesh& mesh, std::vector<double> heights) : mesh_(mesh), heights_(std::move(heights)) {
        cut_.association = mesh.association;
    }

    void add(CellIndex cell) {
        const Tetrahedron& corners = mesh_.cells[cell];
        std::array<PointIndex, 4> above{}, below{};
        std::size_t aboveCount = 0, belowCount = 0;
        for (const PointIndex corner : corners)
            (heights_[corner] >= 0 ? above[aboveCount++] : below[belowCount++]) = corner;
        if (aboveCount == 0 || belowCount == 0) return;
        if (aboveCount == 2) {
            const PointIndex ac = onEdge(above[0], below[0]), ad = onEdge(above[0], below[1]),
                             bc = onEdge(above[1], below[0]), bd = onEdge(above[1], below[1]);
            addTriangle(cell, {ac, ad, bd});
            addTriangle(cell, {ac, bd, bc});
        } else {
            const bool single = aboveCount == 1;
            const PointIndex tip = single ? above[0] : below[0];
            const auto& base = single ? below : above;
            addTriangle(cell, {onEdge(tip, base[0]), onEdge(tip, base[1]), onEdge(tip, base[2])});
        }
    }

    SurfaceMesh take() { return std::move(cut_); }

private:
    void addTriangle(CellIndex cell, const std::array<PointIndex, 3>& triangle) {
        cut_.triangles.push_back(triangle);
        if (mesh_.association == Association::Cell) cut_.scalars.push_back(mesh_.scalars[cell]);
    }

    /// The point where the plane cuts the edge, the same for all cells around it.
    PointIndex onEdge(PointIndex a, PointIndex b) {
        const auto [low, high] = std::minmax(a, b);
        const auto [found, isNew] =
            points_.try_emplace(std::uint64_t{low} << 32 | high, static_cast<PointIndex>(cut_.positions.size()));
        if (isNew) {
            const double fraction = heights_[low] / (heights_[low] - heights_[high]);
            cut_.positions.push_back(glm::mix(mesh_.positions[low], mesh_.positions[high], fraction));
            if (mesh_.association == Association::Point)
                cut_.scalars.push_back(std::lerp(mesh_.scalars[low], mesh_.scalars[high], fraction));
        }
        return found->second;
    }

    const ScalarMesh& mesh_;
    std::vector<double> heights_;                           // of the mesh's points above the plane
    std::unordered_map<std::uint64_t, PointIndex> points_;  // by edge
    SurfaceMesh cut_;
};

SurfaceMesh cutAt(const ScalarMesh& mesh, const glm::dvec3& point, const glm::dvec3& unitNormal) {
    std::vector<double> heights(mesh.positions.size());
    tbb::parallel_for(std::size_t{0}, heights.size(),
                      [&](std::size_t i) { heights[i] = glm::dot(mesh.positions[i] - point, unitNormal); });
    PlaneCutter cutter(mesh, std::move(heights));
    for (CellIndex cell = 0; cell < mesh.cells.size(); ++cell) cutter.add(cell);
    return cutter.take();
}

}  // namespace

SurfaceMesh cutByPlane(const ScalarMesh& mesh, const glm::dvec3& point, const glm::dvec3& normal) {
    const glm::dvec3 unit = glm::normalize(normal);
    SurfaceMesh cut = cutAt(mesh, point, unit);
    // a plane along the mesh's lower boundary has nothing below it: seen from the other side it has
    return cut.triangles.empty() ? cutAt(mesh, point, -unit) : cut;
}

}  // namespace tetralux::mesh
