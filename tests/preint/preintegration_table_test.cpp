// SPDX-License-Identifier: Apache-2.0
#include <preint/preintegration_table.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <preint/table_texels.h>

#include "sample_functions.h"

namespace tetralux::preint {
namespace {

double differenceOf(const SegmentResult& a, const SegmentResult& b) {
    const glm::dvec3 color = glm::abs(a.color - b.color);
    return std::max({color.x, color.y, color.z, std::abs(a.opacity() - b.opacity())});
}

SegmentResult compositeOf(const SegmentResult& front, const SegmentResult& back) {
    return {front.color + front.transmittance() * back.color, front.opticalDepth + back.opticalDepth};
}

struct Case {
    const char* name;
    TransferFunction function;
};

class TableAccuracy : public testing::TestWithParam<Case> {
protected:
    static constexpr double lengthMax = 0.06;  // a cell of some 1/30 of the mesh

    PreintegrationTable table(Integral integral, double wantedError) const {
        TableOptions options;
        options.wantedError = wantedError;
        return integral == Integral::ScaleInvariant ? buildScaleInvariantTable(exact_, 0.0, 1.0, options)
                                                    : buildStandardTable(exact_, 0.0, 1.0, lengthMax, options);
    }

    ExactIntegral exact_{GetParam().function};
};

// Segments of its own choosing: the builder's samples must not be all that the error holds for. Random segments hit the
// worst spots less often than the builder's, but may find others, hence twice the wanted error.
TEST_P(TableAccuracy, SegmentsKeepTheWantedError) {
    for (const Integral integral : {Integral::Standard, Integral::ScaleInvariant}) {
        for (const double wanted : {1e-3, 1e-4}) {
            const PreintegrationTable built = table(integral, wanted);
            EXPECT_LE(built.measuredError, wanted);
            std::mt19937_64 random(5);
            std::uniform_real_distribution<double> unit(0.0, 1.0);
            double largest = 0.0;
            for (int i = 0; i < 4000; ++i) {
                const double front = unit(random), step = std::pow(10.0, -4.0 * unit(random)) * (unit(random) - 0.5);
                const double back = i % 2 == 0 ? unit(random) : std::min(1.0, std::max(0.0, front + step)),
                             length = lengthMax * unit(random);
                largest = std::max(largest, differenceOf(lookUpSegment(built, front, back, length),
                                                         exact_.segment(front, back, length, integral)));
            }
            EXPECT_LE(largest, 2.0 * wanted)
                << "size " << built.size << " × " << built.slices << ", " << built.zones.size() << " zones";
        }
    }
}

// A thousand thin segments: their errors add up along the ray, and so would any bias.
TEST_P(TableAccuracy, RaysOfManyThinSegmentsKeepTheWantedError) {
    for (const Integral integral : {Integral::Standard, Integral::ScaleInvariant}) {
        const PreintegrationTable built = table(integral, 1e-4);
        std::mt19937_64 random(6);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (const double turns : {0.5, 3.2}) {
            for (const double start : {0.0, 0.37, 1.0}) {
                SegmentResult looked, exact;
                constexpr int steps = 1000;
                auto scalarAt = [&](double t) {
                    return 0.5 - 0.5 * std::cos(std::acos(-1.0) * (start + 2.0 * turns * t));
                };
                double t = 0.0;
                for (int i = 0; i < steps; ++i) {
                    const double next = (i + unit(random)) / steps, length = (next - t) * 1.5;
                    looked = compositeOf(looked, lookUpSegment(built, scalarAt(t), scalarAt(next), length));
                    exact = compositeOf(exact, exact_.segment(scalarAt(t), scalarAt(next), length, integral));
                    t = next;
                }
                EXPECT_LE(differenceOf(looked, exact), 1e-4) << "turns " << turns << " from " << start;
            }
        }
    }
}

TEST_P(TableAccuracy, SegmentsAlongOneScalar) {
    const PreintegrationTable standard = table(Integral::Standard, 1e-4), flat = table(Integral::ScaleInvariant, 1e-4);
    for (double scalar = 0.0; scalar <= 1.0; scalar += 1.0 / 1013.0) {
        EXPECT_LE(differenceOf(lookUpSegment(standard, scalar, scalar, 0.05),
                               exact_.segment(scalar, scalar, 0.05, Integral::Standard)),
                  2e-4)
            << scalar;
        EXPECT_EQ(lookUpSegment(flat, scalar, scalar, 0.05).opticalDepth, 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Functions, TableAccuracy,
                         testing::Values(Case{"constant", samples::constant(7.0)}, Case{"smooth", samples::smooth()},
                                         Case{"narrowTents", samples::narrowTents()}, Case{"jumps", samples::jumps()},
                                         Case{"isosurfaces", samples::isosurfaces()},
                                         Case{"smoothWithIsosurfaces", samples::smoothWithIsosurfaces()},
                                         Case{"viridis", resolved(preset("viridis"), 0.0, 1.0, 1.0)}),
                         [](const auto& suite) { return suite.param.name; });

TEST(PreintegrationTable, MeanColorsOfFaintSegments) {
    // half of what a segment meets shows nothing, and what shows is faint: its colour counts whole all the same
    TransferFunction function;
    function.color = {{0.0, {0.1, 0.9, 0.5}}, {0.35, {0.9, 0.2, 0.4}}, {0.6, {0.3, 0.5, 0.9}}, {1.0, {0.5, 0.1, 0.2}}};
    function.extinction = {{0.0, 1e-3}, {0.3, 0.0}, {0.62, 0.0}, {1.0, 2e-3}};
    const ExactIntegral exact(function);
    const auto largest = [&](const TableOptions& options) {
        const PreintegrationTable table = buildStandardTable(exact, 0.0, 1.0, 0.06, options);
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        double error = 0;
        for (int i = 0; i < 4000; ++i) {
            const double front = unit(random), back = std::clamp(front + 0.4 * (unit(random) - 0.5), 0.0, 1.0);
            const SegmentResult is = exact.segment(front, back, 0.03, Integral::Standard);
            const SegmentResult found = lookUpSegment(table, front, back, 0.03);
            if (is.opacity() == 0 || found.opacity() == 0) continue;
            const glm::dvec3 off = glm::abs(found.color / found.opacity() - is.color / is.opacity());
            error = std::max({error, off.x, off.y, off.z});
        }
        return error;
    };
    TableOptions options;
    options.wantedError = 1e-3;
    EXPECT_GT(largest(options), 5e-3) << "the function no longer tells the options apart";
    options.meanColors = true;
    EXPECT_LT(largest(options), 2e-3);  // twice the wanted error, as above
}

TEST(PreintegrationTable, RecurrenceIsTheDirectIntegral) {
    for (const TransferFunction& function : {samples::smooth(), samples::narrowTents(), samples::jumps()}) {
        const ExactIntegral exact(function);
        TableOptions options;
        options.size = 48;
        options.wantedError = 1.0;
        const PreintegrationTable table = buildScaleInvariantTable(exact, 0.05, 0.93, options);
        const TableTexels direct(exact, table);
        const int rows = table.size * static_cast<int>(table.zones.size());
        for (int row = 0; row < rows; ++row) {
            for (int i = 0; i < table.size; ++i) {
                const glm::vec4 texel = table.texels[static_cast<std::size_t>(row) * table.size + i],
                                expected = direct.texel(i, row, 0);
                for (int c = 0; c < 4; ++c) {
                    EXPECT_NEAR(texel[c], expected[c], 2e-7f * std::max(1.0f, expected[c]))
                        << "front " << i << " row " << row << " channel " << c;
                }
            }
        }
    }
}

TEST(PreintegrationTable, IsosurfacesAloneAreExact) {
    const ExactIntegral exact(samples::isosurfaces());
    const PreintegrationTable table = buildScaleInvariantTable(exact, 0.0, 1.0, {});
    EXPECT_LE(table.measuredError, 1e-15);
    EXPECT_EQ(table.discontinuities.size(), 2u);
    EXPECT_LE(differenceOf(lookUpSegment(table, 0.3, 0.2, 1.0), exact.segment(0.3, 0.2, 1.0, Integral::ScaleInvariant)),
              1e-15);
    EXPECT_LE(differenceOf(lookUpSegment(table, 0.3, 0.7, 1.0), exact.segment(0.3, 0.7, 1.0, Integral::ScaleInvariant)),
              1e-15);
}

TEST(PreintegrationTable, OpaqueIsosurfaceIsInfinitelyDeep) {
    TransferFunction function = samples::smooth();
    function.isosurfaces = {{0.5, 1.0, {0.0, 1.0, 0.0}}};
    const PreintegrationTable table = buildScaleInvariantTable(ExactIntegral(function), 0.0, 1.0, {});
    EXPECT_EQ(lookUpSegment(table, 0.4, 0.6, 1.0).opticalDepth, std::numeric_limits<double>::infinity());
}

// Only what the field can reach: an isosurface at the lowest scalar is never crossed, one at the highest may be.
TEST(PreintegrationTable, DiscontinuitiesLieWithinTheRange) {
    TransferFunction function = samples::jumps();
    function.isosurfaces = {{0.2, 0.5, {1, 0, 0}}, {0.4, 0.5, {1, 0, 0}}, {0.7, 0.5, {1, 0, 0}}, {0.9, 0.5, {1, 0, 0}}};
    const PreintegrationTable table = buildScaleInvariantTable(ExactIntegral(function), 0.2, 0.7, {});
    ASSERT_EQ(table.discontinuities.size(), 3u);
    EXPECT_EQ(table.discontinuities[0].value, 0.4);
    EXPECT_EQ(table.discontinuities[0].opacity, 0.5) << "jump and isosurface at one value are one discontinuity";
    EXPECT_EQ(table.discontinuities[0].zoneBelow, 0);
    EXPECT_EQ(table.discontinuities[0].zoneAbove, 1);
    EXPECT_EQ(table.discontinuities[1].value, 0.6);
    EXPECT_EQ(table.discontinuities[1].opacity, 0.0);
    EXPECT_EQ(table.discontinuities[2].value, 0.7);
    EXPECT_EQ(table.discontinuities[2].zoneAbove, 2);
    EXPECT_EQ(table.zones.size(), 3u);
}

TEST(PreintegrationTable, FieldOfOneValue) {
    const ExactIntegral exact(samples::smooth());
    const PreintegrationTable table = buildStandardTable(exact, 0.3, 0.3, 1.0, {});
    EXPECT_LE(differenceOf(lookUpSegment(table, 0.3, 0.3, 0.7), exact.segment(0.3, 0.3, 0.7, Integral::Standard)),
              1e-6);
}

// The same function in other units of scalar and length: the same picture.
TEST(PreintegrationTable, UnitsDoNotMatter) {
    TransferFunction scaled = samples::smooth();
    const double scalarUnit = 1e6, scalarOffset = -3e7, lengthUnit = 1e-5;
    for (ColorNode& node : scaled.color) node.scalar = scalarOffset + scalarUnit * node.scalar;
    for (ExtinctionNode& node : scaled.extinction)
        node = {scalarOffset + scalarUnit * node.scalar, node.extinction / lengthUnit};
    const PreintegrationTable table =
        buildStandardTable(ExactIntegral(scaled), scalarOffset, scalarOffset + scalarUnit, 0.1 * lengthUnit, {});
    EXPECT_LE(table.measuredError, 1e-4);
    const ExactIntegral exact(samples::smooth());
    EXPECT_LE(differenceOf(lookUpSegment(table, scalarOffset + 0.3 * scalarUnit, scalarOffset + 0.6 * scalarUnit,
                                         0.07 * lengthUnit),
                           exact.segment(0.3, 0.6, 0.07, Integral::Standard)),
              1e-4);
}

TEST(PreintegrationTable, SizesAreAsAskedFor) {
    TableOptions options;
    options.size = 40;
    options.lengthSlices = 5;
    const PreintegrationTable table = buildStandardTable(ExactIntegral(samples::constant(2.0)), 0.0, 1.0, 0.5, options);
    EXPECT_EQ(table.size, 40);
    EXPECT_EQ(table.slices, 5);
    EXPECT_EQ(table.texels.size(), 40u * 40u * 5u);
    EXPECT_GT(table.buildMilliseconds, 0.0);
}

TEST(PreintegrationTable, ManyStepsFit) {
    TransferFunction steps;
    steps.color = {{0.0, {1, 1, 1}}};
    for (int i = 0; i < 300; ++i) {
        steps.extinction.push_back({i / 300.0, static_cast<double>(i % 7)});
        steps.extinction.push_back({(i + 1) / 300.0, static_cast<double>(i % 7)});
    }
    const PreintegrationTable table = buildStandardTable(ExactIntegral(steps), 0.0, 1.0, 0.1, {});
    EXPECT_LE(table.zones.size() * static_cast<std::size_t>(table.size), 2048u);
    EXPECT_LE(table.measuredError, 1e-5);
}

// A node a rounding away from the end of the range, as normalization makes them: no texels fit between the two. Twice
// the wanted error, of which 1.04 is seen: the samples by which sizes are chosen differ from node to node.
TEST(PreintegrationTable, NodesThatAllButMeet) {
    for (const double gap : {6.7e-24, 1e-8}) {
        TransferFunction function = samples::smooth();
        function.extinction.front().scalar = gap;
        function.color.front().scalar = gap;
        const ExactIntegral exact(function);
        EXPECT_LE(buildStandardTable(exact, 0.0, 1.0, 0.06, {}).measuredError, 2e-4) << gap;
        EXPECT_LE(buildScaleInvariantTable(exact, 0.0, 1.0, {}).measuredError, 1e-4) << gap;
    }
}

TEST(PreintegrationTable, RefusesWhatItCannotBuild) {
    const ExactIntegral exact(samples::smooth());
    TableOptions options;
    EXPECT_THROW(buildScaleInvariantTable(exact, 1.0, 0.0, options), std::runtime_error);
    EXPECT_THROW(buildScaleInvariantTable(exact, 0.0, std::nan(""), options), std::runtime_error);
    EXPECT_THROW(buildStandardTable(exact, 0.0, 1.0, 0.0, options), std::runtime_error);
    options.size = 1;
    EXPECT_THROW(buildScaleInvariantTable(exact, 0.0, 1.0, options), std::runtime_error);
    options.size = 1 << 20;
    EXPECT_THROW(buildScaleInvariantTable(exact, 0.0, 1.0, options), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::preint
