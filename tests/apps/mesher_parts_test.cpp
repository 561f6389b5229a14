// SPDX-License-Identifier: Apache-2.0
/// \file
/// The mesher's own parts, without TetGen and CGAL.
#include <gtest/gtest.h>

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <mesh/tet/procedural_field.h>

#include <apps/mesher/carry_field.h>
#include <apps/mesher/child_process.h>
#include <apps/mesher/generated_field.h>
#include <apps/mesher/polydata_vtk.h>
#include <apps/mesher/read_points_text.h>
#include <apps/mesher/simplify.h>
#include <apps/mesher/surface_defects.h>
#include <apps/mesher/surface_locator_vtk.h>
#include <apps/mesher/tet_assembly.h>

#include "mesher_shapes.h"

namespace tetralux::tests {
namespace {

using namespace mesher;

std::uint64_t countOf(const SurfaceFindings& findings, SurfaceDefect defect) {
    for (const auto& f : findings)
        if (f.defect == defect) return f.count;
    return 0;
}

/// n×n×n points of the unit cube with the value f.
template <class F>
mesh::TetMesh grid(int n, const F& f) {
    mesh::TetMesh mesh = mesh::sampleOnGrid(mesh::proceduralField("bucky", n), n);
    mesh.fields = {{"s", mesh::Association::Point, 1, {}}};
    for (const auto& p : mesh.positions) mesh.fields[0].values.push_back(f(p));
    return mesh;
}

double volumeOf(const mesh::TetMesh& mesh) {
    double six = 0.0;
    for (const auto& c : mesh.cells)
        six += mesh::sixVolumes(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]], mesh.positions[c[3]]);
    return six / 6.0;
}

bool allPositive(const mesh::TetMesh& mesh) {
    return std::all_of(mesh.cells.begin(), mesh.cells.end(), [&](const auto& c) {
        return mesh::sixVolumes(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]],
                                mesh.positions[c[3]]) > 0.0;
    });
}

TEST(SurfaceDefects, ACubeHasNone) {
    EXPECT_TRUE(checkTopology(cube()).empty());
}

TEST(SurfaceDefects, EachIsCountedByItsName) {
    TriangleSurface open = cube();
    open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);  // the face z = 0
    EXPECT_EQ(countOf(checkTopology(open), SurfaceDefect::Hole), 1u);
    open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);  // and z = 1
    EXPECT_EQ(countOf(checkTopology(open), SurfaceDefect::Hole), 2u);
    EXPECT_NE(describe(checkTopology(open)).find("2 holes (the largest: 4 edges, near ("), std::string::npos);

    TriangleSurface turned = cube();
    std::swap(turned.triangles[0][1], turned.triangles[0][2]);
    EXPECT_EQ(countOf(checkTopology(turned), SurfaceDefect::InconsistentEdge), 3u);

    TriangleSurface fin = cube();
    fin.points.emplace_back(0.5, 0.5, -1.0);
    fin.triangles.push_back({0, 3, 8});  // on the diagonal of the face z = 0
    EXPECT_EQ(countOf(checkTopology(fin), SurfaceDefect::NonManifoldEdge), 1u);

    TriangleSurface twice = cube();
    twice.triangles.push_back({2, 3, 0});
    EXPECT_EQ(countOf(checkTopology(twice), SurfaceDefect::DuplicateTriangle), 1u);

    TriangleSurface flat = cube();
    flat.triangles.push_back({0, 0, 1});
    EXPECT_EQ(countOf(checkTopology(flat), SurfaceDefect::DegenerateTriangle), 1u);

    TriangleSurface broken = cube();
    broken.points[5].y = std::nan("");
    const SurfaceFindings found = checkTopology(broken);
    ASSERT_EQ(found.size(), 1u);  // nothing else can be told
    EXPECT_EQ(found[0].defect, SurfaceDefect::NonFinitePoint);
    EXPECT_EQ(found[0].where, "point 5");
}

TEST(SurfaceDefects, VolumeAndWindingNumberKnowInsideCavityAndOutside) {
    EXPECT_DOUBLE_EQ(enclosedVolume(cube()), 1.0);
    EXPECT_DOUBLE_EQ(enclosedVolume(cube(glm::dvec3(1e7, -1e7, 3e6))), 1.0);
    TriangleSurface inner = cube(glm::dvec3(0.25), 0.5);
    turn(inner);
    const TriangleSurface hollow = together(cube(), inner);
    EXPECT_DOUBLE_EQ(enclosedVolume(hollow), 1.0 - 0.125);
    EXPECT_NEAR(windingNumber(hollow, glm::dvec3(0.1)), 1.0, 1e-12);
    EXPECT_NEAR(windingNumber(hollow, glm::dvec3(0.5)), 0.0, 1e-12);
    EXPECT_NEAR(windingNumber(hollow, glm::dvec3(2.0)), 0.0, 1e-12);
}

