// SPDX-License-Identifier: Apache-2.0
// Meshes that defeat sorting and careless arithmetic, every engine against the reference.
#include <array>
#include <cstdlib>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <mesh/soup/validation.h>
#include <mesh/tet/select_scalar.h>
#include <projection/frame/engine_registry.h>
#include <tests/stress/engine_cases.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// as in stress_numerics_test; pixels at an outline may differ by what one thin cell holds
constexpr Threshold ordinary{1e-4, 5e-3};

double plain(const glm::dvec3& p) {
    return 0.5 * (p.x + p.y);
}

TEST(StressMeshes, JitterUpToInversion) {
    for (double share : {0.3, 0.45, 0.6}) {
        mesh::ScalarMesh m = jitteredBoxMesh(6, share, 17, plain);
        std::size_t inverted = 0;
        for (auto& c : m.cells)
            if (mesh::sixVolumes(m.positions[c[0]], m.positions[c[1]], m.positions[c[2]], m.positions[c[3]]) < 0) {
                std::swap(c[2], c[3]);  // as reading does
                ++inverted;
            }
        const Scene scene = sceneOf(m, smoothFunction(0, 1, 8));
        const Camera camera = cameraAt({1.9, 1.4, 2.3});
        holdEnginesTo(referenceImage(scene, camera), scene, camera, ordinary,
                      fmt::format("jitter {} ({} turned over)", share, inverted));
    }
}

TEST(StressMeshes, NestedShellsWithGaps) {
    const mesh::ScalarMesh m = carved(jitteredBoxMesh(11, 0.2, 2, plain), [](const glm::dvec3& p) {
        return std::fmod(glm::distance(p, glm::dvec3(0.5)), 0.2) > 0.1;
    });
    const Scene scene = sceneOf(m, smoothFunction(0, 1, 8));
    for (const glm::dvec3& eye : {glm::dvec3(1.9, 1.4, 2.3), glm::dvec3(0.5, 0.52, 0.48)}) {
        const Camera camera = cameraAt(eye, {0.6, 0.5, 0.3});
        holdEnginesTo(referenceImage(scene, camera), scene, camera, ordinary, "nested shells");
    }
}

TEST(StressMeshes, ThousandsOfPieces) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> place(0, 1), small(-0.03, 0.03);
    mesh::ScalarMesh m;
    // one piece to each cell of a grid, so that they do not touch
    for (int i = 0; i < 14 * 14 * 14; ++i) {
        const glm::dvec3 centre = (glm::dvec3(i % 14, i / 14 % 14, i / 196) + 0.5) / 14.0;
        const auto first = static_cast<mesh::PointIndex>(m.positions.size());
        for (int k = 0; k < 4; ++k) {
            m.positions.push_back(centre + glm::dvec3(small(random), small(random), small(random)));
            m.scalars.push_back(place(random));
        }
        mesh::Tetrahedron c{first, first + 1, first + 2, first + 3};
        const double volume =
            mesh::sixVolumes(m.positions[c[0]], m.positions[c[1]], m.positions[c[2]], m.positions[c[3]]);
        if (volume < 0) std::swap(c[2], c[3]);
        if (volume != 0) m.cells.push_back(c);
    }
    m = finished(std::move(m));
    const Scene scene = sceneOf(m, smoothFunction(0, 1, 30));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    holdEnginesTo(referenceImage(scene, camera), scene, camera, {3e-4, 2e-2}, "2,744 pieces");
}

