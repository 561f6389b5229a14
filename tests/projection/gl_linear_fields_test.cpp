// SPDX-License-Identifier: Apache-2.0
//
// A linear field on cells of every type, by the OpenGL engine in each kind of context.
#include <gtest/gtest.h>

#include <projection/frame/engine_registry.h>

#include "linear_field_scenes.h"

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

class GlLinearFields : public testing::TestWithParam<const char*> {};

TEST_P(GlLinearFields, CellsAreNotSeen) {
    const Image plain = referenceOf(plainLinearScene());
    for (const LinearFieldCase& each : linearFieldCases()) {
        const bool bent = each.name.find("_warped") != std::string::npos;
        if (!bent && GetParam() == std::string("osmesa")) continue;  // once is enough of the easier half
        SCOPED_TRACE(each.name);
        FrameReport report;
        const Image image =
            makeEngine(linearFieldScene(each.soup), {"gl", GetParam()})->render(linearFieldCamera(), report);
        const ImageDifference difference = compareImages(image, plain);
        EXPECT_LE(difference.rmse, 1e-5);  // 2.9e-6 seen
        EXPECT_LE(difference.max, 1e-4);   // 2.4e-5 seen: floats, at the rim of the cube
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, GlLinearFields, testing::Values("egl", "osmesa"));

}  // namespace
}  // namespace tetralux::projection