TEST(SurfaceDefects, CoincidentPointsBecomeOneAndKeepTheFirstValue) {
    TriangleSurface s;
    const TriangleSurface whole = cube();
    for (const Triangle& t : whole.triangles) {
        for (const auto i : t) s.points.push_back(whole.points[i]);
        const auto n = static_cast<std::uint32_t>(s.points.size());
        s.triangles.push_back({n - 3, n - 2, n - 1});
    }
    s.fields = {{"v", mesh::Association::Point, 2, {}}};
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.fields[0].values.insert(s.fields[0].values.end(), {s.points[i].x, double(i)});
    EXPECT_EQ(mergeCoincidentPoints(s), 36u - 8u);
    EXPECT_EQ(s.points.size(), 8u);
    EXPECT_TRUE(checkTopology(s).empty());
    ASSERT_EQ(s.fields[0].values.size(), 16u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(s.fields[0].values[2 * i], s.points[i].x);
    EXPECT_EQ(s.fields[0].values[1], 0.0);
}

TEST(Polygons, NonconvexPolygonsKeepTheirArea) {
    PolygonSoup soup;  // an arrow head: area 1, and the fan from its first point would leave it
    soup.points = {{1, 0.5, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}};
    soup.polygons = {{1, 2, 3, 0}};
    const TriangleSurface s = triangulatePolygons(soup);
    ASSERT_EQ(s.triangles.size(), 2u);
    glm::dvec3 area(0.0);
    double absolute = 0.0;
    for (const Triangle& t : s.triangles) {
        const glm::dvec3 n = 0.5 * glm::cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
        area += n;
        absolute += glm::length(n);
    }
    EXPECT_NEAR(area.z, absolute, 1e-12);  // none is turned over
}

TEST(SurfaceLocator, AgreesWithTryingEveryTriangle) {
    const TriangleSurface s = sphere(glm::dvec3(0.3, -0.2, 0.1), 1.0, 3);
    const SurfaceLocator locator(s);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1.5, 1.5);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p(unit(random), unit(random), unit(random));
        const auto found = locator.nearest(p);
        const Triangle& t = s.triangles[found.triangle];
        glm::dvec3 q(0.0);
        for (std::size_t k = 0; k < 3; ++k) q += found.weights[k] * s.points[t[k]];
        EXPECT_NEAR(glm::length(q - p), found.distance, 1e-12);
        // Independent: the distance to a dense sampling of all triangles is never smaller.
        double least = 1e300;
        for (const Triangle& u : s.triangles)
            for (int a = 0; a <= 8; ++a)
                for (int b = 0; a + b <= 8; ++b)
                    least = std::min(least, glm::length(p - (s.points[u[0]] * (a / 8.0) + s.points[u[1]] * (b / 8.0) +
                                                             s.points[u[2]] * ((8 - a - b) / 8.0))));
        EXPECT_LE(found.distance, least + 1e-12);
        EXPECT_GE(found.distance, least - 0.03);
    }
}

TEST(CarryField, LinearFieldsAreExactInside) {
    const auto f = [](const glm::dvec3& p) { return 3.0 * p.x - 2.0 * p.y + p.z + 1e3; };
    mesh::TetMesh mesh = grid(9, f);
    TriangleSurface given = boundaryOf(mesh);
    given.fields = mesh.fields;
    std::vector<std::uint32_t> source(mesh.positions.size(),
                                      static_cast<std::uint32_t>(mesh.positions.size()));  // all new
    for (const Triangle& t : given.triangles)
        for (const auto i : t) source[i] = i;
    const auto fields = carryFields(given, mesh, source, true);
    const auto byPlace = carryFields(given, mesh, source, false);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        inside += source[i] == i ? 0 : 1;
        EXPECT_NEAR(fields[0].values[i], f(mesh.positions[i]), 1e-8);
        EXPECT_NEAR(byPlace[0].values[i], f(mesh.positions[i]), 1e-8);
    }
    EXPECT_EQ(inside, 343u);  // 7³: the solver had work
}

