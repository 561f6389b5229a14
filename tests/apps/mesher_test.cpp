// SPDX-License-Identifier: Apache-2.0
/// \file
/// The program tetralux-mesher as `tetralux mesh` starts it: surfaces and clouds of known volume, every defect by its
/// name, and files that are no such thing.
#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

#include <mesh/io/read_mesh.h>
#include <tests/support/program.h>

#include <apps/mesher/surface_defects.h>
#include <apps/mesher/tet_assembly.h>

#include "mesher_shapes.h"

namespace tetralux::tests {
namespace {

namespace fs = std::filesystem;

class Mesher : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / fmt::format("tetralux-mesher-{}-{}",
                                                          testing::UnitTest::GetInstance()->current_test_info()->name(),
                                                          ::getpid());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }

    Outcome run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), TETRALUX_MESHER_PROGRAM);
        return runProgram(arguments, folder_);
    }

    /// Exit 0, nothing on standard error, no file but the output; the mesh, all cells positive.
    mesh::TetMesh made(std::vector<std::string> arguments) const {
        const std::size_t before = count();
        arguments.insert(arguments.end(), {"-o", "out.vtu", "--report", "report.json"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        if (outcome.status != 0) throw std::runtime_error("no mesh was made");
        EXPECT_EQ(count(), before + 2);
        mesh::TetMesh mesh = mesh::readMesh((folder_ / "out.vtu").string()).mesh;
        EXPECT_EQ(mesh.cells.size(), report()["cells"]);
        for (const auto& c : mesh.cells)
            EXPECT_GT(mesh::sixVolumes(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]],
                                       mesh.positions[c[3]]),
                      0.0);
        return mesh;
    }

    nlohmann::json report() const { return nlohmann::json::parse(contentOf(folder_ / "report.json")); }

    /// Exit 2, one line that begins as every error does and holds all of `parts`, and no file more than before.
    void refused(std::vector<std::string> arguments, const std::vector<std::string>& parts) const {
        const std::size_t before = count();
        arguments.insert(arguments.end(), {"-o", "out.vtu"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("tetralux: ", 0), 0u) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        for (const std::string& part : parts)
            EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " in: " << outcome.err;
        EXPECT_EQ(count(), before);
    }

    std::size_t count() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

double volumeOf(const mesh::TetMesh& mesh) {
    double six = 0.0;
    for (const auto& c : mesh.cells)
        six += mesh::sixVolumes(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]], mesh.positions[c[3]]);
    return six / 6.0;
}

const mesh::Field& fieldOf(const mesh::TetMesh& mesh, const std::string& name) {
    for (const auto& field : mesh.fields)
        if (field.name == name) return field;
    throw std::runtime_error("no field " + name);
}

TEST_F(Mesher, FillsASphereInEveryFormat) {
    const TriangleSurface ball = sphere(glm::dvec3(1, 2, 3), 0.5, 3);
    write("ball.off", offText(ball));
    write("ball.obj", objText(ball));
    write("ball.ply", plyText(ball));
    write("ball.stl", stlBytes(ball));
    for (const char* name : {"ball.off", "ball.obj", "ball.ply", "ball.stl"}) {
        const mesh::TetMesh mesh = made({name});
        const double tolerance =
            std::string(name) == "ball.stl" ? 1e-5 : 1e-9;  // STL holds floats, at a distance from the origin
        EXPECT_NEAR(volumeOf(mesh) / mesher::enclosedVolume(ball), 1.0, tolerance) << name;
        const auto& distance = fieldOf(mesh, "distance").values;
        EXPECT_NEAR(*std::max_element(distance.begin(), distance.end()), 0.5, 0.15);
        EXPECT_LE(report()["surface"]["volume_error"], 1e-9);
        fs::remove(folder_ / "out.vtu");
        fs::remove(folder_ / "report.json");
    }
}

