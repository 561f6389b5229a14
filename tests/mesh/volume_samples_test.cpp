// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/select_scalar.h>
#include <mesh/tet/volume_samples.h>

#include <numeric>

#include <mesh/tet/procedural_field.h>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using namespace test;

/// A box of size (a, b, c) with the field x / a.
ScalarMesh box(const glm::dvec3& size) {
    ProceduralField field{"box", "s", {glm::dvec3(0), size}, [size](const glm::dvec3& x) { return x.x / size.x; }, {}};
    ReadResult sampled;
    sampled.mesh = sampleOnGrid(field, 4);
    return selectScalar(std::move(sampled.mesh), "s", sampled.report).mesh;
}

TEST(VolumeSamples, AreSpreadEvenly) {
    const VolumeSamples samples = sampleVolume(box({2, 3, 4}));
    EXPECT_NEAR(static_cast<double>(samples.scalars.size()), 100'000.0, 2.0);
    const double count = static_cast<double>(samples.scalars.size());
    EXPECT_NEAR(std::accumulate(samples.scalars.begin(), samples.scalars.end(), 0.0) / count, 0.5, 0.005);
    for (int part = 0; part < 10; ++part) {
        const auto inside = std::count_if(samples.scalars.begin(), samples.scalars.end(),
                                          [&](double s) { return s >= 0.1 * part && s < 0.1 * (part + 1); });
        EXPECT_NEAR(static_cast<double>(inside) / count, 0.1, 0.01) << part;  // ten times their number's root
    }
}

TEST(VolumeSamples, MeanWayIsVolumeOverShadow) {
    for (const double unit : {1e-120, 1e-6, 1.0, 1e6, 1e120}) {
        const glm::dvec3 size = unit * glm::dvec3(2, 3, 4);
        EXPECT_NEAR(sampleVolume(box(size)).meanWay / unit, 24.0 / ((6.0 + 8.0 + 12.0) / 3.0), 1e-9) << unit;
    }
}

/// Of a block only the cells at one corner: the way is that through these, not through the box.
TEST(VolumeSamples, EmptyPartsOfTheBoxDoNotCount) {
    ScalarMesh mesh = box({1, 1, 1});
    std::vector<Tetrahedron> cells(mesh.cells.begin(), mesh.cells.end());
    std::erase_if(cells, [&](const Tetrahedron& t) {
        glm::dvec3 centre(0);
        for (const PointIndex p : t) {
            centre += 0.25 * mesh.positions[p];
        }
        return centre.x > 1.0 / 3.0 && centre.y > 1.0 / 3.0;  // leaves an L of 5/9 of the volume
    });
    mesh.cells = std::move(cells);
    EXPECT_NEAR(sampleVolume(mesh).meanWay, (5.0 / 9.0) / ((1.0 + 1.0 + 5.0 / 9.0) / 3.0), 0.02);
}

}  // namespace
}  // namespace tetralux::mesh
