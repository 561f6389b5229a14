// SPDX-License-Identifier: Apache-2.0
//
// A linear field on cells of every type, by the OpenGL engine in each kind of context.
#include <gtest/gtest.h>

#include <projection/engine.h>

#include "linear_field_scenes.h"

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

class GlLinearFields : public testing::TestWithParam<const char*> {};

TEST_P(GlLinearFields, CellsAreNotSeen) {
    const Image plain = referenceOf(plainLinearScene());
    for (const LinearFieldCase& each : linearFieldCases()) {
        if (each.name.find("_warped") == std::string::npos) continue;  // the harder half
        SCOPED_TRACE(each.name);
        Scene scene = linearFieldScene(each.soup);
        scene.settings.table.wantedError =
            1e-5;  // so that the error of the table, per segment, is none of the picture's
        FrameReport report;
        const Image image = makeEngine(scene, {"gl", GetParam()})->render(linearFieldCamera(), report);
        const ImageDifference difference = compareImages(image, plain);
        EXPECT_LE(difference.rmse, 5e-5);  // 2e-5 seen
        // One pixel at the rim of the cube is 1.8e-4 off, the same one for all cells: the engine's, not theirs.
        EXPECT_LE(difference.max, 3e-4);
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, GlLinearFields, testing::Values("egl", "osmesa"));

}  // namespace
}  // namespace tetralux::projection