TEST_F(Mesher, BoundsOfVolumeAndQualityHold) {
    write("cube.off", offText(cube()));
    const mesh::TetMesh mesh = made({"cube.off", "--max-volume", "0.001", "--quality", "1.5"});
    EXPECT_GT(mesh.cells.size(), 1000u);
    for (const auto& c : mesh.cells)
        EXPECT_LE(
            mesh::sixVolumes(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]], mesh.positions[c[3]]),
            0.006 * (1 + 1e-9));
    // Right angles only: TetGen can keep the bound everywhere, but for its last flips (measured 1.58)
    EXPECT_LE(mesher::worstRadiusEdgeRatio(mesh), 1.1 * 1.5);
    EXPECT_NEAR(volumeOf(mesh), 1.0, 1e-9);
}

TEST_F(Mesher, FarAndTinySurfacesAreNoWorse) {
    write("far.off", offText(cube(glm::dvec3(1e6, -2e6, 5e5))));
    write("tiny.off", offText(cube(glm::dvec3(0.0), 1.0 / (1 << 30))));
    EXPECT_NEAR(volumeOf(made({"far.off", "--max-volume", "0.01"})), 1.0, 1e-6);
    fs::remove(folder_ / "out.vtu");
    fs::remove(folder_ / "report.json");
    const double size = 1.0 / (1 << 30);
    EXPECT_NEAR(volumeOf(made({"tiny.off"})) / (size * size * size), 1.0, 1e-9);
}

TEST_F(Mesher, CarriesALinearFieldThroughThePointsItAdds) {
    TriangleSurface ball = sphere(glm::dvec3(0.0), 1.0, 2);
    const auto f = [](const glm::dvec3& p) { return 2.0 * p.x - p.y + 3.0 * p.z + 10.0; };
    ball.fields = {{"heat", mesh::Association::Point, 1, {}}};
    for (const auto& p : ball.points) ball.fields[0].values.push_back(f(p));
    write("ball.ply", plyText(ball));
    const mesh::TetMesh mesh = made({"ball.ply", "--max-volume", "0.01", "--field", "double=2*heat"});
    EXPECT_GT(mesh.positions.size(), 2 * ball.points.size());
    const auto &heat = fieldOf(mesh, "heat").values, &twice = fieldOf(mesh, "double").values;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(heat[i], f(mesh.positions[i]), 1e-8);
        EXPECT_EQ(twice[i], 2.0 * heat[i]);
    }
}

