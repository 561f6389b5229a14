// SPDX-License-Identifier: Apache-2.0
//
// Marching tetrahedra and boundaries: closed, the right way round, and of the size that closed forms give.
#include <mesh/tet/mesh_cut.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/tet/field_surface.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::mesh {
namespace {

FieldSurface asSurface(const ScalarMesh& mesh, const MeshCut& cut) {
    return {cutPositions(cut, mesh.positions), cut.triangles, {}};
}

FieldSurface isosurface(const ScalarMesh& mesh, double value) {
    return asSurface(mesh, cutAtLevel(mesh.positions, mesh.cells, mesh.scalars, value));
}

/// Volume of the cells in which the linear scalar is above `value`, which no corner has: of a tetrahedron with the
/// scalars s_i the share is Σ (s_i − v)₊³/Π_{j≠i}(s_i − s_j).
double volumeAbove(const ScalarMesh& mesh, double value) {
    double sum = 0.0;
    for (const Tetrahedron& t : mesh.cells) {
        double share = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            double divisor = 1.0;
            for (std::size_t j = 0; j < 4; ++j)
                if (j != i) divisor *= mesh.scalars[t[i]] - mesh.scalars[t[j]];
            share += std::pow(std::max(0.0, mesh.scalars[t[i]] - value), 3) / divisor;
        }
        sum += share *
               sixVolumes(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], mesh.positions[t[3]]) / 6.0;
    }
    return sum;
}

/// A ball about the middle of the cube that does not reach its sides, bumpy by `noise`.
ScalarMesh bumpyBall(double noise) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> bump(-noise, noise);
    return test::jitteredBoxMesh(
        9, 0.3, 5, [&](const glm::dvec3& x) { return 0.45 - glm::distance(x, glm::dvec3(0.5)) + bump(random); });
}

void expectNoDegenerateTriangle(const FieldSurface& surface) {
    std::set<std::array<double, 3>> places;
    for (const glm::dvec3& p : surface.positions) EXPECT_TRUE(places.insert({p.x, p.y, p.z}).second) << "a point twice";
    for (const auto& [a, b, c] : surface.triangles) EXPECT_TRUE(a != b && b != c && c != a);
}

TEST(MeshCut, IsosurfacesEncloseWhatIsAboveThem) {
    const ScalarMesh mesh = bumpyBall(0.05);
    for (const double value : {0.1, 0.2, 0.3}) {
        const FieldSurface surface = isosurface(mesh, value);
        const SurfaceMeasure found = measure(surface);
        EXPECT_EQ(found.openEdges, 0u);
        EXPECT_NEAR(found.volume, volumeAbove(mesh, value), 1e-13);
        expectNoDegenerateTriangle(surface);
    }
}

TEST(MeshCut, OpenOnlyAtTheMeshsBorder) {
    const ScalarMesh mesh = bumpyBall(0.05);
    const FieldSurface surface = isosurface(mesh, -0.1);  // cut by the cube's six sides
    EXPECT_GT(measure(surface).openEdges, 20u);
    std::map<std::pair<PointIndex, PointIndex>, int> edges;
    for (const auto& t : surface.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    for (const auto& [edge, count] : edges) {
        const glm::dvec3 &a = surface.positions[edge.first], &b = surface.positions[edge.second];
        bool onSide = false;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {0.0, 1.0})
                onSide = onSide || (std::abs(a[axis] - side) < 1e-12 && std::abs(b[axis] - side) < 1e-12);
        EXPECT_EQ(count, onSide ? 1 : 2);
    }
}

/// Whole numbers, so that levels run through many corners, edges and faces at once.
TEST(MeshCut, LevelsThroughCornersLeaveNoGap) {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> whole(0, 3);
    ScalarMesh mesh = test::boxMesh(9, [](const glm::dvec3&) { return 0.0; });
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3& p = mesh.positions[i];
        const bool inside = std::min({p.x, p.y, p.z}) > 1e-9 && std::max({p.x, p.y, p.z}) < 1 - 1e-9;
        mesh.scalars[i] = inside ? whole(random) : 0.0;
    }
    for (const double value : {1.0, 2.0, 3.0}) {
        const FieldSurface surface = isosurface(mesh, value);
        const SurfaceMeasure found = measure(surface);
        EXPECT_EQ(found.openEdges, 0u) << value;
        expectNoDegenerateTriangle(surface);
        // just below the value the same is above, and no corner is met
        EXPECT_NEAR(found.volume, measure(isosurface(mesh, value - 1e-9)).volume, 1e-8) << value;
        EXPECT_GT(std::abs(found.volume - measure(isosurface(mesh, value + 1e-9)).volume), 1e-3 * (3 - value)) << value;
    }
}

