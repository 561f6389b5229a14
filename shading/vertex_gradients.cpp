// SPDX-License-Identifier: Apache-2.0
#include <shading/vertex_gradients.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace tetralux::shading {

namespace {

/// Below this determinant of the normal equations (whose trace is made 1) neighbours lie in a plane.
constexpr double leastDeterminant = 1e-9;

struct Units {
    double perLength, perScalar;
};

/// Normal equations Σ w d dᵀ g = Σ w d Δs of one point.
struct NormalEquations {
    glm::dmat3 matrix{0};
    glm::dvec3 right{0};

    void add(const glm::dvec3& offset, double step) {
        const double square = glm::dot(offset, offset);
        if (!(square > 0)) return;
        matrix += glm::outerProduct(offset, offset) / square;
        right += offset * (step / square);
    }
};

glm::dvec3 meanOfCells(const mesh::ScalarMesh& mesh, std::span<const mesh::CellIndex> cells, const Units& units) {
    glm::dvec3 sum(0);
    double volume = 0;
    for (const mesh::CellIndex cell : cells) {
        std::array<glm::dvec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[mesh.cells[cell][k]] * units.perLength;
        const double weight = mesh::sixVolumes(p[0], p[1], p[2], p[3]);
        sum += weight * (mesh::cellGradient(mesh, cell) * (units.perScalar / units.perLength));
        volume += weight;
    }
    return volume > 0 ? sum / volume : glm::dvec3(0);
}

glm::dvec3 gradientAt(const mesh::ScalarMesh& mesh, mesh::PointIndex point, std::span<const mesh::CellIndex> cells,
                      const Units& units) {
    NormalEquations equations;
    for (const mesh::CellIndex cell : cells)
        for (const mesh::PointIndex other : mesh.cells[cell])
            if (other != point)
                equations.add((mesh.positions[other] - mesh.positions[point]) * units.perLength,
                              (mesh.scalars[other] - mesh.scalars[point]) * units.perScalar);
    const double trace = equations.matrix[0][0] + equations.matrix[1][1] + equations.matrix[2][2];
    if (!(trace > 0)) return glm::dvec3(0);
    const glm::dmat3 matrix = equations.matrix / trace;
    if (!(glm::determinant(matrix) > leastDeterminant)) return meanOfCells(mesh, cells, units);
    return glm::inverse(matrix) * (equations.right / trace);
}

}  // namespace

std::vector<glm::dvec3> vertexGradients(const mesh::ScalarMesh& mesh, const mesh::PointCells& around) {
    std::vector<glm::dvec3> gradients(mesh.positions.size(), glm::dvec3(0));
    if (mesh.association == mesh::Association::Cell) return gradients;
    const double range = mesh.scalarMax - mesh.scalarMin, diagonal = mesh.bounds.diagonal();
    if (!(range > 0) || !(diagonal > 0)) return gradients;
    const Units units{1.0 / diagonal, 1.0 / range};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, gradients.size(), 1024), [&](const auto& part) {
        for (std::size_t point = part.begin(); point != part.end(); ++point)
            gradients[point] = gradientAt(mesh, static_cast<mesh::PointIndex>(point), around.of(point), units);
    });
    return gradients;
}

}  // namespace tetralux::shading
