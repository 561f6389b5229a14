// SPDX-License-Identifier: Apache-2.0
// Cells whose corners differ by no more than rounding of double, of float, or a little more: they have a gradient, and
// every engine lights and outlines them by it.
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <mesh/tet/cell_slope.h>
#include <projection/cells/cell_setup.h>
#include <tests/stress/engine_cases.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

constexpr double plateau = 0.1;
const glm::dvec3 eye{1.9, 1.4, 2.3};

/// Noise of some steps of double on one quarter of a box, of float on the next, scalars that differ by 1e-5 on the
/// third and by 0.9 on the last.
mesh::ScalarMesh nearlyFlatMesh() {
    mesh::ScalarMesh m = jitteredBoxMesh(9, 0.2, 4, [](const glm::dvec3&) { return plateau; });
    std::mt19937 random(7);
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        const glm::dvec3 p = m.positions[i];
        const auto step = static_cast<double>(random() % 8);
        const double wave = 0.5 + 0.5 * std::sin(4 * p.x + 2 * p.y) * std::cos(3 * p.z);
        const double rise = p.x < 0.5 ? step * (p.y < 0.5 ? 0x1p-53 : 0x1p-27) : wave * (p.y < 0.5 ? 1e-5 : 0.9);
        m.scalars[i] = plateau + rise;
    }
    m.scalars[0] = 0;
    return finished(std::move(m));
}

Scene litScene(const mesh::ScalarMesh& m, Mode mode) {
    preint::TransferFunction f = smoothFunction(0, 1, 3);
    for (auto& node : f.extinction) node.extinction += 0.5;
    Scene scene = sceneOf(m, f, mode);
    auto& shading = scene.settings.shading;
    shading.silhouette = true;
    shading.lights.push_back({});
    shading.lights.back().towards = glm::normalize(glm::dvec3(1, 2, 1.5));
    return scene;
}

TEST(StressGradients, CellsThatDifferByRoundingAreLitByTheirGradient) {
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const double offset : {0.0, -1.0})
            for (const bool silhouettes : {true, false}) {
                mesh::ScalarMesh m = nearlyFlatMesh();
                // scene units begin elsewhere: the smallest steps are lost in them
                if (offset != 0) m.scalars[0] = offset;
                Scene scene = litScene(finished(std::move(m)), mode);
                scene.settings.shading.silhouette = silhouettes;
                const Image expected = referenceImage(scene, cameraAt(eye));
                EXPECT_GT(coveredShare(expected), 0.2);
                // max: a pixel that an outline of a cell crosses, through which the samples beside the centre see
                // another
                holdEnginesTo(expected, scene, cameraAt(eye), {1e-4, 2e-3},
                              fmt::format("gradients of rounding, {}, range from {}{}",
                                          mode == Mode::Standard ? "standard" : "scale-invariant", offset,
                                          silhouettes ? ", silhouettes" : ""));
            }
}

TEST(StressGradients, IsosurfacesInAndNearValuesThatHardlyDiffer) {
    const mesh::ScalarMesh m = nearlyFlatMesh();
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const double from : {0.0, 3 * 0x1p-53, -1e-8, 1e-8, 2e-7, 5e-7, 5e-6}) {
            Scene scene = litScene(m, mode);
            scene.transferFunction.isosurfaces = {{plateau + from, 0.6, {0.9, 0.5, 0.1}}};
            const Image expected = referenceImage(scene, cameraAt(eye));
            // max: likewise, where what is seen or not is an isosurface
            holdEnginesTo(expected, scene, cameraAt(eye), {1e-4, 1e-2},
                          fmt::format("isosurface {:g} above a plateau, {}", from,
                                      mode == Mode::Standard ? "standard" : "scale-invariant"));
        }
}

TEST(StressGradients, HaveADirectionWhateverTheirMagnitude) {
    for (const double rise : {1.0, 1e-17, 1e-200, 1e-290, 1e200})
        for (const double size : {1.0, 1e-15, 1e12}) {
            mesh::ScalarMesh m = unitTetrahedron({0, rise, 2 * rise, -2 * rise});
            for (auto& p : m.positions) p *= size;
            m = finished(std::move(m));
            const mesh::CellSlope slope = mesh::cellSlope(m, 0);
            ASSERT_TRUE(slope.any());
            const glm::dvec3 direction = glm::dvec3(1, 2, -2) / 3.0;
            EXPECT_NEAR(glm::distance(slope.normal, direction), 0, 1e-15) << rise << " " << size;
            EXPECT_NEAR(slope.magnitude / (3.0 * (rise / size)), 1.0, 1e-14) << rise << " " << size;
            const CellGradient gradient = unitGradient(m, sceneUnits(m), 0);
            EXPECT_GT(gradient.magnitude, 0.0f);
        }
    EXPECT_FALSE(mesh::cellSlope(unitTetrahedron({0.1, 0.1, 0.1, 0.1}), 0).any());
    EXPECT_TRUE(mesh::cellSlope(unitTetrahedron({0.1, 0.1, 0.1, std::nextafter(0.1, 1.0)}), 0).any());
}

}  // namespace
}  // namespace tetralux::projection
