// SPDX-License-Identifier: Apache-2.0
// Orders against what rays of the reference meet, and the proof that power order rests on.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/cells/cell_setup.h>
#include <projection/cells/edge_on_planes.h>
#include <projection/frame/engine_registry.h>
#include <projection/order/boundary_reentry.h>
#include <projection/order/grid_heights.h>
#include <projection/order/incremental_sort.h>
#include <projection/order/key_sort.h>
#include <projection/order/power_order.h>
#include <projection/order/visibility_order.h>
#include <projection/reference/reference_ray_caster.h>
#include <projection/repair/exact_repair.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

double plain(const glm::dvec3& p) {
    return p.x;
}

struct OrderCheck {
    int pairs = 0, wrong = 0;
};

/// Neighbouring segments of every ray, in pixels that are not uncertain. Segments shorter than `leastLength` may be
/// rounding, where the ray runs through an edge or within a face: they are not looked at.
OrderCheck checkAgainstRays(const mesh::ScalarMesh& m, const Camera& camera, const std::vector<mesh::CellIndex>& order,
                            const std::vector<std::uint32_t>& uncertain = {}, double leastLength = 0) {
    std::vector<std::uint32_t> rank(m.cells.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
    const ReferenceRayCaster caster(sceneOf(m, constantFunction(1)));
    OrderCheck check;
    for (int y = 0; y < camera.height; y += 2)
        for (int x = 0; x < camera.width; x += 2) {
            if (std::binary_search(uncertain.begin(), uncertain.end(),
                                   static_cast<std::uint32_t>(y * camera.width + x)))
                continue;
            auto segments = caster.segmentsAt(camera, x, y);
            std::erase_if(segments, [&](const RaySegment& s) { return s.tOut - s.tIn < leastLength; });
            for (std::size_t i = 1; i < segments.size(); ++i) {
                ++check.pairs;
                check.wrong += rank[segments[i].cell] < rank[segments[i - 1].cell] ? 1 : 0;
            }
        }
    return check;
}

std::vector<mesh::CellIndex> powerSorted(const mesh::ScalarMesh& m, const PowerOrder& power, const Camera& camera) {
    const CellProjector projector(m, sceneUnits(m), cameraFrame(camera));
    std::vector<double> keys(m.cells.size());
    for (mesh::CellIndex c = 0; c < keys.size(); ++c) {
        const auto lambda = projector.eyeCoordinates(c);
        for (std::size_t k = 0; k < 4; ++k) keys[c] += lambda[k] * power.heights()[m.cells[c][k]];
    }
    const auto [far, near] = std::minmax_element(keys.begin(), keys.end());
    std::vector<KeyedCell> cells, scratch;
    for (mesh::CellIndex c = 0; c < keys.size(); ++c) cells.push_back({orderedKey(keys[c], *near, *far), c});
    radixSort(cells, scratch);
    std::vector<mesh::CellIndex> order;
    for (const KeyedCell& cell : cells) order.push_back(cell.cell);
    return order;
}

const std::vector<Camera>& views() {
    static const std::vector<Camera> all = [] {
        std::vector<Camera> v{cameraAt({1.9, 1.4, 2.3}), cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 41, 41),
                              cameraAt({0.4, 0.55, 0.45}, {0.9, 0.3, 0.6}), cameraAt({-40, 3, 5})};
        v.push_back(v[0]);
        v.back().orthographicHeight = 1.8;
        v[3].fovDegrees = 3;
        return v;
    }();
    return all;
}

TEST(VisibilityOrder, OrdersAConvexMeshFromEveryEye) {
    const mesh::ScalarMesh m = jitteredBoxMesh(6, 0.25, 5, plain);
    VisibilitySorter sorter(m);
    for (const Camera& camera : views()) {
        const VisibilityOrder order = sorter.sort(cameraFrame(camera));
        EXPECT_EQ(order.method, "mpvo");
        EXPECT_EQ(order.cyclicCells, 0u);
        EXPECT_TRUE(order.uncertainPixels.empty());
        ASSERT_EQ(order.frontToBack.size(), m.cells.size());
        const OrderCheck check = checkAgainstRays(m, camera, order.frontToBack);
        EXPECT_GT(check.pairs, 500);
        EXPECT_EQ(check.wrong, 0);
    }
}

