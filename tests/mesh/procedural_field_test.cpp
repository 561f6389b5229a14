// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/procedural_field.h>

#include <numbers>

#include <glm/geometric.hpp>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using test::expectError;

class EveryField : public testing::TestWithParam<std::string> {};

TEST_P(EveryField, GradientIsTheLimitOfDifferences) {
    const ProceduralField field = proceduralField(GetParam(), 16);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> inside(0.05, 0.95);
    const glm::dvec3 size = field.domain.high - field.domain.low;
    const double step = 1e-5 * size.x;
    for (int trial = 0; trial < 200; ++trial) {
        const glm::dvec3 x = field.domain.low + size * glm::dvec3(inside(random), inside(random), inside(random));
        const glm::dvec3 gradient = field.gradient(x);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 h(0.0);
            h[axis] = step;
            // Fourth-order central difference.
            const double slope = (8.0 * (field.value(x + h) - field.value(x - h)) -
                                  (field.value(x + 2.0 * h) - field.value(x - 2.0 * h))) /
                                 (12.0 * step);
            EXPECT_NEAR(gradient[axis], slope, 2e-8 * (1.0 + glm::length(gradient)));
        }
    }
}

TEST_P(EveryField, GridFillsTheDomainWithPositiveCells) {
    const int n = 7;
    const ProceduralField field = proceduralField(GetParam(), n);
    const TetMesh mesh = sampleOnGrid(field, n);
    EXPECT_EQ(mesh.cells.size(), 5u * (n - 1) * (n - 1) * (n - 1));
    EXPECT_EQ(mesh.positions.front(), field.domain.low);
    EXPECT_EQ(mesh.positions.back(), field.domain.high);
    const glm::dvec3 size = field.domain.high - field.domain.low;
    const double volume = size.x * size.y * size.z;
    EXPECT_NEAR(test::totalVolume(mesh), volume, 1e-12 * volume);
    EXPECT_LT(test::largestError(mesh, field.value), 1e-15);
    EXPECT_EQ(mesh.fields[0].name, field.fieldName);
}

TEST_P(EveryField, IsFiniteAtItsCentreAndCorners) {
    const ProceduralField field = proceduralField(GetParam(), 5);
    for (const glm::dvec3& x : {field.domain.centre(), field.domain.low, field.domain.high}) {
        EXPECT_TRUE(std::isfinite(field.value(x)));
        EXPECT_TRUE(std::isfinite(glm::length(field.gradient(x))));
    }
}

INSTANTIATE_TEST_SUITE_P(Names, EveryField, testing::ValuesIn(proceduralFieldNames()), [](const auto& kind) {
    return kind.param == "marschner-lobb" ? std::string("marschner_lobb") : kind.param;
});

TEST(BuckyBall, HasTheStatedSizeAndNorm) {
    const TetMesh mesh = sampleOnGrid(proceduralField("bucky", 32), 32);
    EXPECT_EQ(mesh.cells.size(), 148955u);
    EXPECT_EQ(*std::max_element(mesh.fields[0].values.begin(), mesh.fields[0].values.end()), 1.0);
}

TEST(BuckyBall, HasIcosahedralSymmetry) {
    const ProceduralField field = proceduralField("bucky", 8);
    // A turn by 72° about the fivefold axis (0, 1, φ) and one by 120° about (1, 1, 1) leave C60 as it is.
    const auto turned = [](const glm::dvec3& v, const glm::dvec3& axis, double angle) {
        const glm::dvec3 k = glm::normalize(axis);
        return v * std::cos(angle) + glm::cross(k, v) * std::sin(angle) + k * glm::dot(k, v) * (1.0 - std::cos(angle));
    };
    const glm::dvec3 centre(0.5);
    for (const glm::dvec3& v : {glm::dvec3(0.31, 0.1, 0.2), glm::dvec3(-0.2, 0.33, 0.05), glm::dvec3(0.4, 0.0, 0.1)}) {
        const double value = field.value(centre + v);
        EXPECT_NEAR(field.value(centre + turned(v, {1, 1, 1}, 2.0 * std::numbers::pi / 3.0)), value, 1e-13);
        EXPECT_NEAR(field.value(centre + turned(v, {0, 1, std::numbers::phi}, 0.4 * std::numbers::pi)), value, 1e-13);
    }
}

TEST(MarschnerLobb, KnownValues) {
    const ProceduralField field = proceduralField("marschner-lobb", 5);
    // On the axis ρ_r = cos(12π) = 1; at r = 1 the inner cosine is 0, so ρ_r = 1 again.
    EXPECT_NEAR(field.value({0, 0, 0}), 1.5 / 2.5, 1e-14);
    EXPECT_NEAR(field.value({1, 0, 1}), 0.5 / 2.5, 1e-14);
    EXPECT_NEAR(field.value({0, 1, -1}), 2.5 / 2.5, 1e-14);
}

TEST(Hydrogen, LargestOnTheAxisAtSixBohrRadiiAndZeroOnTheCone) {
    const ProceduralField field = proceduralField("hydrogen", 5);
    EXPECT_NEAR(field.value({0, 0, 6}), 1.0, 1e-14);
    EXPECT_NEAR(field.value({0, 0, -6}), 1.0, 1e-14);
    EXPECT_NEAR(glm::length(field.gradient({0, 0, 6})), 0.0, 1e-14);
    EXPECT_NEAR(field.value({std::sqrt(2.0) * 3.0, 0, 3}), 0.0, 1e-28);  // r² = 3z²
}

TEST(Coulomb, OneLargeChargeAboveTwoSmall) {
    const ProceduralField field = proceduralField("coulomb", 5);
    EXPECT_GT(field.value({0.5, 0.7, 0.5}), field.value({0.3, 0.3, 0.5}));
    EXPECT_NEAR(field.value({0.3, 0.3, 0.5}), field.value({0.7, 0.3, 0.5}), 1e-13);
}

TEST(GeneratedNames, AreParsedOrRefused) {
    EXPECT_EQ(parseProceduralSource("bucky:32")->n, 32);
    EXPECT_EQ(parseProceduralSource("marschner-lobb:7")->name, "marschner-lobb");
    for (const char* source : {"bucky", "bucky:", "bucky:3x", "Bucky:3", "bucky:99999999999", "teapot:3", ""}) {
        EXPECT_FALSE(parseProceduralSource(source)) << source;
    }
    expectError([] { proceduralField("teapot", 4); }, "bucky, coulomb, marschner-lobb, hydrogen");
    expectError([] { proceduralField("bucky", 1); }, "2 to 1000");
    expectError([] { proceduralField("bucky", 1001); }, "2 to 1000");
    expectError([] { proceduralField("coulomb", 999); }, "951");
}

}  // namespace
}  // namespace tetralux::mesh
