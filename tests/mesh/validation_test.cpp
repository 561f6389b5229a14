// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/validation.h>

#include <limits>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/procedural_field.h>
#include <mesh/tet/select_scalar.h>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using namespace test;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Ids = std::vector<std::uint32_t>;

/// 135 tetrahedra of a 4×4×4 grid in the unit cube, with the scalar x.
CellSoup smallSoup() {
    const TetMesh mesh = sampleOnGrid(proceduralField("coulomb", 4), 4);
    CellSoup soup;
    soup.points = mesh.positions;
    for (const Tetrahedron& cell : mesh.cells) {
        appendCell(soup, cell_type::tetrahedron, cell);
    }
    addPointField(soup, "s", [](const glm::dvec3& x) { return x.x; });
    return soup;
}

std::vector<std::uint64_t> placesOf(const ReadResult& result, Defect defect) {
    return result.report.defects.at(defect).firstOffenders;
}

TEST(Validation, SoundMeshPassesUnchanged) {
    const CellSoup soup = smallSoup();
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_TRUE(result.report.defects.empty());
    EXPECT_EQ(result.mesh.positions, soup.points);
    EXPECT_EQ(result.report.cellTypes.at("tetrahedron"), 135u);
    EXPECT_NEAR(totalVolume(result.mesh), 1.0, 1e-14);
}

TEST(Validation, IndexOutOfRange) {
    CellSoup soup = smallSoup();
    soup.connectivity[4 * 7 + 2] = 64;
    soup.connectivity[4 * 9] = CellSoup::invalidPoint;
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::IndexOutOfRange), (std::vector<std::uint64_t>{7, 9}));
    EXPECT_EQ(result.mesh.cells.size(), 133u);
    EXPECT_EQ(result.report.skipped.at("index out of range"), 2u);
}

TEST(Validation, NonFinitePosition) {
    CellSoup soup = smallSoup();
    soup.points[0].y = nan;  // a corner of the cube: one cell has it
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(countOf(result.report, Defect::NonFinitePosition), 135u - result.mesh.cells.size());
    EXPECT_GT(countOf(result.report, Defect::NonFinitePosition), 0u);
    for (const glm::dvec3& x : result.mesh.positions) {
        EXPECT_TRUE(std::isfinite(x.y));
    }
}

TEST(Validation, InvertedCellsAreTurnedRound) {
    CellSoup soup = smallSoup();
    for (const std::size_t cell : {3u, 5u, 130u}) {
        std::swap(soup.connectivity[4 * cell], soup.connectivity[4 * cell + 1]);
    }
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::InvertedCell), (std::vector<std::uint64_t>{3, 5, 130}));
    EXPECT_NEAR(totalVolume(result.mesh), 1.0, 1e-14);
    EXPECT_EQ(buildAdjacency(result.mesh.cells, 64).boundaryFaces, 108u);
}

TEST(Validation, FlatCellsAreLeftOut) {
    CellSoup soup = smallSoup();
    soup.connectivity[1] = soup.connectivity[0];                // a repeated point
    appendCell(soup, cell_type::tetrahedron, Ids{0, 1, 5, 4});  // four points in a plane
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::FlatCell), (std::vector<std::uint64_t>{0, 135}));
    EXPECT_EQ(result.mesh.cells.size(), 134u);
}

/// A sliver keeps its place however thin it is, as long as the sign of its volume is beyond doubt.
TEST(Validation, SliversStayWhatTheScale) {
    for (const double scale : {1e-12, 1.0, 1e12}) {
        for (const double height : {1e-3, 1e-9, 1e-13}) {
            CellSoup soup;
            soup.points = {{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, {0.3 * scale, 0.3 * scale, height * scale}};
            appendCell(soup, cell_type::tetrahedron, Ids{0, 1, 2, 3});
            EXPECT_EQ(tetMeshFromSoup(soup).mesh.cells.size(), 1u) << scale << " " << height;
        }
    }
}

TEST(Validation, FarFromTheOriginIsNotFlat) {
    CellSoup soup = smallSoup();
    for (glm::dvec3& x : soup.points) {
        x = 1e-2 * x + glm::dvec3(1e6);
    }
    EXPECT_EQ(tetMeshFromSoup(soup).mesh.cells.size(), 135u);
}

TEST(Validation, DuplicatesAreLeftOutWhateverTheirOrder) {
    CellSoup soup = smallSoup();
    soup.fields.push_back({"c", Association::Cell, 1, std::vector<double>(138)});
    std::iota(soup.fields[1].values.begin(), soup.fields[1].values.end(), 0.0);
    for (const std::size_t copy : {0u, 40u, 40u}) {
        const std::uint32_t* ids = soup.connectivity.data() + 4 * copy;
        appendCell(soup, cell_type::tetrahedron, Ids{ids[2], ids[3], ids[0], ids[1]});
    }
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::DuplicateCell), (std::vector<std::uint64_t>{135, 136, 137}));
    EXPECT_EQ(result.mesh.cells.size(), 135u);
    EXPECT_EQ(result.mesh.fields[1].values.back(), 134.0);
}