/// Long needles, each over the next: three of them form a cycle, of many in a heap no order is known beforehand.
mesh::ScalarMesh needles(int count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    mesh::ScalarMesh m;
    for (int i = 0; i < count; ++i) {
        const double turn = 2 * 3.14159265358979 * i / 3;
        glm::dvec3 middle(0.5 + 0.2 * std::sin(turn), 0.5 - 0.2 * std::cos(turn), 0.5);
        glm::dvec3 along(std::cos(turn), std::sin(turn), 0.35);
        if (count > 3) {
            middle = {unit(random), unit(random), unit(random)};
            along = {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
        }
        along = 0.45 * glm::normalize(along);
        const glm::dvec3 across = 0.05 * glm::normalize(glm::cross(along, glm::dvec3(0.1, 0.2, 1)));
        const glm::dvec3 other = 0.05 * glm::normalize(glm::cross(along, across));
        const auto first = static_cast<mesh::PointIndex>(m.positions.size());
        for (const glm::dvec3& p :
             {middle - along - across, middle - along + across, middle + along - other, middle + along + other}) {
            m.positions.push_back(p);
            m.scalars.push_back(unit(random));
        }
        mesh::Tetrahedron c{first, first + 1, first + 2, first + 3};
        if (mesh::sixVolumes(m.positions[c[0]], m.positions[c[1]], m.positions[c[2]], m.positions[c[3]]) < 0)
            std::swap(c[2], c[3]);
        m.cells.push_back(c);
    }
    return finished(std::move(m));
}

/// A ring of cubes, each tipped over the next: seen along z every one lies in front of its successor.
mesh::ScalarMesh cyclicRing() {
    constexpr int steps = 12;
    mesh::ScalarMesh m;
    for (int i = 0; i < steps; ++i) {
        const double angle = 2 * 3.14159265358979 * i / steps, tip = 0.9;
        const glm::dvec3 out(std::cos(angle), std::sin(angle), 0), along(-std::sin(angle), std::cos(angle), 0);
        for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
            const double radial = 0.08 * corner.x, up = 0.12 * corner.y;
            m.positions.push_back(glm::dvec3(0.5) + (0.3 + radial) * out +
                                  up * (std::cos(tip) * glm::dvec3(0, 0, 1) + std::sin(tip) * along));
            m.scalars.push_back(0.5 + 0.5 * std::sin(3 * angle + corner.x + 0.5 * corner.y));
        }
    }
    auto point = [](int step, int corner) { return static_cast<mesh::PointIndex>(4 * (step % steps) + corner); };
    for (int i = 0; i < steps; ++i) {
        const std::array<mesh::PointIndex, 8> v{point(i, 0),     point(i, 1),     point(i, 2),     point(i, 3),
                                                point(i + 1, 0), point(i + 1, 1), point(i + 1, 2), point(i + 1, 3)};
        // six cells around the diagonal 0 to 6: the diagonals of touching faces agree
        constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
        for (const auto& [a, b] : path) {
            mesh::Tetrahedron c{v[0], v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)], v[6]};
            if (mesh::sixVolumes(m.positions[c[0]], m.positions[c[1]], m.positions[c[2]], m.positions[c[3]]) < 0)
                std::swap(c[2], c[3]);
            m.cells.push_back(c);
        }
    }
    return finished(std::move(m));
}

TEST(StressMeshes, CyclesAndHeapsOfNeedles) {
    struct Case {
        const char* name;
        mesh::ScalarMesh mesh;
        glm::dvec3 eye;
    };
    std::uint64_t cycles = 0;
    for (const auto& [name, m, eye] : {Case{"three needles, each over the next", needles(3, 1), {0.5, 0.5, 3}},
                                       Case{"heap of 80 needles", needles(80, 3), {1.9, 1.4, 2.3}},
                                       Case{"ring, each part over the next", cyclicRing(), {0.5, 0.5, 3}}}) {
        for (Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
            const Scene scene = sceneOf(m, smoothFunction(0, 1, 20), mode);
            const Camera camera = cameraAt(eye, glm::dvec3(0.5), 64, 64);
            const Image expected = referenceImage(scene, camera);
            EXPECT_GT(coveredShare(expected), 0.03);
            // needles are a pixel or two wide: what a 1e-4 pixel of their outline holds
            holdEnginesTo(expected, scene, camera, {1e-4, 5e-3}, name);
            FrameReport report;
            makeEngine(scene, {.engine = "cpu"})->render(camera, report);
            cycles += report.orderCycles;
        }
    }
    EXPECT_GT(cycles, 0u) << "none of the scenes has a cycle: nothing was tested";
}

TEST(StressMeshes, OutlinesOfIsosurfacesStandInTheirPixels) {
    // isosurfaces make every outline a jump: a sample 6e-5 pixel beside the centre put one into another pixel in a
    // picture of twenty. The eye turns by little so that outlines sweep over pixel centres.
    const mesh::ScalarMesh m = carved(jitteredBoxMesh(8, 0.3, 6, plain),
                                      [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(0.5)) > 0.3; });
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        const Scene scene = sceneOf(m, isosurfacesFunction(0, 1), mode);
        for (double turn : {0.0, 0.01, 0.02, 0.03}) {
            Camera camera = cameraAt(glm::dvec3(0.5) + 2.0 * glm::dvec3(std::cos(turn), 0.3, std::sin(turn)),
                                     glm::dvec3(0.5), 96, 96);
            for (double height : {0.0, 1.6}) {
                camera.orthographicHeight = height;
                // no pixel at all may differ by what an isosurface holds (0.4)
                holdEnginesTo(referenceImage(scene, camera), scene, camera, {2e-5, 1e-2},
                              fmt::format("isosurfaces turned by {} {}", turn, height > 0 ? "orthographic" : ""));
            }
        }
    }
}