TEST_F(Mesher, ValuesOnPolygonsAreNamedAndThoseOnPointsKept) {
    write("cube.vtp",
          R"(<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="8" NumberOfPolys="6">
<PointData><DataArray type="Float64" Name="heat" format="ascii">0 1 2 3 4 5 6 7</DataArray></PointData>
<CellData><DataArray type="Float64" Name="pressure" format="ascii">1 2 3 4 5 6</DataArray></CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">
0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8 12 16 20 24</DataArray></Polys>
</Piece></PolyData></VTKFile>)");
    const Outcome outcome = run({"cube.vtp", "-o", "cube.vtu", "--report", "report.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("left out: field pressure"), std::string::npos) << outcome.out;
    const auto report = nlohmann::json::parse(contentOf(folder_ / "report.json"));
    EXPECT_EQ(report["fields_left_out"], nlohmann::json::array({"pressure"}));
    EXPECT_EQ(report["fields"], nlohmann::json::array({"heat"}));
}

TEST_F(Mesher, CavitiesStayEmptyAndShellsMustFaceTheRightSide) {
    const TriangleSurface outer = sphere(glm::dvec3(0.0), 1.0, 3);
    TriangleSurface inner = sphere(glm::dvec3(0.1, 0.0, 0.0), 0.5, 2);
    write("two.off", offText(together(outer, inner)));
    refused({"two.off"}, {"two.off", "1 shell oriented to the wrong side", "--repair"});
    turn(inner);
    const TriangleSurface hollow = together(outer, inner);
    write("hollow.off", offText(hollow));
    const mesh::TetMesh mesh = made({"hollow.off"});
    EXPECT_NEAR(volumeOf(mesh) / mesher::enclosedVolume(hollow), 1.0, 1e-9);
    for (const auto& c : mesh.cells) {
        glm::dvec3 centre(0.0);
        for (const auto i : c) centre += 0.25 * mesh.positions[i];
        EXPECT_NEAR(mesher::windingNumber(hollow, centre), 1.0, 1e-6);
    }
    fs::remove(folder_ / "out.vtu");
    fs::remove(folder_ / "report.json");
    EXPECT_NEAR(volumeOf(made({"two.off", "--repair"})) / mesher::enclosedVolume(hollow), 1.0, 1e-9);
}

TEST_F(Mesher, ASurfaceThatFacesInwardIsTurned) {
    TriangleSurface ball = sphere(glm::dvec3(0.0), 1.0, 2);
    const double volume = mesher::enclosedVolume(ball);
    turn(ball);
    write("ball.off", offText(ball));
    EXPECT_NEAR(volumeOf(made({"ball.off"})) / volume, 1.0, 1e-9);
    EXPECT_EQ(report()["repairs"][0], "turned outward");
}

TEST_F(Mesher, EveryDefectIsRefusedByItsName) {
    TriangleSurface open = cube();
    open.triangles.pop_back();
    write("open.off", offText(open));
    refused({"open.off"}, {"open.off", "1 hole (3 edges, near (", "--repair"});

    write("crossing.off", offText(together(cube(), cube(glm::dvec3(0.5, 0.4, 0.3)))));
    refused({"crossing.off"}, {"self-intersections (first: triangles", "near ("});

    TriangleSurface fin = cube();
    fin.points.emplace_back(0.5, 0.5, -1.0);
    fin.triangles.push_back({0, 3, 8});
    write("fin.off", offText(fin));
    refused({"fin.off"}, {"1 non-manifold edge with more than two triangles (points 0 and 3 near (0, 0, 0))"});

    TriangleSurface mixed = cube();
    std::swap(mixed.triangles[4][1], mixed.triangles[4][2]);
    write("mixed.off", offText(mixed));
    refused({"mixed.off"}, {"3 edges whose triangles are oriented against each other", "--repair"});

    TriangleSurface flat = cube();
    flat.triangles.push_back({0, 1, 1});
    write("flat.off", offText(flat));
    refused({"flat.off"}, {"1 degenerate triangle (triangle 12"});

    TriangleSurface broken = cube();
    broken.points[3].z = std::nan("");
    write("nan.stl", stlBytes(broken));
    refused({"nan.stl"}, {"NaN or infinite coordinate"});
}

TEST_F(Mesher, RepairMendsAndSaysSo) {
    TriangleSurface open = cube();
    open.triangles.pop_back();
    std::swap(open.triangles[0][1], open.triangles[0][2]);
    open.triangles.push_back({0, 1, 1});
    open.fields = {{"warmth", mesh::Association::Point, 1, {}}};
    for (const auto& p : open.points) open.fields[0].values.push_back(p.x);
    write("open.ply", plyText(open));
    const mesh::TetMesh mesh = made({"open.ply", "--repair"});
    EXPECT_NEAR(volumeOf(mesh), 1.0, 1e-12);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_NEAR(fieldOf(mesh, "warmth").values[i], mesh.positions[i].x, 1e-9);
    const std::string repairs = report()["repairs"].dump(), defects = report()["defects"].dump();
    EXPECT_NE(repairs.find("1 hole filled with 1 triangles"), std::string::npos) << repairs;
    EXPECT_NE(repairs.find("1 collapsed or double triangle dropped"), std::string::npos) << repairs;
    for (const char* defect : {"1 hole", "1 degenerate triangle", "oriented against each other"})
        EXPECT_NE(defects.find(defect), std::string::npos) << defects;

    TriangleSurface sheet;  // one triangle: filled, it encloses nothing
    sheet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}};
    write("sheet.off", offText(sheet));
    fs::remove(folder_ / "out.vtu");
    fs::remove(folder_ / "report.json");
    refused({"sheet.off", "--repair"}, {"sheet.off"});
}

