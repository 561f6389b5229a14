// SPDX-License-Identifier: Apache-2.0
#include <preint/exact_integral.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "sample_functions.h"
#include "simpson_oracle.h"

namespace tetralux::preint {
namespace {

constexpr Integral bothIntegrals[] = {Integral::Standard, Integral::ScaleInvariant};

void expectRelative(double value, double expected, double tolerance, const std::string& what) {
    EXPECT_LE(std::abs(value - expected), tolerance * std::abs(expected) + 1e-300)
        << what << ": " << value << " against " << expected;
}

void expectSame(const SegmentResult& result, const SegmentResult& expected, double tolerance, const std::string& what) {
    for (int channel = 0; channel < 3; ++channel) {
        expectRelative(result.color[channel], expected.color[channel], tolerance,
                       what + " color " + std::to_string(channel));
    }
    if (std::isinf(expected.opticalDepth)) {
        EXPECT_EQ(result.opticalDepth, expected.opticalDepth) << what;
    } else {
        expectRelative(result.opticalDepth, expected.opticalDepth, tolerance, what + " depth");
    }
}

SegmentResult compositeOf(const SegmentResult& front, const SegmentResult& back) {
    return {front.color + front.transmittance() * back.color, front.opticalDepth + back.opticalDepth};
}

TEST(ExactIntegral, ConstantFieldHasTheClosedForm) {
    const ExactIntegral exact(samples::constant(3.0));
    const double lengths[] = {0.0, 1e-15, 1e-6, 0.01, 1.0, 50.0, 1e15};
    for (const double length : lengths) {
        const SegmentResult result = exact.segment(0.3, 0.3, length, Integral::Standard);
        EXPECT_EQ(result.opticalDepth, 3.0 * length);
        expectRelative(result.color.x, 0.8 * -std::expm1(-3.0 * length), 1e-15, "color");
        const SegmentResult dataSpace = exact.segment(0.3, 0.3 + length, 7.0, Integral::ScaleInvariant);
        expectRelative(dataSpace.opticalDepth, 3.0 * ((0.3 + length) - 0.3), 1e-15, "depth over the scalar");
    }
}

TEST(ExactIntegral, ConstantScalarIsTransparentInDataSpace) {
    const ExactIntegral exact(samples::smooth());
    const SegmentResult result = exact.segment(0.45, 0.45, 10.0, Integral::ScaleInvariant);
    EXPECT_EQ(result.opticalDepth, 0.0);
    EXPECT_EQ(result.color, glm::dvec3(0.0));
}

// τ(s) = 20 s: from 0.1 to 0.9 over length 2 the depth is 2·mean τ = 20, in data space 0.8·mean τ = 8.
TEST(ExactIntegral, LinearExtinctionHasTheDepthOfItsMean) {
    TransferFunction ramp = samples::constant(0.0);
    ramp.extinction = {{0.0, 0.0}, {1.0, 20.0}};
    const ExactIntegral exact(ramp);
    expectRelative(exact.segment(0.1, 0.9, 2.0, Integral::Standard).opticalDepth, 20.0, 1e-15, "standard");
    expectRelative(exact.segment(0.9, 0.1, 2.0, Integral::ScaleInvariant).opticalDepth, 8.0, 1e-15, "data space");
    expectRelative(exact.segment(0.1, 0.9, 2.0, Integral::Standard).transmittance(), std::exp(-20.0), 1e-13,
                   "exp(−∫τ)");
}

// Colour linear, extinction constant: C = c_f(1 − Ψ) + c_b(Ψ − e^(−D)) with Ψ = (1 − e^(−D))/D.
TEST(ExactIntegral, LinearColorOverConstantExtinctionHasTheClosedForm) {
    TransferFunction function;
    function.color = {{0.0, {0.0, 1.0, 0.25}}, {1.0, {1.0, 0.0, 0.75}}};
    function.extinction = {{0.0, 1.0}};
    const ExactIntegral exact(function);
    for (double depth = 0.125; depth < 700.0; depth *= 1.37) {
        const SegmentResult result = exact.segment(0.0, 1.0, depth, Integral::Standard);
        const long double psi = -std::expm1(-static_cast<long double>(depth)) / depth,
                          zeta = std::exp(-static_cast<long double>(depth));
        expectRelative(result.color.x, static_cast<double>(psi - zeta), 1e-13, "back weight");
        expectRelative(result.color.y, static_cast<double>(1.0L - psi), 1e-13, "front weight");
        expectRelative(result.color.z, static_cast<double>(0.25L * (1.0L - psi) + 0.75L * (psi - zeta)), 1e-13,
                       "mixed");
    }
}

TEST(LinearPieceWeights, SumIsTheOpacity) {
    for (double front = 1e-15; front < 1e16; front *= 3.7) {
        for (double back = 1e-15; back < 1e16; back *= 5.3) {
            const LinearPieceWeights weights = linearPieceWeights(front, back);
            expectRelative(weights.frontWeight + weights.backWeight, -std::expm1(-0.5 * (front + back)), 1e-13, "sum");
            EXPECT_GT(weights.frontWeight, 0.0);
            EXPECT_GT(weights.backWeight, 0.0);
        }
    }
}

TEST(LinearPieceWeights, ThinPiecesHaveTheKnownLimit) {
    const double depths[] = {1e-15, 1e-12, 1e-9};
    for (const double scale : depths) {
        const double front = 0.3 * scale, back = 1.7 * scale;
        const LinearPieceWeights weights = linearPieceWeights(front, back);
        expectRelative(weights.frontWeight, front / 3.0 + back / 6.0, 2.0 * scale + 1e-15, "front");
        expectRelative(weights.backWeight, front / 6.0 + back / 3.0, 2.0 * scale + 1e-15, "back");
    }
}

// Great depth a at the front: u ≈ a t, so backWeight = ∫ t dT → 1/a; starting at 0, u = b t²/2 and backWeight →
// √(π/(2b)).
TEST(LinearPieceWeights, DeepPiecesHaveTheirAsymptotes) {
    const double depths[] = {1e6, 1e9, 1e12, 1e15};
    for (const double depth : depths) {
        expectRelative(linearPieceWeights(depth, depth).backWeight, 1.0 / depth, 1e-12, "even");
        expectRelative(linearPieceWeights(0.0, depth).backWeight, std::sqrt(std::acos(-1.0) / (2.0 * depth)), 1e-12,
                       "from zero");
        EXPECT_NEAR(linearPieceWeights(0.0, depth).frontWeight + linearPieceWeights(0.0, depth).backWeight, 1.0, 1e-13);
    }
    EXPECT_EQ(linearPieceWeights(1e300, 0.0).frontWeight, 1.0);
    EXPECT_EQ(linearPieceWeights(0.0, std::numeric_limits<double>::infinity()).frontWeight, 1.0);
}

// The quadrature rules meet at these depths; an error of one of them would show as a step.
TEST(LinearPieceWeights, AgreesWithSimpsonOnBothSidesOfEveryRuleChange) {
    const double changes[] = {0.0016, 0.11, 0.66, 3.4, 44.0};
    const double shares[] = {0.0, 0.03, 0.4, 0.9, 1.0};
    for (const double change : changes) {
        for (const double share : shares) {
            for (const double depth : {change * 0.999, change * 1.001}) {
                const double front = 2.0 * depth * share, back = 2.0 * depth - front;
                const LinearPieceWeights weights = linearPieceWeights(front, back);
                auto mass = [&](long double t) {
                    return (front + (back - front) * t) * std::exp(-(front * t + (back - front) * t * t / 2.0L));
                };
                const auto frontWeight =
                    oracle::simpson([&](long double t) { return (1.0L - t) * mass(t); }, 0.0L, 1.0L);
                const auto backWeight = oracle::simpson([&](long double t) { return t * mass(t); }, 0.0L, 1.0L);
                expectRelative(weights.frontWeight, static_cast<double>(frontWeight), 3e-13, "front");
                expectRelative(weights.backWeight, static_cast<double>(backWeight), 3e-13, "back");
            }
        }
    }
}

TEST(ExactIntegral, AgreesWithSimpsonQuadratureOfTheDefinition) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> scalar(-0.2, 1.2), exponent(-6.0, 1.5);
    for (const TransferFunction& function : {samples::smooth(), samples::narrowTents(), samples::jumps()}) {
        const ExactIntegral exact(function);
        for (int sample = 0; sample < 60; ++sample) {
            const double front = scalar(random), length = std::pow(10.0, exponent(random));
            const double back = sample % 3 == 0 ? front + 1e-3 * scalar(random) : scalar(random);
            for (const Integral integral : bothIntegrals) {
                expectSame(exact.segment(front, back, length, integral),
                           oracle::segment(function, front, back, length, integral), 1e-12,
                           "from " + std::to_string(front) + " to " + std::to_string(back) + " over " +
                               std::to_string(length));
            }
        }
    }
}

TEST(ExactIntegral, PartsCompositeToTheWhole) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> scalar(-0.1, 1.1), part(0.0, 1.0), exponent(-5.0, 1.0);
    for (const TransferFunction& function :
         {samples::smooth(), samples::narrowTents(), samples::jumps(), samples::smoothWithIsosurfaces()}) {
        const ExactIntegral exact(function);
        for (int sample = 0; sample < 2000; ++sample) {
            const double front = scalar(random), back = scalar(random), length = std::pow(10.0, exponent(random));
            const double middle = front + (back - front) * part(random), share = (middle - front) / (back - front);
            for (const Integral integral : bothIntegrals) {
                const SegmentResult parts =
                    compositeOf(exact.segment(front, middle, length * share, integral),
                                exact.segment(middle, back, length * ((back - middle) / (back - front)), integral));
                expectSame(parts, exact.segment(front, back, length, integral), 1e-12, "parts");
            }
        }
    }
}

