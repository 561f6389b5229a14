// SPDX-License-Identifier: Apache-2.0
//
// Lobes and phase function against closed forms, and against each other where they must agree.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <projection/cells/cell_shading.h>

namespace tetralux::glsl {
namespace {

constexpr double pi = std::numbers::pi;

LightModel modelOf(int kind) {
    return {kind, vec3(1), vec3(1), 16, 16, 1, 1, 1, 1, 16, 10, 0.4};
}

LitPoint pointOf(const LightModel& model, const vec3& normal, const vec3& view, const vec3& diagonal,
                 const vec3& others) {
    LitPoint point{};
    point.normal = normal;
    point.view = view;
    point.side = dot(view, normal) > 0 ? 1 : -1;
    point.opacity = 0.3;
    setAnisotropy(model, diagonal, others, point);
    return point;
}

vec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return normalize(vec3(normal(random), normal(random), normal(random)));
}

TEST(LightModel, PhaseFunctionIntegratesToOne) {
    for (const double g : {-0.9, -0.3, 0.0, 0.3, 0.7, 0.95}) {
        const int n = 200000;
        double sum = 0, mean = 0;
        for (int i = 0; i < n; ++i) {
            const double cosine = (2.0 * i + 1) / n - 1;
            sum += phaseFunction(g, cosine) / n;
            mean += cosine * phaseFunction(g, cosine) / n;
        }
        EXPECT_NEAR(sum, 1, 1e-4) << g;   // 4π times ∫ p dω = 1
        EXPECT_NEAR(mean, g, 1e-4) << g;  // what the parameter means
    }
}

// ∫ √(u/κ)·exp(−u x² − κ y²) over all slopes x, y of the half-way vector is π/κ, however narrow the lobe is.
TEST(LightModel, WardLobeHasTheNormOfItsSlopes) {
    const LightModel model = modelOf(2);
    const vec3 tensor(0.3, 0.2, 0.0);  // major direction x; ratio 1.5
    LitPoint point = pointOf(model, vec3(0, 0, 1), vec3(0, 0, 1), tensor, vec3(0));
    EXPECT_NEAR(point.along, 16 * std::pow(1.5, 10), 0.05 * point.along);  // bounded ratio: a little less than λ₂/λ₁
    EXPECT_EQ(point.across, 16);
    const double reachX = 6 / std::sqrt(2 * point.along), reachY = 6 / std::sqrt(2 * point.across);
    const int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = reachX * ((2.0 * i + 1) / n - 1), y = reachY * ((2.0 * k + 1) / n - 1);
            sum += wardLobe(point, normalize(vec3(x, y, 1))) * (2 * reachX / n) * (2 * reachY / n);
        }
    EXPECT_NEAR(sum * 16 / pi, 1, 1e-4);
}

TEST(LightModel, WardIsNarrowAlongTheMajorDirection) {
    const LightModel model = modelOf(2);
    const vec3 axis = normalize(vec3(1, 2, 0));  // a fibre in the plane z = 0
    const vec3 diagonal(0.1 + axis.x * axis.x, 0.1 + axis.y * axis.y, 0.0), others(axis.x * axis.y, 0, 0);
    const LitPoint point = pointOf(model, vec3(0, 0, 1), vec3(0, 0, 1), diagonal, others);
    const vec3 across(-axis.y, axis.x, 0);
    const auto lobeAt = [&](const vec3& slope) { return wardLobe(point, normalize(vec3(0, 0, 1) + 0.1 * slope)); };
    EXPECT_NEAR(lobeAt(across), std::exp(3 - 16 * 0.01), 1e-6);  // the bound of u, κ·e⁶
    EXPECT_LT(lobeAt(axis), 1e-6);
}