/// The corners of the unit cube and `n` points inside, with the value x + 2y + 3z.
std::string cloudText(int n, std::vector<glm::dvec3>& points) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.01, 0.99);
    points = cube().points;
    for (int i = 0; i < n; ++i) points.emplace_back(unit(random), unit(random), unit(random));
    std::string text = "s,x,y,z\n";
    for (const auto& p : points) text += fmt::format("{},{},{},{}\n", p.x + 2 * p.y + 3 * p.z, p.x, p.y, p.z);
    return text;
}

TEST_F(Mesher, CloudsBecomeDelaunayByEitherMethod) {
    std::vector<glm::dvec3> points;
    write("cloud.csv", cloudText(60, points));
    for (const char* name : {"cgal", "tetgen"}) {
        const mesh::TetMesh mesh = made({"cloud.csv", "--method", name});
        EXPECT_NEAR(volumeOf(mesh), 1.0, 1e-12) << name;
        EXPECT_EQ(mesh.positions.size(), points.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const auto& p = mesh.positions[i];
            EXPECT_DOUBLE_EQ(fieldOf(mesh, "s").values[i], p.x + 2 * p.y + 3 * p.z);
        }
        for (const auto& c : mesh.cells) {  // no point lies inside of any circumsphere
            const glm::dvec3 a = mesh.positions[c[0]], u = mesh.positions[c[1]] - a, v = mesh.positions[c[2]] - a,
                             w = mesh.positions[c[3]] - a;
            const double six = glm::dot(glm::cross(u, v), w);
            const glm::dvec3 centre = a + (glm::dot(u, u) * glm::cross(v, w) + glm::dot(v, v) * glm::cross(w, u) +
                                           glm::dot(w, w) * glm::cross(u, v)) /
                                              (2 * six);
            const double radius = glm::length(centre - a);
            for (const auto& p : mesh.positions) EXPECT_GE(glm::length(p - centre), radius * (1 - 1e-7));
        }
        fs::remove(folder_ / "out.vtu");
        fs::remove(folder_ / "report.json");
    }
}

TEST_F(Mesher, CloudsThatEncloseNothingAreRefused) {
    write("plane.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n1,1,0\n0.3,0.4,0\n");
    write("few.xyz", "0 0 0\n1 0 0\n0 1 0\n0 1 0\n");
    write("nan.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\nnan 0 1\n");
    write("word.csv", "x,y,z\n0,0,0\n1,two,3\n");
    for (const char* method : {"cgal", "tetgen"}) {
        refused({"plane.csv", "--method", method}, {"plane.csv", "plane"});
        refused({"few.xyz", "--method", method}, {"few.xyz", "3 different points"});
        refused({"nan.xyz", "--method", method}, {"nan.xyz", "point 4", "NaN"});
        refused({"word.csv", "--method", method}, {"word.csv", "line 3"});
    }
}

TEST_F(Mesher, TakesOtherMeshesAndCoarsensThem) {
    const mesh::TetMesh mesh = made({"bucky:12", "--target-cells", "3000", "--max-field-error", "0.2"});
    EXPECT_LE(mesh.cells.size(), 3000u);
    EXPECT_NEAR(volumeOf(mesh), 1.0, 1e-12);
    EXPECT_LE(report()["coarsening"]["max_field_error"], 0.2);
    EXPECT_EQ(report()["coarsening"]["cells_before"], 6655);
}

TEST_F(Mesher, AWrongCommandIsOneLine) {
    write("cube.off", offText(cube()));
    refused({"cube.off", "--nonsense"}, {"--nonsense", "tetralux mesh --help"});
    refused({"cube.off", "--quality", "0.5"}, {"--quality"});
    refused({"cube.off", "--max-volume", "-1"}, {"--max-volume"});
    refused({"cube.off", "--max-volume", "1e-30"}, {"--max-volume"});
    refused({"cube.off", "--field", "x +"}, {"--field 'x +'"});
    refused({"missing.off"}, {"missing.off"});
    refused({"missing.vtp"}, {"missing.vtp"});
    const Outcome wrongEnding = run({"cube.off", "-o", "cube.png"});
    EXPECT_EQ(wrongEnding.status, 2);
    EXPECT_NE(wrongEnding.err.find(".vtu"), std::string::npos);
    const Outcome noFolder = run({"cube.off", "-o", "nowhere/out.vtu"});
    EXPECT_EQ(noFolder.status, 2);
    EXPECT_EQ(noFolder.err.rfind("tetralux: nowhere/out.vtu: ", 0), 0u) << noFolder.err;
    EXPECT_EQ(run({"--help"}).status, 0);
}

