// SPDX-License-Identifier: Apache-2.0
//
// tetralux render, info and compare, from files to files.
#include <projection/image/image.h>

#include <cmath>
#include <functional>

#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using RenderCommand = CommandLine;
using projection::Image;
using projection::readImage;

TEST_F(RenderCommand, AMeshComesThroughStandardInput) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    write("noise", "no mesh");
    const auto withInput = [&](const std::string& options, const std::string& input) {
        return runProgram({"/bin/sh", "-c", std::string(TETRALUX_PROGRAM) + " " + options + " < " + input}, path(""));
    };
    const std::string options = "--size 16x16 --range all --quiet";  // reads it twice, were it a series
    expectGood("render corner.vtu -o file.exr " + options);
    EXPECT_EQ(withInput("render - -o piped.exr " + options, "corner.vtu").status, 0);
    EXPECT_EQ(contentOf(path("piped.exr")), contentOf(path("file.exr")));
    EXPECT_EQ(withInput("info -", "noise").status, 2);
    EXPECT_EQ(withInput("info -", "noise").err.rfind("tetralux: -: standard input holds no .vtu", 0), 0u);
    EXPECT_EQ(withInput("info -", "/dev/null").err.rfind("tetralux: -: standard input is empty", 0), 0u);
}

TEST_F(RenderCommand, FromFileToPixelByTheClosedForm) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    expectGood(std::string("render corner.vtu -o a.exr --tf constant.json") + lineView);
    const double alpha = 1.0 - std::exp(-0.7);  // a length of 1 in the cell
    const Image image = readImage(path("a.exr"));
    ASSERT_EQ(image.pixels.size(), 1u);
    const double expected[4] = {alpha, 0.5 * alpha, 0.25 * alpha, alpha};
    for (int channel = 0; channel < 4; ++channel) EXPECT_NEAR(image.at(0, 0)[channel], expected[channel], 2e-6);
}

TEST_F(RenderCommand, BackgroundIsPutUnderLast) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = std::string("render corner.vtu --tf constant.json --background 0,1,1") + lineView;
    expectGood(render + " -o a.exr");
    expectGood(render + " -o a.png");
    const double alpha = 1.0 - std::exp(-0.7);
    const double expected[4] = {alpha, 0.5 * alpha + (1 - alpha), 0.25 * alpha + (1 - alpha), 1.0};
    for (int channel = 0; channel < 4; ++channel) {
        EXPECT_NEAR(readImage(path("a.exr")).at(0, 0)[channel], expected[channel], 2e-6);
        EXPECT_NEAR(readImage(path("a.png")).at(0, 0)[channel], expected[channel], 0.5 / 255 + 1e-6);
    }
}

TEST_F(RenderCommand, DefectiveCellsAreLeftOutOrTurnedAndCounted) {
    // The corner tetrahedron, inverted; a flat one; one with a NaN, which also lies on the line of sight.
    TinyMesh mesh = cornerTetrahedron(5);
    mesh.cells[0] = {0, 2, 1, 3};
    mesh.points.insert(mesh.points.end(), {{1, 1, 0}, {2, 1, 0}, {0, 0, -2}});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    mesh.values.insert(mesh.values.end(), {5, 5, nan});
    mesh.cells.push_back({0, 1, 2, 4});
    mesh.cells.push_back({0, 2, 1, 6});
    write("defects.vtu", vtuText(mesh));
    const Outcome outcome =
        tetralux(std::string("render defects.vtu -o a.exr --tf constant.json --report r.json") + lineView);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - std::exp(-0.7), 2e-6);

    const nlohmann::json report = json("r.json");
    EXPECT_EQ(report["cells"]["read"], 3);
    EXPECT_EQ(report["cells"]["drawn"], 1);
    std::uint64_t skipped = 0;
    for (const auto& [reason, count] : report["cells"]["skipped"].items()) skipped += count.get<std::uint64_t>();
    EXPECT_EQ(skipped, 2u) << report["cells"].dump();
    EXPECT_EQ(report["cells"]["skipped"]["non-finite scalar"], 1);
    EXPECT_EQ(report["defects"]["non-finite scalar"]["count"], 1);
    EXPECT_EQ(report["defects"]["flat cell"]["count"], 1);
    EXPECT_EQ(report["defects"]["inverted cell"]["count"], 1);
    EXPECT_NE(outcome.out.find("1 flat cell"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("non-finite scalar"), std::string::npos) << outcome.out;
}