TEST(VisibilityOrder, OrdersAcrossGapsOfANonconvexMesh) {
    // a cavity, a corner cut off and a slit that parts the mesh in two
    const mesh::ScalarMesh m = carved(jitteredBoxMesh(8, 0.2, 5, plain), [](const glm::dvec3& p) {
        return glm::distance(p, glm::dvec3(0.5)) > 0.25 && p.x + p.y + p.z < 2.4 && std::abs(p.x - 0.2) > 0.08;
    });
    VisibilitySorter sorter(m);
    for (const Camera& camera : views()) {
        const VisibilityOrder order = sorter.sort(cameraFrame(camera));
        EXPECT_EQ(order.method, "mpvo+reentry");
        ASSERT_EQ(order.frontToBack.size(), m.cells.size());
        const OrderCheck check = checkAgainstRays(m, camera, order.frontToBack, order.uncertainPixels);
        EXPECT_GT(check.pairs, 300);
        EXPECT_EQ(check.wrong, 0);
        EXPECT_LT(order.uncertainPixels.size(), 20u);
    }
}

/// A camera that creeps, jumps and stays, as in an animation.
std::vector<Camera> movingCameras() {
    std::vector<Camera> cameras;
    for (int i = 0; i < 12; ++i) cameras.push_back(cameraAt({1.9 + 1e-3 * i, 1.4, 2.3 - 2e-3 * i}));
    cameras.push_back(cameras.back());
    cameras.back().target.x += 0.05;  // turns, but the eye stays
    cameras.push_back(cameraAt({-1.2, 0.4, 1.9}));
    for (int i = 1; i < 6; ++i) cameras.push_back(cameraAt({-1.2 + 3e-3 * i, 0.4, 1.9}));
    return cameras;
}

TEST(IncrementalSort, KeptAndRepairedOrdersAreRight) {
    const mesh::ScalarMesh whole = jitteredBoxMesh(8, 0.2, 5, plain);
    const mesh::ScalarMesh hollow =
        carved(whole, [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(0.5)) > 0.3; });
    for (const auto& [m, method, wanted] :
         {std::tuple(whole, OrderMethod::Auto, "power"), std::tuple(whole, OrderMethod::Graph, "mpvo"),
          std::tuple(hollow, OrderMethod::Auto, "mpvo+reentry")}) {
        VisibilitySorter sorter(m, method);
        EXPECT_EQ(sorter.method(), wanted);
        std::map<std::string, int> incrementalSort;
        for (const Camera& camera : movingCameras()) {
            const VisibilityOrder& order = sorter.sort(cameraFrame(camera));
            ++incrementalSort[order.incrementalSort];
            const OrderCheck check = checkAgainstRays(m, camera, order.frontToBack, order.uncertainPixels);
            EXPECT_GT(check.pairs, 500);
            EXPECT_EQ(check.wrong, 0) << wanted << ", " << order.incrementalSort;
            for (std::uint32_t i = 0; i < order.places.size(); ++i) ASSERT_EQ(order.places[order.frontToBack[i]], i);
        }
        std::printf("%s: %d sorted, %d kept, %d repaired\n", wanted, incrementalSort["sorted"], incrementalSort["kept"],
                    incrementalSort["repaired"]);
        EXPECT_GE(incrementalSort["kept"], 1) << "the eye stayed once";
        EXPECT_GE(incrementalSort["sorted"], 1);
        if (method == OrderMethod::Graph) {
            EXPECT_GE(incrementalSort["repaired"], 5);
        }
    }
}