TEST(Validation, DuplicatesAreFoundAmongManyCellsOfOnePoint) {
    CellSoup soup;  // a fan of thin tetrahedra around the edge between points 0 and 1, all of it twice
    constexpr std::uint32_t cells = 30000;
    soup.points = {{0, 0, 0}, {0, 0, 1}};
    for (std::uint32_t i = 0; i <= cells; ++i) {
        const double angle = 6.0 * i / cells;
        soup.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    for (std::uint32_t i = 0; i < 2 * cells; ++i) {
        const std::uint32_t side = 2 + i % cells;
        appendCell(soup, cell_type::tetrahedron, i < cells ? Ids{0, side, side + 1, 1} : Ids{side + 1, 0, side, 1});
    }
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(countOf(result.report, Defect::DuplicateCell), cells);
    EXPECT_EQ(placesOf(result, Defect::DuplicateCell).front(), cells);
    EXPECT_EQ(result.mesh.cells.size(), cells);
}

TEST(Validation, HiddenCellsAreLeftOutAndTheirValuesWithThem) {
    CellSoup soup = smallSoup();
    soup.hidden.assign(135, 0);
    soup.hidden[0] = 1;
    soup.hidden[2] = 1;
    soup.fields.push_back({"v", Association::Cell, 2, std::vector<double>(270)});
    std::iota(soup.fields[1].values.begin(), soup.fields[1].values.end(), 0.0);
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::HiddenCell), (std::vector<std::uint64_t>{0, 2}));
    ASSERT_EQ(result.mesh.fields[1].values.size(), 266u);
    EXPECT_EQ(result.mesh.fields[1].values[0], 2.0);
    EXPECT_EQ(result.mesh.fields[1].values[3], 7.0);
}

TEST(Validation, UnusedPointsDoNotCount) {
    CellSoup soup = smallSoup();
    soup.points.insert(soup.points.begin(), glm::dvec3(1e30));
    soup.fields[0].values.insert(soup.fields[0].values.begin(), 1e30);
    for (std::uint32_t& p : soup.connectivity) {
        ++p;
    }
    ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::UnusedPoint), (std::vector<std::uint64_t>{0}));
    const ScalarSelection selection = selectScalar(std::move(result.mesh), "s", result.report);
    EXPECT_EQ(selection.mesh.bounds.high, glm::dvec3(1.0));
    EXPECT_EQ(selection.mesh.scalarMax, 1.0);
}

TEST(Validation, SurfacesAreNoSolids) {
    CellSoup soup = smallSoup();
    appendCell(soup, cell_type::triangle, Ids{0, 1, 2});
    EXPECT_EQ(tetMeshFromSoup(soup).report.skipped.at("not solid (triangle)"), 1u);
    CellSoup surface;
    surface.points = soup.points;
    appendCell(surface, cell_type::triangle, Ids{0, 1, 2});
    expectError([&] { tetMeshFromSoup(surface); }, "tetralux mesh");
}

TEST(Validation, NothingLeftIsAnError) {
    expectError([] { tetMeshFromSoup({}); }, "holds no cells");
    CellSoup soup = smallSoup();
    for (glm::dvec3& x : soup.points) {
        x.z = 0.0;
    }
    expectError([&] { tetMeshFromSoup(soup); }, "no solid cell is left of 135: 135 flat cell");
}

TEST(Validation, ArraysThatDoNotFitAreRefused) {
    CellSoup soup = smallSoup();
    soup.offsets[3] = 5000;
    expectError([&] { tetMeshFromSoup(soup); }, "do not fit together");
    soup = smallSoup();
    soup.fields[0].values.pop_back();
    expectError([&] { tetMeshFromSoup(soup); }, "field 's'");
    soup = smallSoup();
    soup.hidden.assign(3, 0);
    expectError([&] { tetMeshFromSoup(soup); }, "ghost flags");
    soup = smallSoup();
    soup.offsets.clear();
    expectError([&] { tetMeshFromSoup(soup); }, "do not fit together");
}