TEST_F(RenderCommand, CellsThatOverlapAreReported) {
    TinyMesh mesh = cornerTetrahedron(5);
    const TinyMesh other = mesh;
    for (const auto& [x, y, z] : other.points) mesh.points.push_back({x + 0.1, y + 0.1, z + 0.1});
    mesh.values.insert(mesh.values.end(), other.values.begin(), other.values.end());
    mesh.cells.push_back({4, 5, 6, 7});
    write("overlap.vtu", vtuText(mesh));
    const Outcome outcome = tetralux("render overlap.vtu -o a.exr --size 8x8 --report r.json");
    EXPECT_NE(outcome.out.find("2 overlapping cells (the first: 0, 1)"), std::string::npos) << outcome.out;
    const nlohmann::json report = json("r.json");
    EXPECT_EQ(report["defects"]["overlapping cell"]["count"], 2);
    EXPECT_EQ(report["interfaces_checked"], true);
}

TEST_F(RenderCommand, LargeMeshesAreCheckedForOverlapsWhenAsked) {
    std::string volume =
        "# vtk DataFile Version 3.0\nvolume\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 40 40 40\nORIGIN 0 0 0\n"
        "SPACING 1 1 1\nPOINT_DATA 64000\nSCALARS s float 1\nLOOKUP_TABLE default\n";
    for (int i = 0; i < 64000; ++i) volume += i % 40 < 20 ? "0 " : "1 ";
    write("large.vtk", volume);
    const std::string render = "render large.vtk -o a.png --size 8x8 --report r.json";
    EXPECT_NE(tetralux(render).out.find("--check does it"), std::string::npos);
    EXPECT_EQ(json("r.json")["interfaces_checked"], false);
    EXPECT_EQ(tetralux(render + " --check").out.find("--check does it"), std::string::npos);
    EXPECT_EQ(json("r.json")["interfaces_checked"], true);
    // a generated grid fits
    EXPECT_EQ(tetralux("render bucky:40 -o a.png --size 8x8").out.find("--check"), std::string::npos);
}

TEST_F(RenderCommand, ReportHoldsWhatIsPromised) {
    expectGood(
        "render bucky:6 -o a.png --size 20x10 --frames 3 --report r.json --engine reference --mode scale-invariant");
    const nlohmann::json report = json("r.json");
    EXPECT_EQ(report["engine"], "reference");
    EXPECT_TRUE(report["renderer"].is_string());
    EXPECT_EQ(report["cells"]["read"], 5 * 5 * 5 * 5);
    EXPECT_TRUE(report["cells"]["skipped"].is_object());
    EXPECT_GT(report["cells"]["drawn"], 0);
    EXPECT_GE(report["ms"]["read"], 0.0);
    EXPECT_GE(report["ms"]["prepare"], 0.0);
    ASSERT_EQ(report["ms"]["frame"].size(), 3u);
    for (const auto& time : report["ms"]["frame"]) EXPECT_GT(time, 0.0);
    EXPECT_EQ(report["pixels"]["wrong"], 0);
    EXPECT_TRUE(report["pixels"]["repaired"].is_number_unsigned());
    EXPECT_GT(report["peak_memory_bytes"], 1 << 20);
    EXPECT_LT(report["peak_memory_bytes"], std::int64_t{1} << 36);
    EXPECT_EQ(report["size"], nlohmann::json({20, 10}));
    EXPECT_EQ(report["mode"], "scale-invariant");
    EXPECT_EQ(report["scalar"]["name"], "density");
}

TEST_F(RenderCommand, FramesTurnOnceAboutUp) {
    const std::string common = " --size 24x24 --engine reference --quiet ";
    expectGood("render bucky:6 -o a.exr --frames 4 --eye 0.5,0.5,3" + common);
    for (const char* name : {"a_0000.exr", "a_0001.exr", "a_0002.exr", "a_0003.exr"}) EXPECT_TRUE(exists(name)) << name;
    EXPECT_FALSE(exists("a.exr"));
    EXPECT_FALSE(exists("a_0004.exr"));
    // A quarter of a turn about y takes +z to +x.
    for (const auto& [eye, frame] : {std::pair("0.5,0.5,3", "a_0000.exr"), std::pair("3,0.5,0.5", "a_0001.exr"),
                                     std::pair("0.5,0.5,-2", "a_0002.exr"), std::pair("-2,0.5,0.5", "a_0003.exr")}) {
        expectGood(fmt::format("render bucky:6 -o one.exr --eye {}{}", eye, common));
        EXPECT_LT(projection::compareImages(readImage(path("one.exr")), readImage(path(frame))).max, 1e-5) << frame;
    }
}