TEST(RoundedPlanes, SayOnlyWhatTheExactPredicateSays) {
    const mesh::ScalarMesh jittered = jitteredBoxMesh(9, 0.3, 5, plain);
    mesh::ScalarMesh far = jittered, flat = jittered;
    for (glm::dvec3& p : far.positions) p += glm::dvec3(1e7, 2e7, -1e7);
    for (glm::dvec3& p : flat.positions) p.y *= 1e-6;
    std::size_t told = 0, all = 0;
    for (const mesh::ScalarMesh& m :
         {jittered, finished(std::move(far)), finished(std::move(flat)), boxMesh(9, plain)}) {
        const RoundedPlanes planes(m);
        std::vector<std::uint8_t> sides(m.cells.size());
        Camera parallel = cameraAt(m.bounds.centre() + glm::dvec3(0, 0, 3), m.bounds.centre());
        parallel.orthographicHeight = 1;
        const glm::dvec3 corner = m.positions[m.cells[100][0]];
        for (const Camera& camera : {cameraAt(m.bounds.centre() + glm::dvec3(0.9, 0.4, 1.3), m.bounds.centre()),
                                     cameraAt(corner, m.bounds.centre() + glm::dvec3(0.1)), parallel,
                                     cameraAt(m.bounds.centre() + glm::dvec3(3e5, 1e5, 2e5), m.bounds.centre())}) {
            const CellProjector projector(m, sceneUnits(m), cameraFrame(camera));
            planes.sides(0, m.cells.size(), planes.eye(projector.frame()), sides.data());
            for (mesh::CellIndex cell = 0; cell < m.cells.size(); ++cell) {
                const std::array<double, 4> exact = projector.eyeSides(cell);
                for (unsigned k = 0; k < 4; ++k) {
                    const bool outside = sides[cell] >> k & 1u, inside = sides[cell] >> (4 + k) & 1u;
                    EXPECT_FALSE(outside && !(exact[k] < 0)) << cell;
                    EXPECT_FALSE(inside && !(exact[k] > 0)) << cell;
                    told += outside || inside ? 1 : 0;
                    ++all;
                }
            }
        }
    }
    EXPECT_GT(told, all / 2) << "a filter that says nothing is of no use";
}

TEST(IncrementalSort, RepairMovesFewCellsOrSaysNo) {
    const mesh::ScalarMesh m = jitteredBoxMesh(6, 0.2, 5, plain);
    const mesh::Adjacency adjacency = mesh::buildAdjacency(m.cells, m.positions.size());
    const RoundedPlanes planes(m);
    VisibilityRelations relations(adjacency, planes);
    relations.see(CellProjector(m, sceneUnits(m), cameraFrame(cameraAt({1.9, 1.4, 2.3}))));
    const VisibilityOrder right = VisibilitySorter(m).sort(cameraFrame(cameraAt({1.9, 1.4, 2.3})));
    EXPECT_TRUE(relations.violations(right.places).empty());

    VisibilityOrder spoiled = right;  // swap cells a few places apart
    for (std::size_t i = 20; i + 40 < spoiled.frontToBack.size(); i += 200)
        std::swap(spoiled.frontToBack[i], spoiled.frontToBack[i + 30]);
    for (std::uint32_t i = 0; i < spoiled.places.size(); ++i) spoiled.places[spoiled.frontToBack[i]] = i;
    const auto wrong = relations.violations(spoiled.places);
    ASSERT_FALSE(wrong.empty());
    EXPECT_TRUE(repairOrder(relations, wrong, spoiled.frontToBack, spoiled.places));
    EXPECT_TRUE(relations.violations(spoiled.places).empty());

    VisibilityOrder reversed = right;
    std::reverse(reversed.frontToBack.begin(), reversed.frontToBack.end());
    for (std::uint32_t i = 0; i < reversed.places.size(); ++i) reversed.places[reversed.frontToBack[i]] = i;
    EXPECT_FALSE(repairOrder(relations, relations.violations(reversed.places), reversed.frontToBack, reversed.places))
        << "everything would have to move";
}

/// Three slivers, each over the next: no order exists where they cross.
mesh::ScalarMesh cyclicSlivers() {
    mesh::ScalarMesh m;
    for (int i = 0; i < 3; ++i) {
        const double a = 2 * 3.14159265358979 * i / 3;
        auto turn = [&](double x, double y, double z) {
            m.positions.push_back({x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a), z});
        };
        const auto first = static_cast<mesh::PointIndex>(m.positions.size());
        turn(-1.0, -0.45, -0.4);
        turn(-1.0, -0.25, -0.4);
        turn(1.0, -0.35, 0.4);
        turn(1.0, -0.35, 0.5);
        m.cells.push_back({first, first + 1, first + 2, first + 3});
        auto& c = m.cells.back();
        if (mesh::sixVolumes(m.positions[c[0]], m.positions[c[1]], m.positions[c[2]], m.positions[c[3]]) < 0)
            std::swap(c[2], c[3]);
    }
    m.scalars.assign(m.positions.size(), 0.5);
    m.scalars[0] = 0;
    m.scalars[5] = 1;
    return finished(std::move(m));
}