TEST(MeshCut, ValueFromAbove) {
    // one cell: of two corners at the level and one on either side, the level runs through the two
    const ScalarMesh cell = test::unitTetrahedron({1.0, 1.0, 0.0, 2.0});
    const MeshCut through = cutAtLevel(cell.positions, cell.cells, cell.scalars, 1.0);
    ASSERT_EQ(through.triangles.size(), 1u);
    EXPECT_EQ(through.points.size(), 3u);
    const auto count = [&](const std::vector<double>& scalars) {
        return cutAtLevel(cell.positions, cell.cells, scalars, 1.0).triangles.size();
    };
    EXPECT_EQ(count({1, 1, 1, 0}), 1u) << "the face itself, with what is below behind it";
    EXPECT_EQ(count({1, 1, 1, 2}), 0u) << "nothing is below";
    EXPECT_EQ(count({1, 0, 0, 0}), 0u) << "a point alone";
    EXPECT_EQ(count({1, 1, 0, 0}), 0u) << "an edge alone";
    EXPECT_EQ(count({2, 2, 0, 0}), 2u);
    EXPECT_EQ(count({2, 2, 0, std::numeric_limits<double>::quiet_NaN()}), 0u) << "a cell without a value";
}

TEST(MeshCut, PlanesFaceTheirNormal) {
    const ScalarMesh mesh = test::boxMesh(5, [](const glm::dvec3& x) { return x.x; });
    for (const glm::dvec3 point :
         {glm::dvec3(0.5, 0.5, 0.4), glm::dvec3(0.5, 0.5, 0.5), glm::dvec3(0.5, 0.5, 0.0), glm::dvec3(0.5, 0.5, 1.0)})
        for (const glm::dvec3 normal : {glm::dvec3(0, 0, 3), glm::dvec3(0, 0, -0.1)}) {
            const FieldSurface cut = asSurface(mesh, cutAtPlane(mesh.positions, mesh.cells, point, normal));
            glm::dvec3 area(0);
            for (const auto& [a, b, c] : cut.triangles)
                area += 0.5 * glm::cross(cut.positions[b] - cut.positions[a], cut.positions[c] - cut.positions[a]);
            EXPECT_NEAR(glm::dot(area, glm::normalize(normal)), 1.0, 1e-12) << point.z << ", " << normal.z;
            EXPECT_NEAR(measure(cut).area, 1.0, 1e-12) << "each face once";
        }
    EXPECT_TRUE(cutAtPlane(mesh.positions, mesh.cells, {0, 0, 2}, {0, 0, 1}).triangles.empty());
}

TEST(MeshCut, BoundariesEncloseTheMesh) {
    const ScalarMesh mesh = test::carved(test::jitteredBoxMesh(7, 0.3, 5, [](const glm::dvec3& x) { return x.x; }),
                                         [](const glm::dvec3& x) { return glm::distance(x, glm::dvec3(0.5)) > 0.3; });
    double volume = 0.0;
    for (const Tetrahedron& t : mesh.cells)
        volume +=
            sixVolumes(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], mesh.positions[t[3]]) / 6.0;
    const MeshCut cut = boundaryFaces(mesh.cells, mesh.positions.size());
    const SurfaceMeasure found = measure(asSurface(mesh, cut));
    EXPECT_EQ(found.openEdges, 0u);
    EXPECT_NEAR(found.volume, volume, 1e-13) << "the hollow taken off";
    for (const EdgePoint& point : cut.points) EXPECT_EQ(point.a, point.b);
}

TEST(MeshCut, FieldsAreCarriedOn) {
    const ScalarMesh mesh = bumpyBall(0.05);
    TetMesh whole{{mesh.positions.begin(), mesh.positions.end()}, {mesh.cells.begin(), mesh.cells.end()}, {}};
    Field place{"place", Association::Point, 3, {}}, number{"number", Association::Cell, 1, {}},
        scalar{"s", Association::Point, 1, {mesh.scalars.begin(), mesh.scalars.end()}};
    for (const glm::dvec3& p : mesh.positions) place.values.insert(place.values.end(), {p.x, p.y, p.z});
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) number.values.push_back(static_cast<double>(i));
    whole.fields = {place, number, scalar};
    const MeshCut cut = cutAtLevel(mesh.positions, mesh.cells, mesh.scalars, 0.2);
    const FieldSurface surface = surfaceOf(whole, cut);
    ASSERT_EQ(surface.fields.size(), 3u);
    ASSERT_EQ(surface.fields[1].values.size(), surface.triangles.size());
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(surface.fields[0].values[3 * i + static_cast<std::size_t>(axis)], surface.positions[i][axis],
                        1e-15);
        EXPECT_NEAR(surface.fields[2].values[i], 0.2, 1e-15);
    }
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) EXPECT_EQ(surface.fields[1].values[i], cut.cells[i]);
}

}  // namespace
}  // namespace tetralux::mesh