// of a quarter of the exponent: as wide as Blinn and Phong's
TEST(LightModel, LafortuneWithoutAnisotropyIsPhong) {
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        LightModel phong = modelOf(0);
        const LightModel lafortune = modelOf(3);
        phong.frontExponent = lafortune.frontExponent / 4;
        phong.backExponent = lafortune.backExponent / 4;
        const LitPoint point = pointOf(lafortune, n, v, vec3(1), vec3(0));
        if (dot(l, n) * dot(v, n) < 0) continue;
        EXPECT_NEAR(modelTerm(lafortune, point, vec3(0.5), l).x, modelTerm(phong, point, vec3(0.5), l).x, 1e-9);
    }
}

TEST(LightModel, WithPlainMaterialIsThePlainTerm) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        const LitPoint point = pointOf(modelOf(0), n, v, vec3(1), vec3(0));
        const vec3 plain = lightTerm(vec3(0.2, 0.5, 0.8), n, v, l, point.side, 1 - point.opacity, 16);
        const vec3 full = modelTerm(modelOf(0), point, vec3(0.2, 0.5, 0.8), l);
        EXPECT_NEAR(glm::length(plain - full), 0, 1e-9);
    }
}

TEST(LightModel, BothLobesPeakWhereLightGoes) {
    for (const int kind : {0, 1, 2, 3}) {
        const vec3 n(0, 0, 1), v = normalize(vec3(0.3, -0.2, 0.8));
        const LitPoint point = pointOf(modelOf(kind), n, v, vec3(1, 1, 0), vec3(0));
        const vec3 mirror(-v.x, -v.y, v.z);
        EXPECT_NEAR(modelTerm(modelOf(kind), point, vec3(0), mirror).x, 1, 1e-6) << kind;
        // straight through: diffuse and specular light in the material's colour, 1 − α of it
        EXPECT_NEAR(modelTerm(modelOf(kind), point, vec3(0), -v).x, 0, 1e-6) << kind;
        EXPECT_NEAR(modelTerm(modelOf(kind), point, vec3(0.5), -v).x, 0.7 * 0.5 * (v.z + 1), 1e-6) << kind;
    }
}

TEST(LightModel, TransmissionTakesTheMeanExponentAndTheMaterialsColor) {
    std::mt19937 random(4);
    for (const int kind : {0, 1})
        for (int i = 0; i < 200; ++i) {
            LightModel model = modelOf(kind);
            model.frontSpecular = vec3(0.2, 0.9, 0.4);
            model.frontExponent = 10;
            model.backExponent = 4;
            model.diffuseThrough = 0.8;
            model.specularThrough = 0.6;
            const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
            if (dot(l, n) * dot(v, n) > 0) continue;
            const LitPoint point = pointOf(model, n, v, vec3(1), vec3(0));
            const vec3 color(0.3, 0.5, 0.8);
            const double share = 0.8 * std::abs(dot(l, n)) + 0.6 * std::pow(std::max(0.0, -dot(l, v)), 7);
            EXPECT_NEAR(glm::length(modelTerm(model, point, color, l) - 0.7 * share * color), 0, 1e-9);
        }
}

TEST(LightModel, IsFiniteForAnyInput) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> exponent(-12, 3);
    for (int i = 0; i < 20000; ++i) {
        const int kind = i % 5;
        LightModel model = modelOf(kind);
        model.gamma = i % 7 == 0 ? 60 : 10;
        vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        if (i % 3 == 0) n = vec3(0, 0, i % 2 == 0 ? 1 : -1);
        if (i % 4 == 0) l = i % 8 == 0 ? v : -v;
        const vec3 a = std::pow(10, exponent(random)) * randomDirection(random);
        const vec3 diagonal(a.x * a.x, a.y * a.y, a.z * a.z), others(a.x * a.y, a.x * a.z, a.y * a.z);
        LitPoint point = pointOf(model, n, v, i % 11 == 0 ? vec3(0) : diagonal, i % 11 == 0 ? vec3(0) : others);
        if (i % 5 == 0) point.side = 0;
        const vec3 term = modelTerm(model, point, vec3(1), l);
        ASSERT_TRUE(std::isfinite(term.x) && term.x >= 0 && term.x < 100) << i;
    }
}

}  // namespace
}  // namespace tetralux::glsl