TEST(Validation, WrongNumberOfPointsForTheType) {
    CellSoup soup = smallSoup();
    appendCell(soup, cell_type::hexahedron, Ids{0, 1, 2, 3});
    appendCell(soup, 200, Ids{0, 1, 2, 3});
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_EQ(placesOf(result, Defect::UnsupportedCell), (std::vector<std::uint64_t>{135, 136}));
}

TEST(MergePoints, PiecesBecomeNeighbours) {
    CellSoup soup = smallSoup();
    CellSoup exploded;
    for (const std::uint32_t p : soup.connectivity) {
        exploded.points.push_back(soup.points[p]);
    }
    for (std::uint32_t i = 0; i < 135; ++i) {
        appendCell(exploded, cell_type::tetrahedron, Ids{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
    }
    addPointField(exploded, "s", linearField);
    const ReadResult result = tetMeshFromSoup(exploded);
    EXPECT_EQ(result.mesh.positions.size(), 64u);
    EXPECT_EQ(result.report.pointsMerged, 540u - 64u);
    EXPECT_EQ(countOf(result.report, Defect::CoincidentPoint), 0u);
    EXPECT_EQ(buildAdjacency(result.mesh.cells, 64).boundaryFaces, 108u);
}

TEST(MergePoints, JumpsOfTheFieldStayUnlessATolerance) {
    CellSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {1, 1e-7, 0}, {0, 0, -1}};
    appendCell(soup, cell_type::tetrahedron, Ids{0, 1, 2, 3});
    appendCell(soup, cell_type::tetrahedron, Ids{4, 5, 6, 7});
    soup.fields.push_back({"s", Association::Point, 1, {0, 0, 0, 0, 1, 1, 1, 1}});
    const ReadResult apart = tetMeshFromSoup(soup);
    EXPECT_EQ(apart.mesh.positions.size(), 8u);
    EXPECT_EQ(placesOf(apart, Defect::CoincidentPoint), (std::vector<std::uint64_t>{4, 5}));
    ReadOptions options;
    options.mergeTolerance = 1e-6;
    const ReadResult merged = tetMeshFromSoup(soup, options);
    EXPECT_EQ(merged.mesh.positions.size(), 5u);
    EXPECT_EQ(placesOf(merged, Defect::CoincidentPoint), (std::vector<std::uint64_t>{4, 5, 6}));
    options.mergeTolerance = 0.0;
    EXPECT_EQ(tetMeshFromSoup(soup, options).mesh.positions.size(), 6u);
    options.mergeTolerance = -1.0;
    expectError([&] { tetMeshFromSoup(soup, options); }, "merge tolerance");
}

TEST(MergePoints, ManyPointsAtOnePlaceTakeNoLonger) {
    // A writer's fault that files have: all unset positions are 0, or NaN. Every pair of them compared would take
    // hours.
    constexpr std::size_t more = 300000;
    for (const double place : {0.5, nan}) {
        CellSoup soup = smallSoup();
        soup.points.resize(64 + more, glm::dvec3(place));
        for (std::size_t p = 64; p < soup.points.size(); ++p) {
            soup.fields[0].values.push_back(static_cast<double>(p / 2));
        }
        const ReadResult result = tetMeshFromSoup(soup);
        EXPECT_EQ(result.report.pointsMerged, place == place ? more / 2 : 0);
        EXPECT_EQ(countOf(result.report, Defect::CoincidentPoint), place == place ? more / 2 - 1 : 0);
        EXPECT_EQ(result.mesh.cells.size(), 135u);
    }
}

TEST(SmoothCells, MeanOfTheCellsAroundEachPoint) {
    CellSoup soup = cubeGrid(
        2, 5, straight, [](CellSoup& s, const std::array<std::uint32_t, 8>& c) { appendCell(s, cell_type::voxel, c); });
    soup.fields.push_back({"c", Association::Cell, 1, {1, 2, 3, 4, 5, 6, 7, 36}});
    ReadOptions options;
    options.smoothCells = true;
    const ReadResult result = tetMeshFromSoup(soup, options);
    ASSERT_EQ(result.mesh.fields[0].association, Association::Point);
    for (std::size_t p = 0; p < result.mesh.positions.size(); ++p) {
        if (result.mesh.positions[p] == glm::dvec3(0.5)) {
            EXPECT_DOUBLE_EQ(result.mesh.fields[0].values[p], 8.0);
        }
        if (result.mesh.positions[p] == glm::dvec3(0.0)) {
            EXPECT_DOUBLE_EQ(result.mesh.fields[0].values[p], 1.0);
        }
    }
}

TEST(SelectScalar, ByNameComponentAndDefault) {
    const auto fresh = [] {
        ReadResult result = tetMeshFromSoup(smallSoup());
        Field vector{"v", Association::Point, 3, {}};
        for (const glm::dvec3& x : result.mesh.positions) {
            vector.values.insert(vector.values.end(), {3.0 * x.x, 4.0 * x.x, 0.0});
        }
        result.mesh.fields.insert(result.mesh.fields.begin(), vector);
        result.mesh.fields.insert(result.mesh.fields.begin(),
                                  {"ids", Association::Point, 1, std::vector<double>(64, 1.0), true});
        result.mesh.fields.push_back({"a:b", Association::Cell, 1, std::vector<double>(135, 2.0)});
        return result;
    };
    const auto select = [&](const std::string& name) {
        ReadResult result = fresh();
        return selectScalar(std::move(result.mesh), name, result.report);
    };
    EXPECT_EQ(select("").fieldName, "v (magnitude)");
    EXPECT_DOUBLE_EQ(select("v").mesh.scalarMax, 5.0);
    EXPECT_DOUBLE_EQ(select("v:1").mesh.scalarMax, 4.0);
    EXPECT_EQ(select("v:x").fieldName, "v (x)");
    EXPECT_EQ(select("a:b").mesh.association, Association::Cell);
    EXPECT_EQ(select("ids").mesh.scalarMin, 1.0);
    EXPECT_DOUBLE_EQ(select("z").mesh.scalarMax, 1.0);  // the coordinate
    expectError([&] { select("w"); }, "no field named 'w'; the mesh has 'ids' (points), 'v' (points, 3 components)");
    expectError([&] { select("v:3"); }, "has no component '3'");
    expectError([&] { select("v:q"); }, "has no component 'q'");
}

TEST(SelectScalar, NonFiniteCellsAreLeftOutAndCounted) {
    ReadResult result = tetMeshFromSoup(smallSoup());
    result.mesh.fields[0].values[0] = nan;
    const std::size_t touching = static_cast<std::size_t>(
        std::count_if(result.mesh.cells.begin(), result.mesh.cells.end(),
                      [](const Tetrahedron& t) { return std::count(t.begin(), t.end(), 0u); }));
    MeshReport report;
    const ScalarSelection selection = selectScalar(std::move(result.mesh), "s", report);
    EXPECT_EQ(selection.nonFiniteCells, touching);
    EXPECT_EQ(selection.mesh.cells.size(), 135 - touching);
    EXPECT_EQ(report.skipped.at("non-finite scalar"), touching);
    ReadResult filled = tetMeshFromSoup(smallSoup());
    filled.mesh.fields[0].values[0] = std::numeric_limits<double>::max();  // as some programs mark a missing value
    EXPECT_EQ(selectScalar(std::move(filled.mesh), "s", report).nonFiniteCells, touching);
    ReadResult all = tetMeshFromSoup(smallSoup());
    all.mesh.fields[0].values.assign(64, nan);
    expectError([&] { selectScalar(std::move(all.mesh), "s", report); }, "NaN, infinite or beyond 1e280 in every cell");
}

TEST(SelectScalar, MeshWithoutFieldsIsShownByItsLongestCoordinate) {
    CellSoup soup = smallSoup();
    soup.fields.clear();
    for (glm::dvec3& x : soup.points) {
        x.y *= 2.0;
    }
    ReadResult result = tetMeshFromSoup(soup);
    const ScalarSelection selection = selectScalar(std::move(result.mesh), "", result.report);
    EXPECT_EQ(selection.fieldName, "y");
    EXPECT_EQ(selection.mesh.scalarMax, 2.0);
}

TEST(CellGradient, IsThatOfTheLinearField) {
    ReadResult result = tetMeshFromSoup(smallSoup());
    for (std::size_t p = 0; p < 64; ++p) {
        result.mesh.fields[0].values[p] = linearField(result.mesh.positions[p]);
    }
    const ScalarSelection selection = selectScalar(std::move(result.mesh), "s", result.report);
    for (CellIndex cell = 0; cell < selection.mesh.cells.size(); ++cell) {
        const glm::dvec3 gradient = cellGradient(selection.mesh, cell);
        EXPECT_NEAR(gradient.x, 1.7, 1e-13);
        EXPECT_NEAR(gradient.y, -0.9, 1e-13);
        EXPECT_NEAR(gradient.z, 0.4, 1e-13);
    }
}

}  // namespace
}  // namespace tetralux::mesh