TEST(ExactIntegral, ExtinctionIntegralIsTheDepthInDataSpace) {
    const ExactIntegral exact(samples::jumps());
    for (double low = -0.5; low < 1.5; low += 0.0618) {
        for (double high = low; high < 1.5; high += 0.1327) {
            EXPECT_NEAR(exact.extinctionIntegral(high) - exact.extinctionIntegral(low),
                        exact.segment(high, low, 1.0, Integral::ScaleInvariant).opticalDepth, 1e-13);
        }
    }
    EXPECT_EQ(exact.extinctionIntegral(0.0), 0.0);
    EXPECT_DOUBLE_EQ(exact.extinctionIntegral(-2.0), -2.0);
}

// Crossing is (front < v) ≠ (back < v): arriving at v from below counts, leaving v upwards does not; downwards it is
// the other way round.
TEST(ExactIntegral, IsosurfaceIsCrossedOnceByNeighbouringSegments) {
    TransferFunction function = samples::isosurfaces();
    const ExactIntegral exact(function);
    const double v = function.isosurfaces[0].value, below = v - 0.1, above = v + 0.1;
    const double once = -std::log1p(-0.4);
    auto depth = [&](double front, double back) {
        return exact.segment(front, back, 1.0, Integral::Standard).opticalDepth;
    };
    EXPECT_DOUBLE_EQ(depth(below, v), once);
    EXPECT_EQ(depth(v, above), 0.0);
    EXPECT_EQ(depth(above, v), 0.0);
    EXPECT_DOUBLE_EQ(depth(v, below), once);
    EXPECT_EQ(depth(v, v), 0.0);
    EXPECT_DOUBLE_EQ(depth(below, above), once);
}

