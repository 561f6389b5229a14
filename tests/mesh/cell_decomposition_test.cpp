// SPDX-License-Identifier: Apache-2.0
#include <glm/vec2.hpp>

#include <mesh/soup/validation.h>
#include <mesh/tet/adjacency.h>
#include <mesh/tet/mesh_statistics.h>

#include "cube_cells.h"

namespace tetralux::mesh {
namespace {

using namespace test;
class EveryCell : public testing::TestWithParam<CellKind> {};

/// The cube is filled once, without cracks, and a linear field stays what it is.
void expectFilledCube(const CellSoup& soup, std::size_t n) {
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_NEAR(totalVolume(result.mesh), 1.0, 1e-13);
    EXPECT_LT(largestError(result.mesh, linearField), 1e-14);
    const MeshStatistics statistics = meshStatistics(result.mesh);
    EXPECT_EQ(statistics.boundaryFaces, 12 * n * n);
    EXPECT_EQ(statistics.components, 1u);
    EXPECT_TRUE(statistics.defects.empty());
    EXPECT_TRUE(result.report.defects.empty()) << defectName(result.report.defects.begin()->first);
    EXPECT_EQ(result.report.cellsRead, soup.types.size());
}

TEST_P(EveryCell, FillsTheCubeWhateverThePointNumbers) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        CellSoup soup = cubeGrid(4, seed, straight, GetParam().add);
        addPointField(soup, "s", linearField);
        expectFilledCube(soup, 4);
    }
}

TEST_P(EveryCell, FillsTheCubeWithWarpedFaces) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        CellSoup soup = cubeGrid(6, seed, bend, GetParam().add);
        addPointField(soup, "s", linearField);
        expectFilledCube(soup, 6);
    }
}

TEST_P(EveryCell, InsideOutIsTurnedRound) {
    CellSoup soup = cubeGrid(
        3, 1, [](const glm::dvec3& x) { return glm::dvec3(1.0 - x.x, x.y, x.z); }, GetParam().add);
    addPointField(soup, "s", linearField);
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_NEAR(totalVolume(result.mesh), 1.0, 1e-13);
    EXPECT_EQ(buildAdjacency(result.mesh.cells, result.mesh.positions.size()).boundaryFaces, 108u);
}

INSTANTIATE_TEST_SUITE_P(Types, EveryCell, testing::ValuesIn(linearCellKinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

/// A prism over a regular polygon of n sides: volume n/2 · sin(2π/n) · height.
CellSoup prism(std::uint8_t type, std::uint32_t sides) {
    CellSoup soup;
    for (const double z : {0.0, 0.7}) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2.0 * 3.14159265358979323846 * i / sides;
            soup.points.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    }
    Ids ids(2 * sides);
    std::iota(ids.begin(), ids.end(), 0u);
    appendCell(soup, type, ids);
    addPointField(soup, "s", linearField);
    return soup;
}

TEST(Prisms, PentagonalAndHexagonal) {
    for (const auto& [type, sides] :
         {std::pair{cell_type::pentagonalPrism, 5u}, std::pair{cell_type::hexagonalPrism, 6u}}) {
        const ReadResult result = tetMeshFromSoup(prism(type, sides));
        EXPECT_NEAR(totalVolume(result.mesh), 0.7 * sides / 2.0 * std::sin(2.0 * 3.14159265358979323846 / sides),
                    1e-14);
        EXPECT_LT(largestError(result.mesh, linearField), 1e-15);
        EXPECT_TRUE(result.report.defects.empty());
    }
}

TEST(Hexahedron, BecomesSixTetrahedraAndKeepsItsCellValue) {
    CellSoup soup = cubeGrid(2, 3, straight, addHexahedron);
    soup.fields.push_back({"c", Association::Cell, 1, {1, 2, 3, 4, 5, 6, 7, 8}});
    const ReadResult result = tetMeshFromSoup(soup);
    ASSERT_EQ(result.mesh.cells.size(), 48u);
    for (std::size_t i = 0; i < 48; ++i) {
        EXPECT_EQ(result.mesh.fields[0].values[i], static_cast<double>(1 + i / 6));
    }
}

TEST(Hexahedron, CollapsedToWedgePyramidAndNothing) {
    CellSoup soup;
    for (int bits = 0; bits < 8; ++bits) {
        soup.points.emplace_back(bits & 1, bits >> 1 & 1, bits >> 2);
    }
    appendCell(soup, cell_type::hexahedron, Ids{0, 1, 3, 3, 4, 5, 7, 7});  // wedge: half the cube
    EXPECT_NEAR(totalVolume(tetMeshFromSoup(soup).mesh), 0.5, 1e-15);
    soup.types.clear();
    soup.offsets.clear();
    soup.connectivity.clear();
    appendCell(soup, cell_type::hexahedron, Ids{0, 1, 3, 2, 4, 4, 4, 4});  // pyramid: a third
    EXPECT_NEAR(totalVolume(tetMeshFromSoup(soup).mesh), 1.0 / 3.0, 1e-15);
    appendCell(soup, cell_type::hexahedron, Ids{0, 1, 3, 2, 0, 1, 3, 2});
    EXPECT_EQ(countOf(tetMeshFromSoup(soup).report, Defect::FlatCell), 1u);
}

/// A room with an L-shaped floor: its floor is not convex, and its smallest point does not see all of it.
TEST(Polyhedron, NonConvexFacesAreCutInside) {
    const std::vector<glm::dvec2> floor{{2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}};
    CellSoup soup;
    for (const double z : {0.0, 1.0}) {
        for (const glm::dvec2& p : floor) {
            soup.points.emplace_back(p.x, p.y, z);
        }
    }
    Ids all(12);
    std::iota(all.begin(), all.end(), 0u);
    appendCell(soup, cell_type::polyhedron, all);
    soup.faceStream = {6, 5, 4, 3, 2, 1, 0, 6, 6, 7, 8, 9, 10, 11};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        for (const std::uint32_t entry : {4u, i, j, j + 6, i + 6}) {
            soup.faceStream.push_back(entry);
        }
    }
    soup.faceOffsets = {0, soup.faceStream.size()};
    addPointField(soup, "s", linearField);
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_NEAR(totalVolume(result.mesh), 3.0, 1e-13);
    EXPECT_LT(largestError(result.mesh, linearField), 1e-14);
    EXPECT_TRUE(result.report.defects.empty());
}

TEST(Polyhedron, OpenOnesAreRefused) {
    CellSoup soup = cubeGrid(1, 0, straight, addPolyhedron);
    soup.faceStream.resize(soup.faceStream.size() - 5);
    soup.faceOffsets.back() = soup.faceStream.size();
    expectError([&] { tetMeshFromSoup(soup); }, "1 unsupported cell (polyhedron)");
}

}  // namespace
}  // namespace tetralux::mesh