TEST(StressMeshes, FlatAndNeedleCells) {
    for (double squeeze : {1e-3, 1e-6, 1e-9}) {
        mesh::ScalarMesh m = jitteredBoxMesh(6, 0.2, 8, plain);
        for (auto& p : m.positions) p.z = 0.5 + squeeze * (p.z - 0.5);
        m = finished(std::move(m));
        preint::TransferFunction f = smoothFunction(0, 1, 3);
        for (auto& node : f.extinction) node.extinction /= squeeze;
        const Scene scene = sceneOf(m, f);
        const Camera camera = cameraAt({1.1, 0.9, 2.3});
        const Image expected = referenceImage(scene, camera);
        EXPECT_GT(coveredShare(expected), 0.1);
        const Scene isosurfaces =
            sceneOf(m, isosurfacesFunction(0, 1));  // flat cells and neighbours differ about the scalar between
        holdEnginesTo(referenceImage(isosurfaces, camera), isosurfaces, camera, {2e-3, 0.1},
                      fmt::format("isosurfaces, squeezed by {:g}", squeeze));
        if (squeeze == 1e-6) {  // the colour of one cell's own segment, which float planes of that cell do not know
            const Scene first = sceneOf(m, f, Mode::FirstHit);
            holdEnginesTo(referenceImage(first, camera), first, camera, ordinary, "first hit in flat cells");
        }
        // flatter cells than 1e-4 are beyond float planes at this extinction: the engines must know that
        holdEnginesTo(expected, scene, camera, {1e-4, 5e-3}, fmt::format("squeezed by {:g}", squeeze));
    }
}

TEST(StressMeshes, OneCellAroundTheEyeAndOneFarAway) {
    mesh::ScalarMesh m = unitTetrahedron({0, 0.3, 0.6, 1});
    for (const auto& p :
         {glm::dvec3(0, 0, -1000), glm::dvec3(300, 0, -1000), glm::dvec3(0, 300, -1000), glm::dvec3(0, 0, -1300)})
        m.positions.push_back(p);
    for (const double scalar : {1.0, 0.0, 0.5, 0.2}) m.scalars.push_back(scalar);
    m.cells.push_back({4, 5, 6, 7});
    if (mesh::sixVolumes(m.positions[4], m.positions[5], m.positions[6], m.positions[7]) < 0)
        std::swap(m.cells[1][2], m.cells[1][3]);
    m = finished(std::move(m));
    const Scene scene = sceneOf(m, smoothFunction(0, 1, 0.5));
    Camera camera = cameraAt({0.2, 0.2, 0.2}, {0.25, 0.25, -1});
    const Image expected = referenceImage(scene, camera);
    EXPECT_GT(coveredShare(expected), 0.5);
    holdEnginesTo(expected, scene, camera, ordinary, "eye in a cell, another far away");
}

TEST(StressMeshes, WhatIsNotFiniteIsLeftOutAndNothingElse) {
    const mesh::ScalarMesh base = jitteredBoxMesh(6, 0.2, 4, plain);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const bool positions : {true, false}) {
        mesh::CellSoup soup;
        soup.points.assign(base.positions.begin(), base.positions.end());
        std::vector<double> scalars(base.scalars.begin(), base.scalars.end());
        std::vector<bool> spoilt(base.positions.size());
        const double bad[] = {nan, infinity, -infinity};
        for (std::size_t i = 0; i < 9; ++i) {
            const std::size_t point = (i * 53 + 7) % base.positions.size();
            spoilt[point] = true;
            if (positions)
                soup.points[point][static_cast<int>(i / 3)] = bad[i % 3];
            else
                scalars[point] = bad[i % 3];
        }
        for (const auto& cell : base.cells) mesh::appendCell(soup, 10, cell);  // VTK_TETRA
        soup.fields.push_back({"s", mesh::Association::Point, 1, scalars});
        mesh::ReadResult read = mesh::tetMeshFromSoup(soup);
        const mesh::ScalarMesh drawn = mesh::selectScalar(std::move(read.mesh), "s", read.report).mesh;

        mesh::ScalarMesh sound = base;
        std::vector<mesh::Tetrahedron> kept(base.cells.begin(), base.cells.end());
        std::erase_if(kept, [&](const mesh::Tetrahedron& cell) {
            return std::any_of(cell.begin(), cell.end(), [&](mesh::PointIndex p) { return spoilt[p]; });
        });
        sound.cells = std::move(kept);
        sound = finished(std::move(sound));
        ASSERT_LT(sound.cells.size(), base.cells.size());
        const Camera camera = cameraAt({1.9, 1.4, 2.3});
        for (const auto& f : {smoothFunction(0, 1, 8), isosurfacesFunction(0, 1)})
            holdEnginesTo(referenceImage(sceneOf(sound, f), camera), sceneOf(drawn, f), camera, ordinary,
                          positions ? "NaN and infinite positions" : "NaN and infinite scalars");
    }
}

