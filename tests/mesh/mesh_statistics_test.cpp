// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/mesh_statistics.h>

#include <limits>
#include <random>

#include <mesh/tet/procedural_field.h>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

TEST(MeshStatistics, OfAGrid) {
    const MeshStatistics s = meshStatistics(sampleOnGrid(proceduralField("marschner-lobb", 9), 9));
    EXPECT_EQ(s.cells, 5u * 512u);
    EXPECT_NEAR(s.volume, 8.0, 1e-12);
    EXPECT_NEAR(s.largestVolume / s.smallestVolume, 2.0,
                1e-12);  // the inner of the five has a third of the cube, the others a sixth
    EXPECT_EQ(s.boundaryFaces, 6u * 2u * 64u);
    EXPECT_EQ(4 * s.cells, 2 * s.innerFaces + s.boundaryFaces);
    EXPECT_EQ(s.components, 1u);
    EXPECT_EQ(s.delaunayShare(), 1.0);  // all corners of a cube lie on one sphere
    EXPECT_TRUE(s.defects.empty());
    ASSERT_EQ(s.fields.size(), 1u);
    EXPECT_EQ(std::accumulate(s.fields[0].histogram.begin(), s.fields[0].histogram.end(), std::uint64_t{0}), 729u);
}

TEST(MeshStatistics, FlippedPairIsNotDelaunay) {
    // Two tetrahedra over the triangle 0 1 2; each tip lies well inside the other's circumsphere.
    TetMesh mesh;
    mesh.positions = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, 0.2}, {0, 0, -0.2}};
    mesh.cells = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    EXPECT_EQ(meshStatistics(mesh).delaunayFaces, 0u);
    mesh.positions[3].z = 3.0;
    mesh.positions[4].z = -3.0;
    EXPECT_EQ(meshStatistics(mesh).delaunayFaces, 1u);
}

TEST(MeshStatistics, ComponentsAndHangingNodes) {
    TetMesh coarse = sampleOnGrid(proceduralField("coulomb", 2), 2);
    const TetMesh fine = sampleOnGrid(proceduralField("coulomb", 3), 3);
    const PointIndex shift = static_cast<PointIndex>(coarse.positions.size());
    for (const glm::dvec3& x : fine.positions) {
        coarse.positions.push_back(x + glm::dvec3(1, 0, 0));
    }
    for (const Tetrahedron& cell : fine.cells) {
        coarse.cells.push_back({cell[0] + shift, cell[1] + shift, cell[2] + shift, cell[3] + shift});
    }
    coarse.fields.clear();
    const MeshStatistics s = meshStatistics(coarse);
    EXPECT_EQ(s.components, 2u);
    EXPECT_EQ(s.largestComponent, 40u);
    // The common square is 2 triangles on one side and 8 on the other.
    EXPECT_EQ(s.defects.at(Defect::NonConformingInterface).count, 10u);
}

/// A cube of 5 tetrahedra and, moved by `shift` and scaled, another; they share no points.
TetMesh twoCubes(const glm::dvec3& shift, double scale) {
    TetMesh mesh = sampleOnGrid(proceduralField("coulomb", 2), 2);
    const TetMesh other = mesh;
    for (const glm::dvec3& x : other.positions) {
        mesh.positions.push_back(scale * x + shift);
    }
    for (const Tetrahedron& cell : other.cells) {
        mesh.cells.push_back({cell[0] + 8, cell[1] + 8, cell[2] + 8, cell[3] + 8});
    }
    mesh.fields.clear();
    return mesh;
}

TEST(MeshStatistics, CellsThatOverlapAreFound) {
    // Corner in corner: only the boundaries cross. The tetrahedra at the two corners are among those named.
    const auto crossing = meshStatistics(twoCubes({0.7, 0.8, 0.9}, 1.0)).defects;
    ASSERT_EQ(crossing.size(), 1u);
    EXPECT_GE(crossing.at(Defect::OverlappingCell).count, 2u);
    EXPECT_LE(crossing.at(Defect::OverlappingCell).count, 10u);
    // One within the other: no faces cross.
    const auto enclosed = meshStatistics(twoCubes({0.3, 0.35, 0.41}, 0.2)).defects;
    ASSERT_EQ(enclosed.size(), 1u);
    EXPECT_EQ(enclosed.at(Defect::OverlappingCell).count, 1u);
    EXPECT_GE(enclosed.at(Defect::OverlappingCell).firstOffenders.at(0), 5u);
    // Two that go through each other like a cross, with no corner of one inside the other.
    TetMesh cross = twoCubes({0.3, 0.3, -0.5}, 1.0);
    for (std::size_t p = 8; p < 16; ++p) {
        cross.positions[p] = {0.3 + 0.4 * (cross.positions[p].x - 0.3), 0.3 + 0.4 * (cross.positions[p].y - 0.3),
                              -0.5 + 2.0 * (cross.positions[p].z + 0.5)};
    }
    EXPECT_GE(meshStatistics(cross).defects.at(Defect::OverlappingCell).count, 2u);
    // Folded: two cells on the same side of a face.
    TetMesh folded = sampleOnGrid(proceduralField("coulomb", 2), 2);
    folded.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.3, 0.2, 2}};
    folded.cells = {{0, 1, 2, 3}, {0, 1, 2, 4}};
    folded.fields.clear();
    EXPECT_EQ(meshStatistics(folded).defects.at(Defect::OverlappingCell).firstOffenders,
              (std::vector<std::uint64_t>{0, 1}));
}