TEST_F(Mesher, TheTimeLimitEndsItAndLeavesNothing) {
    write("ball.off", offText(sphere(glm::dvec3(0.0), 1.0, 4)));
    const auto start = std::chrono::steady_clock::now();
    refused({"ball.off", "--max-volume", "1e-8", "--time-limit", "1"},
            {"ball.off", "time limit of 1 s", "--time-limit"});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(Mesher, AnInterruptKillsTheWorkAndLeavesNothing) {
    write("ball.off", offText(sphere(glm::dvec3(0.0), 1.0, 4)));
    const std::size_t before = count();
    const pid_t child = ::fork();
    if (child == 0) {
        if (::chdir(folder_.c_str()) != 0) ::_exit(1);
        if (std::freopen("/dev/null", "w", stderr) == nullptr || std::freopen("/dev/null", "w", stdout) == nullptr)
            ::_exit(1);
        ::execl(TETRALUX_MESHER_PROGRAM, "tetralux-mesher", "ball.off", "-o", "out.vtu", "--max-volume", "1e-8",
                nullptr);
        ::_exit(1);
    }
    for (int i = 0; i < 200 && count() == before; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));  // its work folder
    EXPECT_GT(count(), before);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ::kill(child, SIGINT);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_EQ(count(), before);
}

/// No broken copy crashes it, hangs it or leaves a file: 7 each of truncated, bit-flipped and random bytes for every
/// format, seeds 0 to 6.
TEST_F(Mesher, BrokenFilesAreOneLineOrAMesh) {
    const TriangleSurface ball = sphere(glm::dvec3(0.0), 1.0, 1);
    std::vector<glm::dvec3> points;
    const std::vector<std::pair<std::string, std::string>> files{{"f.off", offText(ball)},
                                                                 {"f.obj", objText(ball)},
                                                                 {"f.ply", plyText(ball)},
                                                                 {"f.stl", stlBytes(ball)},
                                                                 {"f.csv", cloudText(20, points)}};
    for (const auto& [name, whole] : files) {
        for (unsigned seed = 0; seed < 21; ++seed) {
            std::mt19937 random(seed / 3);
            std::string bytes = whole;
            if (seed % 3 == 0) bytes.resize(random() % whole.size());
            if (seed % 3 == 1)
                for (int i = 0; i < 6; ++i) {
                    const std::size_t where =
                        random() % (i % 2 == 0 ? whole.size() : std::min<std::size_t>(whole.size(), 200));
                    bytes[where] = static_cast<char>(bytes[where] ^ (1 << random() % 8));
                }
            if (seed % 3 == 2)
                for (char& c : bytes) c = static_cast<char>(random());
            write(name, bytes);
            const Outcome outcome =
                run({name, "-o", "out.vtu", "--quiet", "--time-limit", "20", seed % 2 == 0 ? "--repair" : "--quiet"});
            EXPECT_TRUE(outcome.status == 0 || outcome.status == 2)
                << name << " seed " << seed << ": " << outcome.status;
            if (outcome.status == 2) {
                EXPECT_EQ(outcome.err.rfind("tetralux: ", 0), 0u) << outcome.err;
                EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
                EXPECT_EQ(outcome.err.find("time limit"), std::string::npos) << name << " seed " << seed;
                EXPECT_FALSE(fs::exists(folder_ / "out.vtu"));
            }
            fs::remove(folder_ / "out.vtu");
            fs::remove(folder_ / name);
            EXPECT_EQ(count(), 0u);
        }
    }
}

}  // namespace
}  // namespace tetralux::tests
