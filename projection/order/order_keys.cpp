// SPDX-License-Identifier: Apache-2.0
#include <projection/order/order_keys.h>

#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

OrderKeys::OrderKeys(const mesh::ScalarMesh& mesh) : planes_(mesh.cells.size()), units_(mesh.bounds) {}

namespace {

/// Fills `planes` by plane(cell, corners in mesh diagonals from the centre).
template <class Plane>
void fillPlanes(const mesh::ScalarMesh& mesh, const DiagonalUnits& units, std::vector<glm::dvec4>& planes,
                Plane plane) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planes.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            std::array<glm::dvec3, 4> corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = units.place(mesh.positions[mesh.cells[i][k]]);
            planes[i] = plane(mesh.cells[i], corners);
        }
    });
}

}  // namespace

OrderKeys OrderKeys::power(const mesh::ScalarMesh& mesh, const std::vector<double>& heights) {
    OrderKeys keys(mesh);
    fillPlanes(mesh, keys.units_, keys.planes_, [&](const mesh::Tetrahedron& cell, const std::array<glm::dvec3, 4>& p) {
        const glm::dvec3 ab = p[1] - p[0], ac = p[2] - p[0], ad = p[3] - p[0];
        const glm::dvec3 cd = glm::cross(ac, ad), db = glm::cross(ad, ab), bc = glm::cross(ab, ac);
        const double h = heights[cell[0]];
        const glm::dvec3 gradient =
            ((heights[cell[1]] - h) * cd + (heights[cell[2]] - h) * db + (heights[cell[3]] - h) * bc) /
            glm::dot(ab, cd);
        return glm::dvec4(gradient, h - glm::dot(gradient, p[0]));
    });
    return keys;
}

OrderKeys OrderKeys::centroid(const mesh::ScalarMesh& mesh) {
    OrderKeys keys(mesh);
    fillPlanes(mesh, keys.units_, keys.planes_, [](const mesh::Tetrahedron&, const std::array<glm::dvec3, 4>& p) {
        const glm::dvec3 c = 0.25 * (p[0] + p[1] + p[2] + p[3]);
        return glm::dvec4(2.0 * c, -glm::dot(c, c));  // −|c − e|² + |e|²
    });
    return keys;
}

}  // namespace tetralux::projection