TEST(VisibilityOrder, NamesThePixelsOfACycle) {
    const mesh::ScalarMesh m = cyclicSlivers();
    const Camera camera = cameraAt({0, 0, 6}, glm::dvec3(0), 80, 80);
    const VisibilityOrder order = VisibilitySorter(m).sort(cameraFrame(camera));
    EXPECT_GE(order.cyclicCells, 1u);
    EXPECT_FALSE(order.uncertainPixels.empty());
    const OrderCheck all = checkAgainstRays(m, camera, order.frontToBack);
    EXPECT_GT(all.wrong, 0) << "the scene is not cyclic: nothing was tested";
    EXPECT_EQ(checkAgainstRays(m, camera, order.frontToBack, order.uncertainPixels).wrong, 0);
}

/// The mesh and the same moved by `step`: one reaches into the other.
mesh::ScalarMesh doubled(mesh::ScalarMesh m, double step) {
    const auto points = static_cast<mesh::PointIndex>(m.positions.size());
    const std::size_t cells = m.cells.size();
    for (mesh::PointIndex k = 0; k < points; ++k) {
        m.positions.push_back(m.positions[k] + glm::dvec3(step));
        m.scalars.push_back(m.scalars[k]);
    }
    for (std::size_t i = 0; i < cells; ++i) {
        mesh::Tetrahedron cell = m.cells[i];
        for (auto& p : cell) p += points;
        m.cells.push_back(cell);
    }
    return finished(std::move(m));
}

TEST(VisibilityOrder, CellsThatOverlapStandAsTheyAreMetOrAreNamed) {
    struct Case {
        mesh::ScalarMesh mesh;
        bool ordered;  // every cell is met before the next
    };
    const Camera camera = cameraAt({2, 2.5, 3}, glm::dvec3(0.3));
    for (const auto& [m, ordered] :
         {Case{doubled(unitTetrahedron({0, 1, 0, 1}), 0.1), true}, Case{doubled(boxMesh(3, plain), 0.7), false},
          Case{doubled(jitteredBoxMesh(4, 0.2, 5, plain), 0.05), false}}) {
        const VisibilityOrder order = VisibilitySorter(m).sort(cameraFrame(camera));
        RayCastCounts counts;
        ReferenceRayCaster(sceneOf(m, constantFunction(1))).render(camera, counts);
        EXPECT_GT(counts.overlaps, 20u);
        EXPECT_EQ(order.uncertainPixels.empty(), ordered);
        const OrderCheck check = checkAgainstRays(m, camera, order.frontToBack, order.uncertainPixels);
        EXPECT_GT(check.pairs, 20);
        EXPECT_EQ(check.wrong, 0);
    }
}

TEST(EdgeOnPlanes, SamplesStandAsideOnlyWhereAPlanePassesPixelCentres) {
    const EdgeOnPlanes grid(boxMesh(9, plain)), jittered(jitteredBoxMesh(9, 0.2, 3, plain));
    EXPECT_GT(grid.count(), 27u);
    EXPECT_EQ(jittered.count(), 6u) << "the sides of the box";
    auto shifts = [](const EdgeOnPlanes& planes, const Camera& camera) {
        return planes.sampleShift(cameraFrame(camera)).x > EdgeOnPlanes::barely.x;
    };
    const glm::dvec3 centre(0.5);
    EXPECT_TRUE(shifts(grid, cameraAt({0.5, 0.5, 3}, centre, 33, 33))) << "the middle column runs within a plane";
    EXPECT_FALSE(shifts(grid, cameraAt({0.5, 0.5, 3}, centre, 32, 32))) << "it runs between two columns";
    EXPECT_FALSE(shifts(jittered, cameraAt({0.5, 0.5, 3}, centre, 33, 33))) << "no plane but the sides";
    EXPECT_FALSE(shifts(grid, cameraAt({1.9, 1.4, 2.3}, centre, 33, 33)));
    Camera parallel = cameraAt({0.5, 0.5, 3}, centre, 32, 32);
    parallel.orthographicHeight =
        2.0;  // a pixel is half a cell: faces pass at odd halves of pixels, or through centres
    EXPECT_FALSE(shifts(grid, parallel));
    parallel.eye.x = parallel.target.x = 0.5 + 1.0 / 32;
    EXPECT_TRUE(shifts(grid, parallel));
}