TEST(ExactIntegral, IsosurfacesAttenuateWhatLiesBehindThem) {
    const ExactIntegral exact(samples::isosurfaces());
    const SegmentResult rising = exact.segment(0.0, 1.0, 1.0, Integral::ScaleInvariant);
    const glm::dvec3 first{1.0, 0.2, 0.1}, second{0.1, 0.4, 1.0};
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(rising.color[i], 0.4 * first[i] + 0.6 * 0.7 * second[i], 1e-15);
    EXPECT_NEAR(rising.transmittance(), 0.6 * 0.3, 1e-15);
    const SegmentResult falling = exact.segment(1.0, 0.0, 1.0, Integral::ScaleInvariant);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(falling.color[i], 0.7 * second[i] + 0.3 * 0.4 * first[i], 1e-15);
}

TEST(ExactIntegral, IsosurfacesAtOneValueKeepTheirOrderFromBelow) {
    TransferFunction function = samples::isosurfaces();
    function.isosurfaces = {{0.5, 0.5, {1, 0, 0}}, {0.5, 0.5, {0, 1, 0}}};
    const ExactIntegral exact(function);
    EXPECT_EQ(exact.segment(0.0, 1.0, 1.0, Integral::Standard).color, glm::dvec3(0.5, 0.25, 0.0));
    EXPECT_EQ(exact.segment(1.0, 0.0, 1.0, Integral::Standard).color, glm::dvec3(0.25, 0.5, 0.0));
}

TEST(ExactIntegral, OpaqueIsosurfaceHidesEverythingBehindIt) {
    TransferFunction function = samples::smooth();
    function.isosurfaces = {{0.1, 1.0, {0.0, 1.0, 0.0}}};
    const ExactIntegral exact(function);
    const SegmentResult result = exact.segment(0.0, 1.0, 1.0, Integral::Standard);
    EXPECT_EQ(result.opticalDepth, std::numeric_limits<double>::infinity());
    EXPECT_EQ(result.opacity(), 1.0);
    const SegmentResult before = exact.smoothSegment(0.0, 0.1, 0.1, Integral::Standard);
    EXPECT_NEAR(result.color.y, before.color.y + before.transmittance(), 1e-15);
}

TEST(ExactIntegral, BeyondTheNodesValuesAreConstant) {
    const ExactIntegral exact(samples::smooth());
    expectRelative(exact.segment(2.0, 3.0, 0.5, Integral::Standard).opticalDepth, 6.0, 1e-15, "above");
    EXPECT_EQ(exact.segment(-5.0, -1.0, 0.5, Integral::Standard).opticalDepth, 0.0);
}

TEST(ExactIntegral, RefusesFunctionsThatAreNotAbsolute) {
    TransferFunction function = samples::smooth();
    function.normalized = true;
    EXPECT_THROW(ExactIntegral{function}, std::runtime_error);
    function = samples::smooth();
    std::swap(function.color[1], function.color[2]);
    EXPECT_THROW(ExactIntegral{function}, std::runtime_error);
    EXPECT_THROW(ExactIntegral{TransferFunction{}}, std::runtime_error);
}

}  // namespace
}  // namespace tetralux::preint