/// Every cell goes through most others, so that not all pairs are looked at: each cell is named all the same.
TEST(MeshStatistics, NoiseOverlapsEverywhere) {
    TetMesh noise;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit;
    for (PointIndex cell = 0; cell < 2000; ++cell) {
        for (int corner = 0; corner < 4; ++corner) {
            noise.positions.emplace_back(unit(random), unit(random), unit(random));
        }
        const glm::dvec3* const x = noise.positions.data() + 4 * cell;
        const bool positive = sixVolumes(x[0], x[1], x[2], x[3]) > 0.0;
        noise.cells.push_back(
            {4 * cell, 4 * cell + 1, 4 * cell + (positive ? 2u : 3u), 4 * cell + (positive ? 3u : 2u)});
    }
    EXPECT_GT(meshStatistics(noise).defects.at(Defect::OverlappingCell).count, 1990u);
}

TEST(MeshStatistics, CellsThatTouchDoNotOverlap) {
    for (const glm::dvec3& shift :
         {glm::dvec3(1, 0, 0), glm::dvec3(1, 0.3, 0.2), glm::dvec3(1, 1, 0.4), glm::dvec3(1, 1, 1), glm::dvec3(2, 0, 0),
          glm::dvec3(1.0 - 1e-8, 0.3, 0.2), glm::dvec3(0.6, 1.0, 0.5)}) {
        for (const double scale : {1.0, 0.5, 3.0}) {
            EXPECT_FALSE(meshStatistics(twoCubes(shift, scale)).defects.contains(Defect::OverlappingCell))
                << shift.x << ' ' << shift.y << ' ' << shift.z << " times " << scale;
        }
    }
}

TEST(MeshStatistics, BlocksThatOnlyTouchAlongAnEdgeConform) {
    TetMesh mesh = sampleOnGrid(proceduralField("coulomb", 2), 2);
    const PointIndex shift = static_cast<PointIndex>(mesh.positions.size());
    const std::vector<glm::dvec3> positions = mesh.positions;
    const std::vector<Tetrahedron> cells = mesh.cells;
    for (const glm::dvec3& x : positions) {
        mesh.positions.push_back(x + glm::dvec3(1, 1, 0));
    }
    for (const Tetrahedron& cell : cells) {
        mesh.cells.push_back({cell[0] + shift, cell[1] + shift, cell[2] + shift, cell[3] + shift});
    }
    EXPECT_TRUE(meshStatistics(mesh).defects.empty());
}

TEST(MeshStatistics, FieldsWithHolesHugeValuesAndVectors) {
    TetMesh mesh = sampleOnGrid(proceduralField("coulomb", 2), 2);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    mesh.fields = {{"holes", Association::Point, 1, {nan, 1, 2, 3, 4, -inf, 5, 6}},
                   {"huge", Association::Cell, 1, {-1e308, 1e308, 0, 0, 0}},
                   {"vector", Association::Cell, 2, {3, 4, 0, 0, 0, 0, 0, 0, 6, 8}},
                   {"empty", Association::Cell, 1, {nan, nan, nan, nan, nan}}};
    const MeshStatistics s = meshStatistics(mesh);
    EXPECT_EQ(s.fields[0].nonFinite, 2u);
    EXPECT_EQ(s.fields[0].low, 1.0);
    EXPECT_DOUBLE_EQ(s.fields[0].mean, 3.5);
    EXPECT_EQ(s.fields[1].histogram.front(), 1u);
    EXPECT_EQ(s.fields[1].histogram[32], 3u);
    EXPECT_EQ(s.fields[2].high, 10.0);
    EXPECT_EQ(s.fields[3].nonFinite, 5u);
    EXPECT_TRUE(s.fields[3].histogram.empty());
}

}  // namespace
}  // namespace tetralux::mesh
