// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <shading/vertex_gradients.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::shading {
namespace {

using namespace tetralux::test;

std::vector<glm::dvec3> gradientsOf(const mesh::ScalarMesh& m) {
    return vertexGradients(m, mesh::PointCells(m.cells, m.positions.size()));
}

TEST(VertexGradients, AreExactOnLinearFields) {
    for (const double size : {1e-12, 1.0, 1e9}) {
        mesh::ScalarMesh m =
            jitteredBoxMesh(5, 0.3, 4, [](const glm::dvec3& p) { return 3 + p.x - 2 * p.y + 0.5 * p.z; });
        for (glm::dvec3& p : m.positions) p *= size;
        m = finished(std::move(m));
        const glm::dvec3 expected = glm::dvec3(1, -2, 0.5) / size * m.bounds.diagonal() / (m.scalarMax - m.scalarMin);
        for (const glm::dvec3& g : gradientsOf(m)) EXPECT_NEAR(glm::length(g - expected), 0, 1e-10);
    }
}

TEST(VertexGradients, ComeFromCellsWhereNeighboursLieInAPlane) {
    // a flat tetrahedron: least squares would divide by its height twice
    mesh::ScalarMesh m = unitTetrahedron({0, 1, 0, 0});
    m.positions[3] = {0.3, 0.3, 1e-7};
    m = finished(std::move(m));
    const glm::dvec3 cell = mesh::cellGradient(m, 0) * m.bounds.diagonal();
    for (const glm::dvec3& g : gradientsOf(m)) EXPECT_LE(glm::length(g - cell), 1e-9 * glm::length(cell));
}

TEST(VertexGradients, ConvergeOnSmoothFields) {
    // errors inside fall with the square of the spacing on a regular grid: by 4, of which 3 is asked
    double previous = 0;
    for (const int n : {9, 17}) {
        const mesh::ScalarMesh m = boxMesh(n, [](const glm::dvec3& p) { return std::sin(3 * p.x) * p.y + p.z * p.z; });
        const double scale = m.bounds.diagonal() / (m.scalarMax - m.scalarMin);
        const auto gradients = gradientsOf(m);
        double largest = 0;
        for (std::size_t i = 0; i < gradients.size(); ++i) {
            const glm::dvec3& p = m.positions[i];
            if (std::min({p.x, p.y, p.z}) < 0.01 || std::max({p.x, p.y, p.z}) > 0.99) continue;
            const glm::dvec3 exact(3 * std::cos(3 * p.x) * p.y, std::sin(3 * p.x), 2 * p.z);
            largest = std::max(largest, glm::length(gradients[i] - scale * exact));
        }
        if (previous > 0) {
            EXPECT_LT(largest, previous / 3);
        }
        previous = largest;
    }
}

TEST(VertexGradients, AreZeroForConstantsAndCellData) {
    for (const glm::dvec3& g : gradientsOf(boxMesh(3, [](const glm::dvec3&) { return 4.0; })))
        EXPECT_EQ(g, glm::dvec3(0));
    mesh::ScalarMesh m = boxMesh(3, [](const glm::dvec3& p) { return p.x; });
    m.association = mesh::Association::Cell;
    m.scalars.assign(m.cells.size(), 1.0);
    for (const glm::dvec3& g : gradientsOf(finished(std::move(m)))) EXPECT_EQ(g, glm::dvec3(0));
}

}  // namespace
}  // namespace tetralux::shading
