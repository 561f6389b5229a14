// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/coarse_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include <mesh/tet/procedural_field.h>

namespace tetralux::mesh {

namespace {

constexpr double outside = std::numeric_limits<double>::quiet_NaN();

/// The grid's scalars, filled in cell by cell.
class GridScalars {
public:
    GridScalars(const ScalarMesh& mesh, int n)
        : mesh_(mesh),
          n_(n),
          spacing_(glm::max((mesh.bounds.high - mesh.bounds.low) / static_cast<double>(n - 1), glm::dvec3(1e-300))),
          values(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n), outside) {}

    /// Sets the scalar at every grid point within the cell.
    void add(CellIndex cell) {
        std::array<glm::dvec3, 4> corner;  // in units of the spacing
        for (std::size_t k = 0; k < 4; ++k)
            corner[k] = (mesh_.positions[mesh_.cells[cell][k]] - mesh_.bounds.low) / spacing_;
        const double whole = sixVolumes(corner[0], corner[1], corner[2], corner[3]);
        if (!(whole > 0)) return;
        const glm::dvec3 low = glm::min(glm::min(corner[0], corner[1]), glm::min(corner[2], corner[3]));
        const glm::dvec3 high = glm::max(glm::max(corner[0], corner[1]), glm::max(corner[2], corner[3]));
        for (int z = first(low.z); z <= last(high.z); ++z)
            for (int y = first(low.y); y <= last(high.y); ++y)
                for (int x = first(low.x); x <= last(high.x); ++x) setWithin(cell, corner, whole, {x, y, z});
    }

private:
    static constexpr double hair = 1e-9;  // spacings: points on the mesh's boundary belong to it
    static int first(double low) { return static_cast<int>(std::max(0.0, std::ceil(low - hair))); }
    int last(double high) const { return static_cast<int>(std::min(n_ - 1.0, std::floor(high + hair))); }

    void setWithin(CellIndex cell, const std::array<glm::dvec3, 4>& corner, double whole, const glm::ivec3& point) {
        double scalar = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            std::array<glm::dvec3, 4> part = corner;
            part[k] = glm::dvec3(point);
            const double weight = sixVolumes(part[0], part[1], part[2], part[3]) / whole;
            if (weight < -hair) return;
            scalar += weight * mesh_.scalarAt(cell, static_cast<int>(k));
        }
        const auto n = static_cast<std::size_t>(n_);
        values[(static_cast<std::size_t>(point.z) * n + static_cast<std::size_t>(point.y)) * n +
               static_cast<std::size_t>(point.x)] = scalar;
    }

    const ScalarMesh& mesh_;
    int n_;
    glm::dvec3 spacing_;

public:
    std::vector<double> values;  // x fastest; NaN outside the mesh
};

}  // namespace

ScalarMesh coarseMesh(const ScalarMesh& mesh, int n) {
    GridScalars scalars(mesh, n);
    for (CellIndex cell = 0; cell < mesh.cells.size(); ++cell) scalars.add(cell);

    TetMesh grid = sampleOnGrid({"coarse mesh", "s", mesh.bounds, [](const glm::dvec3&) { return 0.0; }, {}}, n);
    ScalarMesh coarse;
    coarse.positions = std::move(grid.positions);
    coarse.scalars = std::move(scalars.values);
    coarse.scalarMin = mesh.scalarMin;
    coarse.scalarMax = mesh.scalarMax;
    for (const Tetrahedron& cell : grid.cells)
        if (std::none_of(cell.begin(), cell.end(), [&](PointIndex p) { return std::isnan(coarse.scalars[p]); }))
            coarse.cells.push_back(cell);
    std::replace_if(
        coarse.scalars.begin(), coarse.scalars.end(), [](double s) { return std::isnan(s); }, mesh.scalarMin);
    coarse.bounds = usedBounds(coarse.positions, coarse.cells);
    return coarse;
}

}  // namespace tetralux::mesh