/// A small mesh of random kind with a random function, from one number.
Scene randomScene(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const glm::dvec3 wave(6 * unit(random), 6 * unit(random), 6 * unit(random));
    const double phase = 6 * unit(random);
    auto field = [=](const glm::dvec3& p) { return 0.5 + 0.5 * std::sin(glm::dot(wave, p) + phase); };
    mesh::ScalarMesh m = jitteredBoxMesh(3 + static_cast<int>(random() % 3), 0.28 * unit(random), seed, field);
    if (random() % 2 == 0) {
        const glm::dvec3 hole(unit(random), unit(random), unit(random));
        const double radius = 0.2 + 0.3 * unit(random);
        mesh::ScalarMesh left = carved(m, [&](const glm::dvec3& p) { return glm::distance(p, hole) > radius; });
        if (!left.cells.empty()) m = std::move(left);
    }
    const Mode mode = random() % 2 == 0 ? Mode::Standard : Mode::ScaleInvariant;
    return sceneOf(m, smoothFunction(0, 1, std::pow(10.0, 2 * unit(random) - 0.5)), mode);
}

/// A view of it, from another number.
Camera randomCamera(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const glm::dvec3 away = glm::normalize(glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5));
    Camera camera = cameraAt(glm::dvec3(0.5) + (0.2 + 2.3 * unit(random)) * away,
                             glm::dvec3(0.3) + 0.4 * glm::dvec3(unit(random), unit(random), unit(random)), 20, 16);
    camera.fovDegrees = 20 + 80 * unit(random);
    if (random() % 4 == 0) camera.orthographicHeight = 0.5 + 1.5 * unit(random);
    return camera;
}

/// A thousand scenes by the tile engine, and a thousand by OpenGL, shared out between contexts. An OpenGL engine
/// compiles a program, which takes ten times as long as such a picture: so it shows its mesh four times.
struct Share {
    const char *name, *engine, *context;
    std::uint32_t first, meshes, views;
};

void PrintTo(const Share& share, std::ostream* out) {
    *out << share.name;
}

class RandomScenes : public ::testing::TestWithParam<Share> {};

TEST_P(RandomScenes, AreDrawnAsTheReferenceDrawsThem) {
    // the same scenes each time unless TETRALUX_SEED asks for others: a failure must come again
    const char* given = std::getenv("TETRALUX_SEED");
    const std::uint32_t base = given ? static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10)) : 1;
    std::printf("seed %u (TETRALUX_SEED=N takes others)\n", base);
    const Share& share = GetParam();
    double worstRmse = 0;
    for (std::uint32_t seed = base + share.first; seed < base + share.first + share.meshes; ++seed) {
        const Scene scene = randomScene(seed);
        const auto engine = makeEngine(scene, {.engine = share.engine, .context = share.context});
        for (std::uint32_t view = 0; view < share.views; ++view) {
            const Camera camera = randomCamera(seed * share.views + view);
            FrameReport report;
            const Image image = engine->render(camera, report);
            const ImageDifference difference = compareImages(image, referenceImage(scene, camera));
            worstRmse = std::max(worstRmse, difference.rmse);
            // 320 pixels: one outline pixel that falls the other way by 1e-2 is 5e-4 of rmse
            EXPECT_LE(difference.rmse, 5e-4) << "seed " << seed << ", view " << view;
            EXPECT_LE(difference.max, 3e-2) << "seed " << seed << ", view " << view;
            EXPECT_EQ(report.pixelsWrong, 0u) << "seed " << seed << ", view " << view;
        }
    }
    std::printf("worst rmse %.1e\n", worstRmse);
}

INSTANTIATE_TEST_SUITE_P(Stress, RandomScenes,
                         ::testing::Values(Share{"cpu", "cpu", "auto", 0, 1000, 1},
                                           Share{"gl_egl", "gl", "egl", 0, 125, 4},
                                           Share{"gl_osmesa", "gl", "osmesa", 125, 125, 4}),
                         [](const auto& testCase) { return std::string(testCase.param.name); });

}  // namespace
}  // namespace tetralux::projection
