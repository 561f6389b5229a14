// SPDX-License-Identifier: Apache-2.0
//
// The mappings of table_lookup.glsl: each pair is inverse, ends lie at texel centres, kinks too.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <preint/glsl_prelude.h>
#include <preint/preintegration_table.h>

#include "sample_functions.h"

namespace tetralux::preint {
namespace {

using namespace tetralux::glsl;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"

/// Zones without warp, as engines read them.
struct Linear {
    std::vector<glm::dvec2> tableZone;
    double tableSize = 0, tableSlices = 0, tableLengthMax = 0, tableLengthScale = 0;
    glm::dvec4 seen{0};  ///< the coordinates at which the texture was asked
    glm::dvec4 tableTexel(double u, double v, double w) { return seen = glm::dvec4(u, v, w, 0); }
#define TETRALUX_DISCONTINUITIES 1
#define TETRALUX_SCALE_INVARIANT 0
#include <preint/table_lookup.glsl>
#undef TETRALUX_DISCONTINUITIES
#undef TETRALUX_SCALE_INVARIANT
#undef TETRALUX_WARPS
#undef TETRALUX_WARP_COUNT
#undef TETRALUX_RAMPS
#undef TETRALUX_RAMP_COUNT
};

struct Warped {
    std::vector<glm::dvec2> tableWarp;
    std::vector<glm::dvec3> tableRamp;
    double tableSize = 0;
    static glm::dvec4 tableTexel(double u, double v, double w) { return glm::dvec4(u, v, w, 0); }
#define TETRALUX_DISCONTINUITIES 0
#define TETRALUX_SCALE_INVARIANT 1
#define TETRALUX_WARPS 1
#define TETRALUX_WARP_COUNT static_cast<int>(tableWarp.size())
#define TETRALUX_RAMPS 1
#define TETRALUX_RAMP_COUNT static_cast<int>(tableRamp.size())
#include <preint/table_lookup.glsl>
};
#pragma GCC diagnostic pop

TEST(TableMapping, TexelAndFractionAreInverse) {
    const Linear mapping;
    EXPECT_EQ(mapping.tableSize, 0);
    for (const double size : {2.0, 32.0, 1000.0}) {
        EXPECT_EQ(Linear().texelOfFraction(0.0, size), 0.5);
        EXPECT_EQ(Linear().texelOfFraction(1.0, size), size - 0.5);
        for (double fraction = 0.0; fraction <= 1.0; fraction += 0.01) {
            EXPECT_NEAR(Linear().fractionOfTexel(Linear().texelOfFraction(fraction, size), size), fraction, 1e-14);
        }
    }
}

TEST(TableMapping, LengthAndFractionAreInverse) {
    for (const double scale : {1e-3, 0.2, 50.0}) {
        EXPECT_EQ(Linear().fractionOfLength(0.0, 1.7, scale), 0.0);
        EXPECT_NEAR(Linear().fractionOfLength(1.7, 1.7, scale), 1.0, 1e-15);
        for (double length = 1e-6; length < 1.7; length *= 1.3) {
            EXPECT_NEAR(Linear().lengthOfFraction(Linear().fractionOfLength(length, 1.7, scale), 1.7, scale), length,
                        1e-13);
        }
    }
}

TEST(TableMapping, ScalarAndFractionAreInverseWithinEachZone) {
    Linear linear;
    linear.tableZone = {{-2.0, 1.0 / 3.0}, {1.0, 4.0}};
    for (double fraction = 0.0; fraction <= 1.0; fraction += 0.05) {
        EXPECT_NEAR(linear.fractionOfScalar(0, linear.scalarOfFraction(0, fraction)), fraction, 1e-14);
        EXPECT_NEAR(linear.fractionOfScalar(1, linear.scalarOfFraction(1, fraction)), fraction, 1e-14);
    }
    EXPECT_EQ(linear.fractionOfScalar(0, 5.0), 1.0);
    EXPECT_EQ(linear.fractionOfScalar(1, -5.0), 0.0);
}

TEST(TableMapping, RowsStayWithinTheirZone) {
    Linear linear;
    linear.tableZone = {{0.0, 1.0}, {1.0, 1.0}};
    linear.tableSize = 16;
    linear.tableSlices = 4;
    linear.tableLengthMax = linear.tableLengthScale = 1;
    linear.tableEntry(0, 0.0, 1.0, 5.0);
    EXPECT_EQ(linear.seen.x, 0.5);
    EXPECT_NEAR(linear.seen.y, 15.5, 2e-3);
    EXPECT_LE(linear.seen.y, 15.5) << "the next zone begins at 16.5";
    EXPECT_EQ(linear.seen.z, 3.5) << "lengths beyond the last slice use it";
    linear.tableEntry(1, 1.0, 1.0, 0.0);
    EXPECT_NEAR(linear.seen.y, 16.5, 2e-3);
    EXPECT_GE(linear.seen.y, 16.5);
    EXPECT_EQ(linear.seen.z, 0.5);
}

PreintegrationTable tableOf(const TransferFunction& function, int size) {
    TableOptions options;
    options.size = size;
    options.wantedError = 1.0;
    return buildScaleInvariantTable(ExactIntegral(function), 0.0, 1.0, options);
}

Warped warpedOf(const PreintegrationTable& table) {
    Warped warped;
    warped.tableWarp = table.warp;
    warped.tableRamp = table.ramps;
    warped.tableSize = table.size;
    return warped;
}

TEST(TableMapping, WarpedScalarAndFractionAreInverse) {
    for (const TransferFunction& function : {samples::smooth(), samples::narrowTents(), samples::jumps()}) {
        const PreintegrationTable table = tableOf(function, 64);
        Warped warped = warpedOf(table);
        for (std::size_t zone = 0; zone < table.zones.size(); ++zone) {
            for (int i = 0; i < table.size; ++i) {
                const double scalar = table.texelScalars[zone * table.size + i], fraction = i / (table.size - 1.0);
                EXPECT_NEAR(warped.fractionOfScalar(static_cast<int>(zone), scalar), fraction, 1e-11)
                    << "texel " << i << " of zone " << zone;
                EXPECT_NEAR(warped.scalarOfFraction(static_cast<int>(zone), fraction), scalar, 1e-12);
            }
            EXPECT_NEAR(table.texelScalars[zone * table.size], table.zones[zone].x, 0);
            EXPECT_NEAR(table.texelScalars[(zone + 1) * table.size - 1], table.zones[zone].y, 0);
        }
    }
}

TEST(TableMapping, KinksLieAtTexelCentres) {
    const PreintegrationTable table = tableOf(samples::narrowTents(), 64);
    EXPECT_TRUE(table.warped);
    for (const ExtinctionNode& node : samples::narrowTents().extinction) {
        EXPECT_TRUE(std::find(table.texelScalars.begin(), table.texelScalars.end(), node.scalar) !=
                    table.texelScalars.end())
            << node.scalar;
    }
    EXPECT_FALSE(tableOf(samples::constant(3.0), 64).warped);
}

// One-sided rounding of `front` below the range must not matter either: engines work in float.
TEST(TableMapping, RampsAreTheMeanExtinction) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> scalar(0.0, 1.0);
    for (const TransferFunction& function : {samples::smooth(), samples::jumps(), samples::constant(3.0)}) {
        const ExactIntegral exact(function);
        const PreintegrationTable table = tableOf(function, 32);
        ASSERT_FALSE(table.ramps.empty());
        Warped warped = warpedOf(table);
        for (int i = 0; i < 2000; ++i) {
            const double front = scalar(random), back = i % 2 == 0 ? scalar(random) : std::min(1.0, front + 1e-9);
            const double mean =
                exact.smoothSegment(front, back, 1.0, Integral::ScaleInvariant).opticalDepth / std::abs(back - front);
            EXPECT_NEAR(warped.meanExtinctionOf(front, back), mean, 1e-12 * mean + 1e-13) << front << " " << back;
            EXPECT_NEAR(warped.meanExtinctionOf(front, front), function.extinctionAt(front), 1e-12);
        }
        for (const ExtinctionNode& node : function.extinction) {  // at a jump the value from above
            EXPECT_NEAR(warped.meanExtinctionOf(node.scalar, node.scalar),
                        node.scalar < 1.0 ? function.extinctionAt(node.scalar) : node.extinction, 1e-12);
        }
        EXPECT_GE(warped.meanExtinctionOf(-1e-7, -1e-7), 0.0);
    }
}

}  // namespace
}  // namespace tetralux::preint
