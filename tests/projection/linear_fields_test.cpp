// SPDX-License-Identifier: Apache-2.0
//
// A linear field on cells of every type, by the reference and by the tile engine.
#include <gtest/gtest.h>

#include <projection/frame/engine_registry.h>

#include "linear_field_scenes.h"

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

TEST(LinearFields, ReferenceDoesNotSeeTheCells) {
    const Image plain = referenceOf(plainLinearScene());
    ASSERT_GT(plain.pixels[plain.pixels.size() / 2 + 28].w, 0.5f) << "the cube is not in the picture";
    for (const LinearFieldCase& each : linearFieldCases()) {
        SCOPED_TRACE(each.name);
        const ImageDifference difference = compareImages(referenceOf(linearFieldScene(each.soup)), plain);
        EXPECT_LE(difference.max, 1e-6);  // what float pixels and the sums of more segments leave
    }
}

TEST(LinearFields, TileEngineDoesNotSeeTheCells) {
    const Image plain = referenceOf(plainLinearScene());
    for (const LinearFieldCase& each : linearFieldCases()) {
        SCOPED_TRACE(each.name);
        FrameReport report;
        const Image image =
            makeEngine(linearFieldScene(each.soup), {"cpu", "auto"})->render(linearFieldCamera(), report);
        const ImageDifference difference = compareImages(image, plain);
        EXPECT_LE(difference.rmse, 2e-5);
        EXPECT_LE(difference.max, 1e-4);  // floats, and the shift of samples by 2^-14 pixel
    }
}

}  // namespace
}  // namespace tetralux::projection
