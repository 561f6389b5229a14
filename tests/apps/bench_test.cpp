// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

#include <apps/bench_output.h>
#include <apps/bench_row.h>
#include <apps/bench_run.h>
#include <apps/bench_scene.h>
#include <apps/bench_statistics.h>
#include <apps/bench_vtk_rows.h>
#include <apps/plot.h>
#include <mesh/tet/procedural_field.h>
#include <preint/exact_integral.h>

namespace tetralux::apps {
namespace {

BenchRow row(const std::string& engine, std::vector<double> milliseconds, double rmse) {
    BenchRow result;
    result.subject = {"bucky:4", 135, 64, 48, "smooth", "standard"};
    result.engine = engine;
    result.frameMilliseconds = std::move(milliseconds);
    result.error.rmse = rmse;
    result.judged = true;
    return result;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

TEST(Median, IsTheMiddleOrTheMeanOfTwo) {
    EXPECT_EQ(median({7}), 7);
    EXPECT_EQ(median({9, 1, 5}), 5);
    EXPECT_EQ(median({8, 2, 4, 100}), 6);
    EXPECT_THROW(median({}), std::runtime_error);
}

// error
//   5  a            a, b, d stand on the front; c is beaten by b (equal error, slower),
//   3     b  c      e by d in both, f has no time, g is a's twin
//   1           d
//      1  2  3  4   time
TEST(ParetoFront, KeepsWhatNobodyBeats) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<TimeAndError> points{{4, 1}, {1, 5}, {3, 3}, {2, 3}, {5, 2}, {nan, 0}, {1, 5}};
    EXPECT_EQ(paretoFront(points), (std::vector<std::size_t>{1, 3, 0}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ParetoFront, IsMarkedSubjectBySubjectWithoutTheJudge) {
    std::vector<BenchRow> rows{row("fast", {1, 2, 30}, 1e-2), row("exact", {9}, 1e-6), row("poor", {10}, 1e-3),
                               row("reference", {0.5}, 0.0), row("poor", {10}, 1e-3)};
    rows.back().subject.width = 128;  // nobody else drew that
    markFronts(rows);
    EXPECT_TRUE(rows[0].onFront);
    EXPECT_TRUE(rows[1].onFront);
    EXPECT_FALSE(rows[2].onFront);
    EXPECT_FALSE(rows[3].onFront);
    EXPECT_TRUE(rows[4].onFront);
}

TEST(CellCount, TakesSuffixes) {
    EXPECT_EQ(parseCellCount("--cells", "0.15M"), 150'000u);
    EXPECT_EQ(parseCellCount("--cells", "20k"), 20'000u);
    EXPECT_EQ(parseCellCount("--cells", "148955"), 148'955u);
    for (const char* bad : {"", "M", "-1", "0", "1.5X", "2M2", "1e12"})
        EXPECT_THROW(parseCellCount("--cells", bad), std::runtime_error) << bad;
}

TEST(CellCount, GivesTheGridsOfTheRecord) {
    EXPECT_EQ(gridSizeFor(150'000), 32);
    EXPECT_EQ(gridSizeFor(1'250'000), 64);
    EXPECT_EQ(gridSizeFor(5'000'000), 101);
    EXPECT_EQ(benchSources({"bucky", "hydrogen:5", "a.vtu"}, {150'000, 5'000'000}),
              (std::vector<std::string>{"bucky:32", "bucky:101", "hydrogen:5", "a.vtu"}));
}

TEST(TransferFunctions, CoverTheRangeInEitherIntegral) {
    const auto mesh = readBenchMesh("bucky:12");
    for (const std::string& name : benchTransferFunctionNames()) {
        for (const auto mode : {projection::Mode::Standard, projection::Mode::ScaleInvariant}) {
            const preint::TransferFunction function = benchTransferFunction(name, *mesh, mode);
            EXPECT_FALSE(function.normalized);
            EXPECT_NO_THROW(preint::ExactIntegral{function}) << name;
        }
    }
    EXPECT_NEAR(largestExtinction(benchTransferFunction("smooth", *mesh, projection::Mode::Standard)), 25.0, 1e-12);
    EXPECT_THROW(benchTransferFunction("none", *mesh, projection::Mode::Standard), std::runtime_error);
}

TEST(TransferFunctions, SparseShowsOneCellInTwenty) {
    const auto mesh = readBenchMesh("bucky:24");
    const preint::TransferFunction function = benchTransferFunction("sparse", *mesh, projection::Mode::Standard);
    std::size_t shown = 0;
    for (mesh::CellIndex cell = 0; cell < mesh->cells.size(); ++cell) {
        bool shows = false;
        for (int k = 0; k < 4; ++k) shows |= function.extinctionAt(mesh->scalarAt(cell, k)) > 0.0;
        shown += shows ? 1 : 0;
    }
    const double share = static_cast<double>(shown) / static_cast<double>(mesh->cells.size());
    EXPECT_GT(share, 0.02);
    EXPECT_LE(share, 0.05);
}

// VTK's attenuation per unit distance over a length l must dim light as much as extinction does: nodes are the same,
// values are linear.
TEST(VtkTransferFunction, SaysTheSameIntegral) {
    const auto mesh = readBenchMesh("bucky:6");
    const preint::TransferFunction function = benchTransferFunction("smooth", *mesh, projection::Mode::Standard);
    const VtkTransferFunction vtk = vtkTransferFunction(function, *mesh);
    ASSERT_EQ(vtk.attenuation.size(), function.extinction.size());
    ASSERT_EQ(vtk.color.size(), vtk.attenuation.size());
    for (std::size_t i = 0; i < vtk.attenuation.size(); ++i) {
        const auto [scalar, attenuation] = vtk.attenuation[i];
        EXPECT_LE(attenuation, 1.0);
        EXPECT_NEAR(attenuation / vtk.unitDistance, function.extinctionAt(scalar), 1e-12);
    }
}

TEST(VtkTransferFunction, MakesTentsOfIsosurfaces) {
    const auto mesh = readBenchMesh("bucky:12");
    const preint::TransferFunction function = benchTransferFunction("peaks", *mesh, projection::Mode::Standard);
    const VtkTransferFunction vtk = vtkTransferFunction(function, *mesh);
    for (const preint::Isosurface& surface : function.isosurfaces) {
        const auto top = std::find_if(vtk.attenuation.begin(), vtk.attenuation.end(),
                                      [&](const auto& node) { return node[0] == surface.value; });
        ASSERT_NE(top, vtk.attenuation.end());
        EXPECT_GT((*top)[1], 0.0);
        EXPECT_EQ((*std::prev(top))[1], 0.0);
        EXPECT_EQ((*std::next(top))[1], 0.0);
    }
}

TEST(BenchCsv, HasAFieldPerColumnAndQuotes) {
    std::vector<BenchRow> rows{row("cpu", {3, 1, 2}, 1e-5), row("gl:egl", {}, 0)};
    rows[0].setting = "table 64, 1 thread";
    rows[0].stageMilliseconds = {{"draw", 1.5}, {"sort", 0.5}};
    rows[1].failure = "no \"EGL\" here";
    rows[1].judged = false;
    const std::vector<std::string> lines = split(benchCsv(rows), '\n');
    ASSERT_EQ(lines.size(), 3u);
    const std::size_t columns = split(lines[0], ',').size();
    EXPECT_NE(lines[1].find("\"table 64, 1 thread\""), std::string::npos);
    EXPECT_NE(lines[1].find(",3,2,1,0,draw=1.5;sort=0.5,"), std::string::npos)
        << lines[1];  // frames, median, least, processor, stages
    EXPECT_NE(lines[2].find("\"no \"\"EGL\"\" here\""), std::string::npos);
    EXPECT_EQ(split(lines[1], ',').size(), columns);  // one quoted comma more, the empty last field less
}

TEST(BenchJson, HoldsFiguresOrTheFailure) {
    std::vector<BenchRow> rows{row("cpu", {3, 1, 2}, 1e-5), row("gl:egl", {}, 0)};
    rows[0].fragments = 1000;
    rows[0].memoryOverMeshBytes = 1350;
    rows[1].failure = "no EGL";
    const nlohmann::json json = benchJson({{"cores", 2}}, rows);
    EXPECT_EQ(json["machine"]["cores"], 2);
    const nlohmann::json& first = json["rows"][0];
    EXPECT_EQ(first["ms"]["median"], 2.0);
    EXPECT_EQ(first["size"], nlohmann::json::array({64, 48}));
    EXPECT_EQ(first["error"]["rmse"], 1e-5);
    EXPECT_EQ(first["tetrahedra_per_s"], 135 / 0.002);
    EXPECT_EQ(first["fragments_per_s"], 500'000.0);
    EXPECT_EQ(rows[0].bytesPerTetrahedron(), 10.0);
    EXPECT_EQ(json["rows"][1]["failure"], "no EGL");
    EXPECT_FALSE(json["rows"][1].contains("ms"));
}

TEST(BenchTable, NamesEveryRow) {
    std::vector<BenchRow> rows{row("cpu", {2}, 1e-5), row("gl:egl", {}, 0)};
    rows[1].failure = "no EGL";
    markFronts(rows);
    const std::string table = benchTable(rows);
    EXPECT_NE(table.find("bucky:4  64x48  smooth  standard  135 tetrahedra"), std::string::npos);
    EXPECT_NE(table.find("* cpu"), std::string::npos);
    EXPECT_NE(table.find("not measured: no EGL"), std::string::npos);
}

TEST(BenchTable, SetsOurFastestAgainstTheirs) {
    const std::vector<BenchRow> rows{row("cpu", {2}, 1e-6), row("gl:egl", {9}, 1e-6), row("vtk:projected", {25}, 1e-3),
                                     row("vtk:zsweep", {99}, 1e-3)};
    EXPECT_NE(benchTable(rows).find("cpu is 12.5 times as fast as vtk:projected, at 0.001 times its rmse"),
              std::string::npos);
}

TEST(WrongPictures, AreFoundByErrorNotByTime) {
    std::vector<BenchRow> rows{row("cpu", {1e9}, 0.99e-4), row("vtk:projected", {1}, 0.1)};
    EXPECT_TRUE(wrongPictures(rows).empty());
    rows.push_back(row("gl:egl", {1}, 1.01e-4));
    rows.push_back(row("cpu", {1}, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(wrongPictures(rows).size(), 2u);
    rows = {row("cpu", {}, 0)};
    rows[0].failure = "cannot start";
    EXPECT_EQ(wrongPictures(rows).size(), 1u);  // nothing was drawn at all
}

TEST(Plot, EnclosesValuesByWholeDecades) {
    EXPECT_EQ(enclosingDecades({0.02, 5.0}).low, -2);
    EXPECT_EQ(enclosingDecades({0.02, 5.0}).high, 1);
    EXPECT_EQ(enclosingDecades({10.0, 10.0}).high, 2);
    EXPECT_EQ(enclosingDecades({0.0, -1.0}).high - enclosingDecades({0.0, -1.0}).low, 1);
}

TEST(Plot, PutsPointsWhereTheAxesSay) {
    std::vector<BenchRow> rows{row("cpu", {10}, 1e-4), row("gl:egl", {100}, 1e-2), row("reference", {1}, 0)};
    markFronts(rows);
    const Plot plot = benchPlot(rows);
    ASSERT_EQ(plot.panels.size(), 1u);
    ASSERT_EQ(plot.panels[0].points.size(), 2u);  // without the judge
    EXPECT_EQ(plot.series, (std::vector<std::string>{"cpu", "gl:egl"}));
    const std::string svg = plotAsSvg(plot);
    EXPECT_NE(svg.find("cpu: 10 ms, rmse 0.0001"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

TEST(Plot, RefusesOtherEndings) {
    EXPECT_THROW(checkPlotPath("plot.jpg"), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::apps