TEST(BoundaryIsConvex, TellsBoxesFromCarvedBoxes) {
    auto convex = [](const mesh::ScalarMesh& m) {
        return boundaryIsConvex(m, boundaryFaces(m, mesh::buildAdjacency(m.cells, m.positions.size())));
    };
    const mesh::ScalarMesh box = jitteredBoxMesh(5, 0.2, 1, plain);
    EXPECT_TRUE(convex(box));
    EXPECT_FALSE(convex(carved(box, [](const glm::dvec3& p) { return p.x < 0.6 || p.y < 0.6; }))) << "corner cut out";
    EXPECT_FALSE(convex(carved(box, [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(0.5)) > 0.2; })))
        << "cavity";
    EXPECT_FALSE(convex(carved(boxMesh(6, plain), [](const glm::dvec3& p) { return std::abs(p.x - 0.5) > 0.1; })))
        << "two boxes";
}

TEST(PowerOrder, SettlesTheCosphericalCellsOfAGrid) {
    const mesh::ScalarMesh m = boxMesh(8, plain);
    const PowerOrder power(m, mesh::buildAdjacency(m.cells, m.positions.size()));
    EXPECT_EQ(power.failingFaces(), 0u);
    for (const Camera& camera : views()) {
        const OrderCheck check = checkAgainstRays(m, camera, powerSorted(m, power, camera));
        EXPECT_GT(check.pairs, 500);
        EXPECT_EQ(check.wrong, 0);
    }
}