TEST_F(RenderCommand, PngIsTheFloatImageOverBlack) {
    const std::string common = "render bucky:6 --size 24x24 --engine reference --quiet -o ";
    expectGood(common + "a.exr");
    expectGood(common + "a.png");
    Image image = readImage(path("a.exr"));
    EXPECT_EQ(image.at(0, 0).w, 0.0f) << "nothing behind the mesh";
    projection::putUnder(image, glm::vec3(0));
    EXPECT_LE(projection::compareImages(image, readImage(path("a.png"))).max, 0.5 / 255 + 1e-6);
}

TEST_F(RenderCommand, DefaultViewHoldsTheWholeMesh) {
    write("opaque.json", R"({"color": [[0, 1, 1, 1]], "extinction": [[0, 1000]]})");
    for (const char* size : {"32x32", "64x20", "20x64"}) {
        expectGood(fmt::format("render bucky:4 -o a.exr --tf opaque.json --engine reference --size {}", size));
        const Image image = readImage(path("a.exr"));
        int covered = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const bool seen = image.at(x, y).w > 0.5f;
                covered += seen ? 1 : 0;
                const bool onBorder = x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1;
                EXPECT_FALSE(seen && onBorder) << size << ": " << x << ", " << y;
            }
        EXPECT_GT(covered, 20 * 20 / 5) << size;
    }
}

/// Tetrahedra of the cubes of an n³ grid for which `keep` holds, in a unit of their own, with s = `value`.
TinyMesh cubes(int n, double unit, const std::function<bool(int, int, int)>& keep,
               const std::function<double(double, double, double)>& value) {
    TinyMesh mesh;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                mesh.points.push_back({unit * i, unit * j, unit * k});
                mesh.values.push_back(value(i, j, k));
            }
    const auto at = [n](int i, int j, int k) { return i + (n + 1) * (j + (n + 1) * k); };
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                if (!keep(i, j, k)) continue;
                int c[8];
                for (int b = 0; b < 8; ++b) c[b] = at(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2));
                const int inner[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
                for (const auto& edge : inner) mesh.cells.push_back({c[0], c[edge[0]], c[edge[1]], c[7]});
            }
    return mesh;
}

TEST_F(RenderCommand, UnitsDoNotChangeTheDefaultPicture) {
    const auto whole = [](int, int, int) { return true; };
    const auto slope = [](double x, double y, double z) { return x + 0.3 * y * y + 0.1 * z; };
    for (const double unit : {1e-6, 1.0, 1e6}) {
        write("a.vtu", vtuText(cubes(3, unit, whole, slope)));
        expectGood(fmt::format("render a.vtu -o {:g}.exr --size 24x24 --engine reference", unit));
    }
    const Image one = readImage(path("1.exr"));
    for (const char* other : {"1e-06.exr", "1e+06.exr"})
        EXPECT_LE(projection::compareImages(readImage(path(other)), one).max, 1e-5) << other;  // coordinates round
}

/// A thin sheet along the diagonal of its box, and a block that has low values almost everywhere: both show.
TEST_F(RenderCommand, TheDefaultPictureShowsThinPartsAndLowValues) {
    const auto opacity = [&](const TinyMesh& mesh) {
        write("a.vtu", vtuText(mesh));
        expectGood("render a.vtu -o a.exr --size 32x32 --engine reference");
        const Image image = readImage(path("a.exr"));
        double sum = 0, covered = 0;
        for (const glm::vec4& pixel : image.pixels) {
            sum += pixel.w;
            covered += pixel.w > 0 ? 1 : 0;
        }
        return sum / covered;
    };
    const auto diagonal = [](int i, int j, int) { return i == j; };
    EXPECT_GT(opacity(cubes(10, 1.0, diagonal, [](double x, double, double) { return x; })), 0.5);
    const auto whole = [](int, int, int) { return true; };
    const auto corner = [](double x, double y, double z) { return x + y + z < 1.5 ? 100.0 : 1.0; };
    EXPECT_GT(opacity(cubes(10, 1.0, whole, corner)), 0.35);  // pixels at the rim see little; 0.2 without
}