TEST(GeneratedField, NamesAndFormulas) {
    mesh::TetMesh mesh = grid(5, [](const glm::dvec3& p) { return p.x; });
    addGeneratedField(mesh, "distance");
    addGeneratedField(mesh, "radius");
    addGeneratedField(mesh, "q=s^2 + sin(3*y) - radius/(2+z)");
    ASSERT_EQ(mesh.fields.size(), 4u);
    EXPECT_EQ(mesh.fields[0].name, "q");  // the newest comes first
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p = mesh.positions[i];
        const double radius = glm::length(p - glm::dvec3(0.5));
        EXPECT_NEAR(mesh.fields[0].values[i], p.x * p.x + std::sin(3 * p.y) - radius / (2 + p.z), 1e-12);
        EXPECT_NEAR(mesh.fields[1].values[i], radius, 1e-15);
        const double toFace = std::min({p.x, 1 - p.x, p.y, 1 - p.y, p.z, 1 - p.z});
        EXPECT_NEAR(mesh.fields[2].values[i], toFace, 1e-12);
    }
    for (const char* bad : {"x +", "nonsense", "f=sin(", "", "iHat", "x\ny"})
        EXPECT_THROW(addGeneratedField(mesh, bad), std::runtime_error) << bad;
}

/// The value of a coarse mesh at p by trying every cell.
double valueAt(const mesh::TetMesh& mesh, const glm::dvec3& p) {
    double best = -1e300, value = 0.0;
    for (const auto& c : mesh.cells) {
        const auto& x = mesh.positions;
        const double six = mesh::sixVolumes(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
        const std::array<double, 4> w{
            mesh::sixVolumes(p, x[c[1]], x[c[2]], x[c[3]]) / six, mesh::sixVolumes(x[c[0]], p, x[c[2]], x[c[3]]) / six,
            mesh::sixVolumes(x[c[0]], x[c[1]], p, x[c[3]]) / six, mesh::sixVolumes(x[c[0]], x[c[1]], x[c[2]], p) / six};
        const double least = *std::min_element(w.begin(), w.end());
        if (least <= best) continue;
        best = least;
        value = 0.0;
        for (std::size_t k = 0; k < 4; ++k) value += w[k] * mesh.fields[0].values[c[k]];
    }
    return value;
}

TEST(Simplify, ALinearFieldNeedsFewCellsAndKeepsTheBox) {
    mesh::TetMesh mesh = grid(9, [](const glm::dvec3& p) { return 2 * p.x - p.y + 0.5 * p.z; });
    SimplifyOptions options;
    options.maxFieldError = 1e-12;
    const SimplifyReport report = simplify(mesh, options);
    EXPECT_EQ(report.cellsBefore, 2560u);
    EXPECT_LT(mesh.cells.size(), 200u);
    EXPECT_LE(report.maxError, 1e-12);
    EXPECT_NEAR(volumeOf(mesh), 1.0, 1e-12);
    EXPECT_TRUE(allPositive(mesh));
    EXPECT_NEAR(enclosedVolume(boundaryOf(mesh)), 1.0, 1e-12);
}

TEST(Simplify, TheReportedErrorIsTheError) {
    const auto f = [](const glm::dvec3& p) {
        return std::exp(-8.0 * glm::dot(p - glm::dvec3(0.4), p - glm::dvec3(0.4)));
    };
    const mesh::TetMesh fine = grid(13, f);
    const auto [low, high] = std::minmax_element(fine.fields[0].values.begin(), fine.fields[0].values.end());
    for (const double bound : {0.02, 0.1}) {
        mesh::TetMesh coarse = fine;
        SimplifyOptions options;
        options.maxFieldError = bound;
        const SimplifyReport report = simplify(coarse, options);
        double worst = 0.0;
        for (std::size_t i = 0; i < fine.positions.size(); ++i)
            worst = std::max(worst,
                             std::abs(valueAt(coarse, fine.positions[i]) - fine.fields[0].values[i]) / (*high - *low));
        EXPECT_LE(report.maxError, bound);
        EXPECT_NEAR(worst, report.maxError, 1e-9);
        EXPECT_LT(coarse.cells.size(), fine.cells.size() / 2);
        EXPECT_NEAR(volumeOf(coarse), 1.0, 1e-12);
        EXPECT_TRUE(allPositive(coarse));
    }
}

TEST(Simplify, StopsAtTheTarget) {
    mesh::TetMesh mesh = grid(9, [](const glm::dvec3& p) { return p.x * p.y; });
    SimplifyOptions options;
    options.targetCells = 1500;
    const SimplifyReport report = simplify(mesh, options);
    EXPECT_LE(mesh.cells.size(), 1500u);
    EXPECT_GT(mesh.cells.size(), 1400u);
    EXPECT_EQ(report.stopReason, "the target is reached");
    EXPECT_GT(report.maxError, 0.0);
}

TEST(Simplify, CellValuesAreRefused) {
    mesh::TetMesh mesh = grid(3, [](const glm::dvec3& p) { return p.x; });
    mesh.fields[0].association = mesh::Association::Cell;
    EXPECT_THROW(simplify(mesh, {}), std::runtime_error);
}

class PointsText : public testing::Test {
protected:
    PolygonSoup read(const std::string& name, const std::string& text) {
        path_ =
            (std::filesystem::temp_directory_path() / fmt::format("tetralux-points-{}-{}", ::getpid(), name)).string();
        std::ofstream(path_) << text;
        return readPointsText(path_);
    }
    std::string messageOf(const std::string& name, const std::string& text) {
        try {
            read(name, text);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }
    void TearDown() override { std::filesystem::remove(path_); }
    std::string path_;
};

TEST_F(PointsText, ColumnsByNameInAnyOrder) {
    const PolygonSoup soup = read("a.csv", "\xef\xbb\xbfpressure,\"Z\",X,y\r\n1.5,3,1,2\r\n\r\n-2e-3,6,4,+5\r\n");
    ASSERT_EQ(soup.points.size(), 2u);
    EXPECT_EQ(soup.points[1], glm::dvec3(4, 5, 6));
    ASSERT_EQ(soup.fields.size(), 1u);
    EXPECT_EQ(soup.fields[0].name, "pressure");
    EXPECT_EQ(soup.fields[0].values, (std::vector<double>{1.5, -2e-3}));
    EXPECT_EQ(read("b.csv", "v;Points:0;Points:1;Points:2\n7;1;2;3\n").points[0], glm::dvec3(1, 2, 3));
    EXPECT_EQ(read("c.csv", "a\tb\tc\n1\t2\t3\n").points[0], glm::dvec3(1, 2, 3));
}

TEST_F(PointsText, XyzWithCountCommentAndHeader) {
    const PolygonSoup soup = read("a.xyz", "2\n# a comment\n x  y z temperature\n1 2 3 4\n5 6 7 nan // too hot\n");
    ASSERT_EQ(soup.points.size(), 2u);
    EXPECT_EQ(soup.fields[0].name, "temperature");
    EXPECT_TRUE(std::isnan(soup.fields[0].values[1]));
    EXPECT_EQ(read("b.xyz", "1 2 3 4 5\n").fields[1].name, "value2");
}

TEST_F(PointsText, BadLinesAreNamed) {
    EXPECT_NE(messageOf("a.csv", "x,y,z\n1,2,3\n1,2\n").find("line 3 has 2 columns"), std::string::npos);
    EXPECT_NE(messageOf("b.csv", "x,y,z\n1,2,3\n1,2,three\n").find("line 3 holds 'three'"), std::string::npos);
    EXPECT_NE(messageOf("c.csv", "x,y,z,s\n1,2,3\n").find("line 2 has 3 columns, the header 4"), std::string::npos);
    EXPECT_NE(messageOf("d.xyz", "").find("no points"), std::string::npos);
}

TEST(ChildProcess, EveryEndIsAnOutcome) {
    using End = ChildOutcome::End;
    const auto endOf = [](const std::function<void(const MessagePipe&)>& work) { return runInChild({}, work); };
    std::vector<std::string> notes;
    const std::vector<double> sent(100000, 0.25);
    const ChildOutcome good = runInChild(
        {},
        [&](const MessagePipe& pipe) {
            pipe.send(MessageKind::Note, "hello");
            std::string bytes;
            appendArray(bytes, sent);
            pipe.send(MessageKind::Result, bytes);
        },
        [&](MessageKind kind, std::string_view text) {
            if (kind == MessageKind::Note) notes.emplace_back(text);
        });
    EXPECT_EQ(good.end, End::Finished);
    EXPECT_EQ(notes, std::vector<std::string>{"hello"});
    std::string_view bytes = good.result;
    EXPECT_EQ(takeArray<double>(bytes), sent);
    EXPECT_THROW(takeArray<double>(bytes), std::runtime_error);

    const ChildOutcome thrown = endOf([](const MessagePipe&) { throw std::runtime_error("two\nlines"); });
    EXPECT_EQ(thrown.end, End::Error);
    EXPECT_EQ(thrown.error, "two lines");
    const ChildOutcome crashed = endOf([](const MessagePipe&) { ::kill(::getpid(), SIGKILL); });
    EXPECT_EQ(crashed.end, End::Signal);
    EXPECT_EQ(crashed.code, SIGKILL);
    const ChildOutcome left = endOf([](const MessagePipe&) {
        std::fprintf(stderr, "bye\n");
        ::_exit(7);
    });
    EXPECT_EQ(left.end, End::Exit);
    EXPECT_EQ(left.code, 7);
    EXPECT_EQ(left.output, "bye\n");
    ChildLimits limits;
    limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    EXPECT_EQ(runInChild(limits,
                         [](const MessagePipe&) {
                             for (;;) ::pause();
                         })
                  .end,
              End::TimedOut);
}

}  // namespace
}  // namespace tetralux::tests
