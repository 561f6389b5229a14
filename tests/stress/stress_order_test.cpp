// SPDX-License-Identifier: Apache-2.0
/// \file
/// Meshes without an order, or with one that is hard to find, from views that make it harder: no pixel may be wrong.
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/frame/engine_registry.h>
#include <tests/stress/engine_cases.h>
#include <tests/stress/order_scenes.h>

namespace tetralux::projection {
namespace {

using namespace test;

struct OrderCase {
    const char* name;
    mesh::ScalarMesh (*mesh)();
};

void PrintTo(const OrderCase& orderCase, std::ostream* out) {
    *out << orderCase.name;
}

struct NamedView {
    std::string name;
    Camera camera;
};

/// From beside, along the axes without perspective, from within a vertex, an edge and a face, and at the ends of the
/// range of angles.
std::vector<NamedView> hardViews(const mesh::ScalarMesh& m) {
    const glm::dvec3 centre = m.bounds.centre();
    const double size = m.bounds.diagonal();
    std::vector<NamedView> views;
    auto add = [&](std::string name, const glm::dvec3& eye, const glm::dvec3& target, double fov = 35,
                   double height = 0) {
        Camera camera = cameraAt(eye, target, 40, 30);
        const glm::dvec3 forward = glm::normalize(target - eye);
        camera.up = std::abs(forward.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        camera.fovDegrees = fov;
        if (height > 0) camera.orthographicHeight = height;
        views.push_back({std::move(name), camera});
    };
    add("from beside", centre + size * glm::dvec3(0.9, 0.6, 1.1), centre);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0);
        along[axis] = size;
        add("along axis " + std::to_string(axis), centre + along, centre, 35, 0.7 * size);
    }
    add("along the diagonal", centre + size * glm::normalize(glm::dvec3(1)), centre, 35, 0.8 * size);
    const mesh::Tetrahedron& cell = m.cells[m.cells.size() / 3];
    const glm::dvec3 a = m.positions[cell[0]], b = m.positions[cell[1]], c = m.positions[cell[2]];
    add("eye on a vertex", a, a + 0.4 * (centre - a) + 0.1 * size * glm::dvec3(0.3, 0.2, -0.4), 70);
    add("eye on an edge", 0.5 * (a + b), centre + 0.2 * size * glm::dvec3(0.1, 0.3, 0.5), 70);
    add("eye on a face", (a + b + c) / 3.0, centre + 0.2 * size * glm::dvec3(-0.4, 0.1, 0.3), 70);
    add("fov 0.01", centre + 3.0 * size * glm::dvec3(0.5, 0.4, 0.7), centre, 0.01);
    add("fov 170", centre + 0.2 * size * glm::dvec3(0.5, 0.4, 0.7), centre, 170);
    return views;
}

class HardOrders : public ::testing::TestWithParam<OrderCase> {};

TEST_P(HardOrders, LeaveNoPixelWrong) {
    const OrderCase& orderCase = GetParam();
    const mesh::ScalarMesh m = orderCase.mesh();
    const std::vector<NamedView> views = hardViews(m);
    double covered = 0;
    for (const auto& [functionName, function, mode, threshold] :
         {std::tuple("smooth", smoothFunction(0, 1, 12 / m.bounds.diagonal()), Mode::Standard, Threshold{1e-4, 5e-3}),
          // an outline pixel that falls the other way shows an isosurface or does not
          std::tuple("isosurfaces", isosurfacesFunction(0, 1), Mode::ScaleInvariant, Threshold{2e-3, 1.0})}) {
        const Scene scene = sceneOf(m, function, mode);
        std::vector<Image> expected;
        for (const NamedView& view : views) {
            expected.push_back(referenceImage(scene, view.camera));
            covered += coveredShare(expected.back());
        }
        for (const auto& options : enginesUnderTest()) {
            if (options.engine == "reference") continue;
            const auto engine = makeEngine(scene, options);
            for (std::size_t i = 0; i < views.size(); ++i) {
                SCOPED_TRACE(
                    fmt::format("{}, {}, {}, {}", orderCase.name, functionName, views[i].name, options.engine));
                holdPictureTo(expected[i], *engine, views[i].camera, threshold,
                              fmt::format("{} {} {}", orderCase.name, functionName, views[i].name));
            }
        }
    }
    EXPECT_GT(covered, 1.0) << "little is seen in any view: nothing was tested";
}

INSTANTIATE_TEST_SUITE_P(Stress, HardOrders,
                         ::testing::Values(OrderCase{"rings", interlockedRings}, OrderCase{"helices", helices},
                                           OrderCase{"cycles", [] { return manyCycles(8); }},
                                           OrderCase{"prisms", [] { return twistedPrisms(4); }},
                                           OrderCase{"chess", [] { return chessCubes(6); }},
                                           OrderCase{"hanging", hangingLayers},
                                           OrderCase{"doubled", [] { return doubledCells(false); }},
                                           OrderCase{"copied", [] { return doubledCells(true); }},
                                           OrderCase{"far", farAndTiny}),
                         [](const auto& testCase) { return std::string(testCase.param.name); });

}  // namespace
}  // namespace tetralux::projection