TEST_F(RenderCommand, VerifyMeasuresTheError) {
    expectGood(
        "render bucky:6 -o a.exr --size 16x16 --engine reference --verify 40 --background 1,1,1 --report r.json");
    const nlohmann::json report = json("r.json");
    EXPECT_EQ(report["verification"]["pixels"], 40);
    EXPECT_LT(report["verification"]["max"], 1e-6) << "the reference against itself, in single precision";
}

TEST_F(RenderCommand, MaxErrorDecidesTheStatus) {
    const std::string common = "render bucky:6 -o a.exr --size 32x32 --engine cpu --table-error 0.1 --report r.json ";
    expectGood(common + "--max-error 0.5");
    nlohmann::json found = json("r.json")["verification"];
    EXPECT_EQ(found["pixels"], 1000) << "of 1024";
    EXPECT_EQ(found["unseen"], 24);
    EXPECT_EQ(found["within"], true);
    EXPECT_GE(found["rmse_bound"], found["rmse"]);

    std::filesystem::remove(path("a.exr"));
    const Outcome outcome = tetralux(common + "--max-error 1e-12 --verify 300 --frames 2");
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(outcome.err.find("--max-error 1e-12"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    EXPECT_TRUE(exists("a_0001.exr")) << "the pictures are there all the same";
    found = json("r.json")["verification"];
    EXPECT_EQ(found["within"], false);
    EXPECT_EQ(found["pixels"], 300);
    EXPECT_EQ(found["max_error"], 1e-12);

    expectGood("render bucky:4 -o a.exr --size 8x8 --engine reference --max-error 0.001 --verify");
    expectGood("render bucky:4 -o a.exr --size 64x64 --engine cpu --max-error 1e-4 --report r.json");
    EXPECT_GE(json("r.json")["verification"]["pixels"], 0.95 * 64 * 64) << "as many as it takes";
    expectRefused("render bucky:4 -o a.exr --max-error -1", {"--max-error", "a number from 0"});
}

// Twenty pixels without an error say nothing of the other thousand.
TEST_F(RenderCommand, MaxErrorIsNotVouchedForByAFewPixels) {
    const Outcome outcome = tetralux(
        "render bucky:6 -o a.exr --size 32x32 --engine reference --verify 20 --max-error 1e-4 --report r.json");
    EXPECT_EQ(outcome.status, 3);
    for (const char* part : {"1004 of 1024 pixels were not seen", "--verify 973"})
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("1004 were not seen, of which at most"), std::string::npos) << outcome.out;
    const nlohmann::json found = json("r.json")["verification"];
    EXPECT_EQ(found["unseen"], 1004);
    EXPECT_EQ(found["pixels_needed"], 973);
    EXPECT_GT(found["rmse_bound"], 0.1);
}

TEST_F(RenderCommand, ATableThatMissesItsErrorSaysSo) {
    const std::string common = "render bucky:6 -o a.exr --size 8x8 --engine gl --quiet --report r.json ";
    const Outcome coarse = tetralux(common + "--table-size 4");
    EXPECT_EQ(coarse.status, 0);
    EXPECT_NE(coarse.err.find("--table-error 0.0001: a table"), std::string::npos) << coarse.err;
    EXPECT_NE(coarse.err.find("--table-size"), std::string::npos) << coarse.err;
    const nlohmann::json table = json("r.json")["table"];
    EXPECT_EQ(table["wanted_error"], 1e-4);
    EXPECT_EQ(table["within"], false);
    EXPECT_GT(table["measured_error"], 1e-4);
    const Outcome fine = tetralux(common);
    EXPECT_EQ(fine.err, "");
    EXPECT_EQ(json("r.json")["table"]["within"], true);
}

TEST_F(RenderCommand, OrderIsChosenForMeasuring) {
    for (const auto& [order, method] : {std::pair("auto", "power"), {"graph", "mpvo"}, {"centroid", "centroid"}}) {
        expectGood(fmt::format("render bucky:4 -o a.exr --size 8x8 --report r.json --engine cpu --order {}", order));
        EXPECT_EQ(json("r.json")["order"]["method"], method);
    }
    expectRefused("render bucky:4 -o a.exr --order best", {"--order", "best", "auto, graph, centroid"});
}

TEST_F(RenderCommand, QuietSaysNothing) {
    const Outcome outcome = tetralux("render bucky:4 -o a.png --size 8x8 --engine reference --frames 2 --quiet");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(RenderCommand, AutoDrawsOnThisMachine) {
    expectGood("render bucky:4 -o a.png --size 16x16");
}

TEST_F(RenderCommand, EveryModeDraws) {
    for (const char* mode : {"standard", "scale-invariant", "mip", "average", "first-hit"}) {
        expectGood(fmt::format(
            "render bucky:6 -o a.exr --size 16x16 --engine reference --mode {} --silhouette --light -1,.5,2 "
            "--light 1,0,0 --ambient 0.2 --exponent 8 --no-transmission",
            mode));
        float most = 0;
        for (const glm::vec4& pixel : readImage(path("a.exr")).pixels) most = std::max(most, pixel.w);
        EXPECT_GT(most, 0.1f) << mode;
    }
}

TEST_F(RenderCommand, RelativePathsAreThoseOfTheWorkingFolder) {
    std::filesystem::create_directory(folder_ / "below");
    const Outcome outcome =
        tetraluxIn(folder_ / "below", "render bucky:4 -o ../a.png --size 8x8 --engine reference --tf ../constant.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(exists("a.png"));
}

TEST_F(RenderCommand, AnOldPictureSurvivesAFailedRun) {
    expectGood("render bucky:4 -o a.png --size 8x8 --engine reference");
    const std::string before = contentOf(path("a.png"));
    expectRefused("render missing.vtu -o a.png", {"missing.vtu"});
    EXPECT_EQ(contentOf(path("a.png")), before);
}

TEST_F(RenderCommand, InfoTellsCellsFieldsAndDefects) {
    const Outcome text = tetralux("info bucky:5");
    EXPECT_EQ(text.status, 0);
    for (const char* part : {"bucky:5", "320 tetrahedr", "125", "density", "defects: none"})
        EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
    const nlohmann::json info = nlohmann::json::parse(tetralux("info bucky:5 --json").out);
    EXPECT_EQ(info["tetrahedra"], 320);
    EXPECT_EQ(info["fields"][0]["name"], "density");
    EXPECT_EQ(info["fields"][0]["max"], 1.0);

    TinyMesh mesh = cornerTetrahedron(5);
    mesh.cells.push_back({0, 1, 2, 2});
    write("flat.vtu", vtuText(mesh));
    const Outcome flat = tetralux("info flat.vtu");
    EXPECT_EQ(flat.status, 0) << flat.err;
    EXPECT_NE(flat.out.find("1 flat cell"), std::string::npos) << flat.out;
}

TEST_F(RenderCommand, CompareMeasures) {
    Image a(4, 4), b(4, 4);
    b.at(1, 2).x = 0.5f;
    projection::writeImage(a, path("a.exr"));
    projection::writeImage(b, path("b.exr"));
    const nlohmann::json difference = nlohmann::json::parse(tetralux("compare a.exr b.exr --json").out);
    EXPECT_NEAR(difference["max"], 0.5, 1e-12);
    EXPECT_NEAR(difference["rmse"], std::sqrt(0.25 / 64), 1e-12);
    EXPECT_NEAR(difference["psnr"], -10 * std::log10(0.25 / 64), 1e-9);
    const Outcome text = tetralux("compare a.exr b.exr");
    EXPECT_NE(text.out.find("max   0.5\n"), std::string::npos) << text.out;
    EXPECT_EQ(text.status, 0);
    EXPECT_EQ(tetralux("compare a.exr b.exr --max-error 0.6 --max-rmse 0.1").status, 0);
    EXPECT_EQ(tetralux("compare a.exr b.exr --max-error 0.4").status, 1);
    EXPECT_EQ(tetralux("compare a.exr b.exr --max-rmse 0.01").status, 1);
    EXPECT_EQ(tetralux("compare a.exr a.exr --max-error 0").status, 0);
}

TEST_F(RenderCommand, HelpAndVersionAreNoErrors) {
    for (const char* line : {"--help", "render --help", "info --help", "compare --help", "--version"}) {
        const Outcome outcome = tetralux(line);
        EXPECT_EQ(outcome.status, 0) << line;
        EXPECT_EQ(outcome.err, "") << line;
        EXPECT_NE(outcome.out, "") << line;
    }
}

}  // namespace
}  // namespace tetralux::tests