/// A grid of random lines, lengths of boxes in it up to `ratio` apart, each box cut into six tetrahedra about the
/// diagonal from its lowest number; where `flipped`, numbers fall along the axis.
mesh::ScalarMesh gradedGrid(const std::array<int, 3>& boxes, double ratio, unsigned seed,
                            const std::array<bool, 3>& flipped = {false, false, false}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> power(0, std::log(ratio));
    std::array<std::vector<double>, 3> lines;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double>& x = lines[axis];
        x.push_back(0);
        for (int i = 0; i < boxes[axis]; ++i) x.push_back(x.back() + std::exp(power(random)));
        for (double& v : x) v /= x.back();
        if (flipped[axis]) std::reverse(x.begin(), x.end());
    }
    mesh::ScalarMesh m;
    for (double z : lines[2])
        for (double y : lines[1])
            for (double x : lines[0]) {
                m.positions.push_back({x, y, z});
                m.scalars.push_back(x + y * z);
            }
    const auto number = [&](int i, int j, int k) {
        return static_cast<mesh::PointIndex>(i + (boxes[0] + 1) * (j + (boxes[1] + 1) * k));
    };
    for (int k = 0; k < boxes[2]; ++k)
        for (int j = 0; j < boxes[1]; ++j)
            for (int i = 0; i < boxes[0]; ++i) {
                std::array<int, 3> axes{0, 1, 2};
                do {
                    std::array<int, 3> at{i, j, k};
                    mesh::Tetrahedron cell{number(i, j, k), 0, 0, 0};
                    for (std::size_t step = 0; step < 3; ++step) {
                        ++at[static_cast<std::size_t>(axes[step])];
                        cell[step + 1] = number(at[0], at[1], at[2]);
                    }
                    const glm::dvec3 a = m.positions[cell[0]];
                    if (glm::dot(m.positions[cell[1]] - a,
                                 glm::cross(m.positions[cell[2]] - a, m.positions[cell[3]] - a)) < 0)
                        std::swap(cell[2], cell[3]);
                    m.cells.push_back(cell);
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
    return finished(std::move(m));
}

TEST(PowerOrder, HasHeightsOfGradedGridsByConstruction) {
    const std::array<std::array<int, 3>, 3> sizes{{{5, 7, 4}, {12, 3, 9}, {24, 16, 20}}};
    for (const auto& boxes : sizes)
        for (double ratio : {1.0, 6.0, 100.0})
            for (const std::array<bool, 3>& flipped :
                 {std::array<bool, 3>{false, false, false}, {true, false, false}, {false, true, true}}) {
                SCOPED_TRACE(testing::Message() << boxes[0] << " boxes along x, ratio " << ratio << ", flipped "
                                                << flipped[0] << flipped[1] << flipped[2]);
                const mesh::ScalarMesh m = gradedGrid(boxes, ratio, 7, flipped);
                const PowerOrder power(m, mesh::buildAdjacency(m.cells, m.positions.size()));
                EXPECT_EQ(power.failingFaces(), 0u);
                if (boxes[0] == 24) continue;  // its rays take long
                for (const Camera& camera : views()) {
                    const OrderCheck check = checkAgainstRays(m, camera, powerSorted(m, power, camera), {}, 1e-12);
                    EXPECT_GT(check.pairs, 300);
                    EXPECT_EQ(check.wrong, 0);
                }
            }
}

TEST(GridHeights, AreOfGridsAlone) {
    mesh::ScalarMesh m = gradedGrid({4, 5, 6}, 5, 3);
    std::vector<glm::dvec3> points(m.positions.begin(), m.positions.end());
    EXPECT_TRUE(gridHeights(points, m.cells[0]));
    points[37].x += 1e-9;
    EXPECT_FALSE(gridHeights(points, m.cells[0])) << "a point off the lines";
    const mesh::ScalarMesh five = boxMesh(4, plain);
    EXPECT_FALSE(gridHeights({five.positions.begin(), five.positions.end()}, five.cells[0])) << "another cut of boxes";
}

TEST(PowerOrder, OrdersJitteredGridsWheneverItSaysSo) {
    int certified = 0, refused = 0;
    for (double share : {0.1, 0.2, 0.3, 0.45})
        for (unsigned seed : {1u, 2u}) {
            const mesh::ScalarMesh m = jitteredBoxMesh(6, share, seed, plain);
            const PowerOrder power(m, mesh::buildAdjacency(m.cells, m.positions.size()));
            if (power.failingFaces() > 0) {
                ++refused;
                continue;
            }
            ++certified;
            for (const Camera& camera : views())
                EXPECT_EQ(checkAgainstRays(m, camera, powerSorted(m, power, camera)).wrong, 0) << share;
        }
    EXPECT_GE(certified, 2);
    EXPECT_GE(refused, 1) << "half a cell of jitter turns cells over: no heights can order them";
}

TEST(RadixSort, SortsStably) {
    std::mt19937 random(3);
    std::vector<KeyedCell> cells, scratch;
    for (std::uint32_t i = 0; i < 200000; ++i) cells.push_back({static_cast<std::uint32_t>(random() & 0xfff00fffu), i});
    std::vector<KeyedCell> expected = cells;
    std::stable_sort(expected.begin(), expected.end(), [](auto& a, auto& b) { return a.key < b.key; });
    radixSort(cells, scratch);
    for (std::size_t i = 0; i < cells.size(); ++i) ASSERT_EQ(cells[i].cell, expected[i].cell);
}

// Keys of a mesh whose cells differ by 1e-6 of the largest key's range and less: whole numbers of 32 bits leave ties.
TEST(KeySorter, TellsApartWhatDoublesTellApart) {
    mesh::ScalarMesh m = boxMesh(9, plain);
    for (glm::dvec3& p : m.positions)
        if (p.x < 0.999) p.x *= 1e-8;  // slabs, and one of the old size
    m = finished(std::move(m));
    const OrderKeys keys = OrderKeys::centroid(m);
    const glm::dvec4 eye = keys.eye(cameraFrame(cameraAt({1.9, 1.4, 2.3})));
    std::vector<mesh::CellIndex> cells, expected;
    for (mesh::CellIndex cell = 0; cell < m.cells.size(); cell += 2) cells.push_back(cell);
    expected = cells;
    std::stable_sort(expected.begin(), expected.end(),
                     [&](auto a, auto b) { return orderKey(keys.planes()[a], eye) > orderKey(keys.planes()[b], eye); });
    KeySorter().sort(keys, eye, cells);
    EXPECT_EQ(cells, expected);
}

// An order of some of a mesh's cells is refused once two that share a face change places.
TEST(FaceRelations, AreCheckedAmongAnyCells) {
    const mesh::ScalarMesh m = jitteredBoxMesh(6, 0.1, 5, plain);
    VisibilitySorter sorter(m);
    const CellProjector projector(m, sceneUnits(m), cameraFrame(cameraAt({1.9, 1.4, 2.3})));
    std::vector<mesh::CellIndex> some;
    for (const mesh::CellIndex cell : sorter.sort(projector).frontToBack)
        if (cell % 3 != 0) some.push_back(cell);
    std::vector<std::uint32_t> places;
    EXPECT_TRUE(keepsFaceRelations(sorter.adjacency(), projector, some, places));
    for (std::size_t i = 0; i < some.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto other = std::find(some.begin(), some.end(), sorter.adjacency().neighbours[some[i]][k]);
            if (other == some.end() || projector.eyeSide(some[i], static_cast<int>(k)) == 0) continue;
            std::vector<mesh::CellIndex> swapped = some;
            std::swap(swapped[i], swapped[static_cast<std::size_t>(other - some.begin())]);
            ASSERT_FALSE(keepsFaceRelations(sorter.adjacency(), projector, swapped, places)) << i << ' ' << k;
            i += 20;
            break;
        }
}

TEST(OrderedKey, AscendsFromNearToFar) {
    EXPECT_EQ(orderedKey(7.0, 7.0, -3.0), 0u);
    EXPECT_EQ(orderedKey(-3.0, 7.0, -3.0), 0xffffffffu);
    EXPECT_LT(orderedKey(1.0, 7.0, -3.0), orderedKey(0.999999, 7.0, -3.0));
    EXPECT_EQ(orderedKey(5.0, 5.0, 5.0), 0u);
}

/// An engine that paints red, isUncertain some pixels and makes one no number.
class UncertainEngine final : public Engine {
public:
    Image render(const View& view, FrameReport& report) override {
        Image image(view.camera.width, view.camera.height);
        for (auto& pixel : image.pixels) pixel = {1, 0, 0, 1};
        report.uncertainPixels = {3, 900, 901};
        image.pixels[700].x = std::nanf("");
        return image;
    }
    std::string name() const override { return "uncertain"; }
    std::string renderer() const override { return "test"; }
};

TEST(OrderMethod, WrongPixelsOfACentroidSortAreCountedNotRepaired) {
    Scene scene = sceneOf(jitteredBoxMesh(6, 0.25, 5, plain), smoothFunction(0, 1, 5));
    auto reportOf = [&](OrderMethod order) {
        scene.settings.order = order;
        FrameReport report;
        makeEngine(scene, {.engine = "cpu"})->render(views()[0], report);
        return report;
    };
    const FrameReport certain = reportOf(OrderMethod::Auto), plainSort = reportOf(OrderMethod::Centroid);
    EXPECT_EQ(certain.pixelsWrong, 0u);
    EXPECT_EQ(plainSort.orderMethod, "centroid");
    EXPECT_GT(plainSort.pixelsWrong, 0u);
    EXPECT_EQ(plainSort.pixelsRepaired, 0u);
}

TEST(ExactRepair, ReplacesUncertainPixelsOnly) {
    const Scene scene = sceneOf(boxMesh(4, plain), smoothFunction(0, 1));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    RayCastCounts counts;
    const Image exact = ReferenceRayCaster(scene).render(camera, counts);
    FrameReport report;
    const Image image = withExactRepair(std::make_unique<UncertainEngine>(), scene)->render(camera, report);
    EXPECT_EQ(report.pixelsRepaired, 4u);
    EXPECT_EQ(report.repairedBecause, (std::map<std::string, std::uint64_t>{{"not a number", 1}, {"order", 3}}));
    EXPECT_EQ(image.pixels[3], exact.pixels[3]);
    EXPECT_EQ(image.pixels[700], exact.pixels[700]);
    EXPECT_EQ(image.pixels[900], exact.pixels[900]);
    EXPECT_GT(image.pixels[900].w, 0.1f);
    EXPECT_EQ(image.pixels[902], glm::vec4(1, 0, 0, 1));
}

}  // namespace
}  // namespace tetralux::projection
