// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/cell_slope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace tetralux::mesh {

CellSlope cellSlope(const ScalarMesh& mesh, CellIndex cell) {
    const CellSlope none{glm::dvec3(0), 0};
    if (mesh.association == Association::Cell) {
        return none;
    }
    const Tetrahedron& t = mesh.cells[cell];
    std::array<glm::dvec3, 3> edge;
    glm::dvec3 rise;
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        const PointIndex p = t[static_cast<std::size_t>(k) + 1];
        edge[static_cast<std::size_t>(k)] = mesh.positions[p] - mesh.positions[t[0]];
        rise[k] = mesh.scalars[p] - mesh.scalars[t[0]];
        for (int axis = 0; axis < 3; ++axis) {
            longest = std::max(longest, std::abs(edge[static_cast<std::size_t>(k)][axis]));
        }
    }
    const double steepest = std::max({std::abs(rise.x), std::abs(rise.y), std::abs(rise.z)});
    if (!(steepest > 0.0)) {
        return none;
    }
    rise /= steepest;
    for (glm::dvec3& e : edge) {
        e /= longest;
    }
    // The dual basis of the edges b, c, d: g·b = s1 − s0 and so on.
    const auto& [b, c, d] = edge;
    const glm::dvec3 sum = rise.x * glm::cross(c, d) + rise.y * glm::cross(d, b) + rise.z * glm::cross(b, c);
    const double length = glm::length(sum), volume = glm::dot(glm::cross(b, c), d);
    if (!(length > 0.0)) {
        return none;  // a cell so flat that rounding leaves it no area
    }
    const double magnitude = length / volume * (steepest / longest);
    return {sum / length, std::max(magnitude, std::numeric_limits<double>::min())};
}

}  // namespace tetralux::mesh
