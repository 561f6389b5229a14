// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/cell_measures.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include <projection/core/transfer_support.h>

namespace tetralux::projection {

CellScalars scalarsOf(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    const glm::dvec2 range = scalarRange(mesh, cell);
    return {range.x, range.y};
}

CellShape shapeOf(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[mesh.cells[cell][k]];
    double longest = 0, largestFace = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) longest = std::max(longest, glm::distance(p[i], p[j]));
    for (const auto& face : mesh::faceVertices) {
        const glm::dvec3& a = p[static_cast<std::size_t>(face[0])];
        const glm::dvec3 ab = p[static_cast<std::size_t>(face[1])] - a, ac = p[static_cast<std::size_t>(face[2])] - a;
        largestFace =
            std::max(largestFace, glm::length(glm::cross(ab / longest, ac / longest)));  // in range for any size
    }
    const double volume = std::abs(mesh::sixVolumes(p[0] / longest, p[1] / longest, p[2] / longest, p[3] / longest));
    return {longest, largestFace > 0 ? longest * volume / largestFace : 0.0};
}

Extinctions extinctionsOf(const preint::TransferFunction& function, const CellScalars& scalars) {
    const double a = function.extinctionAt(scalars.low), b = function.extinctionAt(scalars.high);
    Extinctions found{std::min(a, b), std::max(a, b)};
    for (const auto& node : function.extinction)
        if (node.scalar >= scalars.low && node.scalar <= scalars.high)
            found = {std::min(found.least, node.extinction), std::max(found.most, node.extinction)};
    return found;
}

}  // namespace tetralux::projection
