// SPDX-License-Identifier: Apache-2.0
#include <map>

#include <mesh/soup/reference_lattice.h>
#include <mesh/soup/shape_functions.h>
#include <mesh/soup/validation.h>
#include <mesh/tet/mesh_statistics.h>

#include "cube_cells.h"

namespace tetralux::mesh {
namespace {

using namespace test;

struct CurvedCell {
    const char* name;
    std::uint8_t type;
    std::size_t points;
    double volume;  ///< of the parametric cell as VTK's pyramid and wedge have it
};

class EveryCurvedCell : public testing::TestWithParam<CurvedCell> {};

/// One cell with its points where the linear map of the parametric cell puts them.
CellSoup straightCell(const CurvedCell& kind) {
    CellSoup soup;
    std::vector<std::uint32_t> ids;
    for (const std::array<double, 3>& place : curvedNodes(kind.type, kind.points).places) {
        EXPECT_GE(place[0], 0.0) << "a point of the cell was not found";
        const bool pyramid = cellTypeInfo(kind.type).shape == Shape::Pyramid;
        const double shrink = pyramid ? 1.0 - place[2] : 1.0;  // VTK's r and s run over every layer of a pyramid
        ids.push_back(static_cast<std::uint32_t>(soup.points.size()));
        soup.points.emplace_back(place[0] * shrink, place[1] * shrink, place[2]);
    }
    appendCell(soup, kind.type, ids);
    addPointField(soup, "s", linearField);
    return soup;
}

TEST_P(EveryCurvedCell, StraightOnesKeepVolumeAndLinearField) {
    for (const int segments : {0, 1, 2, 3, 5}) {
        ReadOptions options;
        options.subdivision = segments;
        const ReadResult result = tetMeshFromSoup(straightCell(GetParam()), options);
        EXPECT_NEAR(totalVolume(result.mesh), GetParam().volume, 1e-12) << segments;
        EXPECT_LT(largestError(result.mesh, linearField), 1e-12) << segments;
        EXPECT_TRUE(result.report.defects.empty()) << segments;
        EXPECT_TRUE(meshStatistics(result.mesh).defects.empty()) << segments;
        EXPECT_EQ(meshStatistics(result.mesh).components, 1u) << segments;
    }
}

INSTANTIATE_TEST_SUITE_P(Types, EveryCurvedCell,
                         testing::Values(CurvedCell{"tet10", cell_type::quadraticTetrahedron, 10, 1.0 / 6.0},
                                         CurvedCell{"hex20", cell_type::quadraticHexahedron, 20, 1.0},
                                         CurvedCell{"hex24", cell_type::biquadraticQuadraticHexahedron, 24, 1.0},
                                         CurvedCell{"hex27", cell_type::triquadraticHexahedron, 27, 1.0},
                                         CurvedCell{"wedge12", cell_type::quadraticLinearWedge, 12, 0.5},
                                         CurvedCell{"wedge15", cell_type::quadraticWedge, 15, 0.5},
                                         CurvedCell{"wedge18", cell_type::biquadraticQuadraticWedge, 18, 0.5},
                                         CurvedCell{"pyramid13", cell_type::quadraticPyramid, 13, 1.0 / 3.0},
                                         CurvedCell{"pyramid19", cell_type::triquadraticPyramid, 19, 1.0 / 3.0},
                                         CurvedCell{"tet15", cell_type::lagrangeTetrahedron, 15, 1.0 / 6.0},
                                         CurvedCell{"wedge21", cell_type::lagrangeWedge, 21, 0.5},
                                         CurvedCell{"lagrange_tet35", cell_type::lagrangeTetrahedron, 35, 1.0 / 6.0},
                                         CurvedCell{"lagrange_hex64", cell_type::lagrangeHexahedron, 64, 1.0},
                                         CurvedCell{"lagrange_wedge40", cell_type::lagrangeWedge, 40, 0.5}),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(ReferenceLattice, PiecesFillTheCell) {
    for (const auto& [shape, volume] : {std::pair{Shape::Tet, 1.0 / 6.0}, std::pair{Shape::Hexahedron, 1.0},
                                        std::pair{Shape::Wedge, 0.5}, std::pair{Shape::Pyramid, 1.0 / 3.0}}) {
        for (int n = 1; n <= 5; ++n) {
            const ReferenceLattice lattice = referenceLattice(shape, n);
            CellSoup soup;
            for (const auto& p : lattice.points) {
                const double shrink = shape == Shape::Pyramid ? 1.0 - p[2] : 1.0;
                soup.points.emplace_back(p[0] * shrink, p[1] * shrink, p[2]);
            }
            for (const ReferenceLattice::SubCell& cell : lattice.cells) {
                appendCell(soup, cell.type,
                           std::vector<int>(cell.points.begin(), cell.points.begin() + cell.pointCount));
            }
            const ReadResult result = tetMeshFromSoup(soup);
            EXPECT_NEAR(totalVolume(result.mesh), volume, 1e-13);
            EXPECT_TRUE(meshStatistics(result.mesh).defects.empty());
            EXPECT_TRUE(result.report.defects.empty());
        }
    }
}

/// Two tetrahedra of ten points over a common face, of which the middles are bulged: a quadratic field is met ever
/// better.
CellSoup twoCurvedTetrahedra() {
    CellSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, isNew] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(soup.points.size()));
        if (isNew) {
            const glm::dvec3 bulge(0.03 * a, 0.02 * b, -0.02 * (a + b));
            soup.points.push_back(0.5 * (soup.points[a] + soup.points[b]) + bulge);
        }
        return place->second;
    };
    for (const std::array<std::uint32_t, 4>& t : {std::array<std::uint32_t, 4>{0, 1, 2, 3}, {4, 2, 1, 3}}) {
        std::vector<std::uint32_t> ids(t.begin(), t.end());
        for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}) {
            ids.push_back(middle(t[static_cast<std::size_t>(a)], t[static_cast<std::size_t>(b)]));
        }
        appendCell(soup, cell_type::quadraticTetrahedron, ids);
    }
    addPointField(soup, "s", linearField);
    return soup;
}

TEST(CurvedCells, SharedFacesShareTheirLattice) {
    for (const int segments : {2, 3, 4, 7}) {
        ReadOptions options;
        options.subdivision = segments;
        const ReadResult result = tetMeshFromSoup(twoCurvedTetrahedra(), options);
        const std::size_t n = static_cast<std::size_t>(segments);
        EXPECT_EQ(result.mesh.cells.size(), 2 * n * n * n);
        const MeshStatistics statistics = meshStatistics(result.mesh);
        EXPECT_EQ(statistics.boundaryFaces, 6 * n * n);
        EXPECT_EQ(statistics.components, 1u);
        EXPECT_LT(largestError(result.mesh, linearField), 1e-14);  // isoparametric cells hold linear fields exactly
    }
}

TEST(CurvedCells, VolumeConvergesWithTheSquareOfTheStep) {
    std::array<double, 3> volumes{};
    for (std::size_t i = 0; i < 3; ++i) {
        ReadOptions options;
        options.subdivision = 4 << i;
        volumes[i] = totalVolume(tetMeshFromSoup(twoCurvedTetrahedra(), options).mesh);
    }
    EXPECT_NEAR((volumes[1] - volumes[0]) / (volumes[2] - volumes[1]), 4.0, 0.05);
}

TEST(CurvedCells, UnknownOrderIsUnsupported) {
    CellSoup soup = twoCurvedTetrahedra();
    soup.types = {cell_type::quadraticTetrahedron, cell_type::lagrangeTetrahedron};
    soup.connectivity.resize(19);
    soup.offsets = {0, 10, 19};
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(countOf(result.report, Defect::UnsupportedCell), 1u);
    EXPECT_EQ(result.report.skipped.at("unsupported cell (Lagrange tetrahedron)"), 1u);
}

}  // namespace
}  // namespace tetralux::mesh
