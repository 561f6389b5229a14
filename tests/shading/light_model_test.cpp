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

LightModel modelOf(int kind, int phase = 0) {
    return {kind, phase, vec3(1), vec3(1), 16, 16, 1, 1, 1, 1, 0.2, 10, 0.4};
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

/// Half-way vector of slopes x, y about n = (0, 0, 1), and the light that it is half-way to where the eye is at `view`.
vec3 lightHalfway(const vec3& halfway, const vec3& view) {
    return 2.0 * dot(halfway, view) * halfway - view;
}

TEST(LightModel, WardIsEquations9To11) {
    LightModel model = modelOf(2);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0.1, 1);
    for (int i = 0; i < 2000; ++i) {
        model.kappa = any(random);
        model.gamma = 3 * any(random);
        const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        if (dot(l, n) * dot(v, n) < 0.01) continue;
        const vec3 fibre = normalize(glm::cross(n, randomDirection(random))), across = glm::cross(n, fibre);
        const double ratio = 1 + any(random);
        const auto tensor = [&](int a, int b) { return ratio * fibre[a] * fibre[b] + across[a] * across[b]; };
        const LitPoint point = pointOf(model, n, v, vec3(tensor(0, 0), tensor(1, 1), tensor(2, 2)),
                                       vec3(tensor(0, 1), tensor(0, 2), tensor(1, 2)));
        const double u = std::min(model.kappa * std::pow(ratio, model.gamma), 10.0);
        const vec3 h = normalize(l + v);
        const double slopes =
            (std::pow(dot(h, fibre), 2) / u + std::pow(dot(h, across), 2) / model.kappa) / std::pow(dot(h, n), 2);
        const double wanted = std::exp(-slopes) / (4 * pi * std::sqrt(u * model.kappa * dot(l, n) * dot(v, n)));
        EXPECT_NEAR(wardLobe(point, l), wanted, 1e-6 * (1 + wanted));
        const double facing = std::abs(dot(l, n));
        EXPECT_NEAR(modelTerm(model, point, vec3(0.5), l).x, 0.5 * facing + wanted * facing, 1e-6 * (1 + wanted));
    }
}

TEST(LightModel, LafortuneIsEquation12) {
    LightModel model = modelOf(3);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0.1, 1);
    for (int i = 0; i < 2000; ++i) {
        model.gamma = 5 * any(random);
        const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        const vec3 fibre = normalize(glm::cross(n, randomDirection(random))), across = glm::cross(n, fibre);
        const double ratio = 1 + any(random), u = 2 * (1 - std::exp(model.gamma * (1 - ratio))) - 1;
        const auto tensor = [&](int a, int b) { return ratio * fibre[a] * fibre[b] + across[a] * across[b]; };
        const LitPoint point = pointOf(model, n, v, vec3(tensor(0, 0), tensor(1, 1), tensor(2, 2)),
                                       vec3(tensor(0, 1), tensor(0, 2), tensor(1, 2)));
        const double base = u * dot(l, fibre) * dot(v, fibre) - dot(l, across) * dot(v, across) + dot(l, n) * dot(v, n);
        EXPECT_NEAR(lafortuneLobe(point, l, 7), std::pow(std::max(base, 0.0), 7), 1e-6);
    }
}

TEST(LightModel, WardGrowsAlongTheMajorDirection) {
    const vec3 axis = normalize(vec3(1, 2, 0));  // a fibre in the plane z = 0
    const vec3 diagonal(0.1 + axis.x * axis.x, 0.1 + axis.y * axis.y, 0.0), others(axis.x * axis.y, 0, 0);
    const vec3 across(-axis.y, axis.x, 0), view(0, 0, 1);
    double previous = 0;
    for (const double gamma : {0.0, 0.1, 1.0, 10.0}) {
        LightModel model = modelOf(2);
        model.gamma = gamma;
        const LitPoint point = pointOf(model, vec3(0, 0, 1), view, diagonal, others);
        const auto lobeAt = [&](const vec3& slope) {
            return wardLobe(point, lightHalfway(normalize(vec3(0, 0, 1) + 0.3 * slope), view));
        };
        const double elongation = lobeAt(axis) / lobeAt(across);
        if (gamma == 0)
            EXPECT_NEAR(elongation, 1, 1e-9);
        else
            EXPECT_GT(elongation, 1.02 * previous) << gamma;
        previous = elongation;
    }
    EXPECT_NEAR(previous, std::exp(0.09 / 0.2 - 0.09 / 10), 1e-6);  // u at its bound
}

TEST(LightModel, LafortuneWithoutAnisotropyIsPhongTimesTheCosine) {
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        const LitPoint point = pointOf(modelOf(3), n, v, vec3(1), vec3(0));
        const bool reflects = dot(l, n) * dot(v, n) > 0;
        const double facing = std::abs(dot(l, n));
        const double phong = reflects ? modelTerm(modelOf(0), point, vec3(0), l).x : 0;
        EXPECT_NEAR(modelTerm(modelOf(3), point, vec3(0.5), l).x,
                    0.5 * facing * (reflects ? 1 : 1 - point.opacity) + phong * facing, 1e-9);
    }
}

// f = k_d·f_d + k_s·f_s·(l·n)₊, whichever the lobe; without one, and without a normal, the phase function alone
TEST(LightModel, APhaseFunctionIsAddedToAnyLobe) {
    std::mt19937 random(6);
    for (int i = 0; i < 500; ++i) {
        const vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        const double phase = phaseFunction(0.4, -dot(l, v)), facing = std::abs(dot(l, n));
        for (const int kind : {0, 1, 2, 3, 4}) {
            LightModel model = modelOf(kind, 1);
            model.diffuse = 0.7;
            model.specular = 0.6;
            LitPoint point = pointOf(model, n, v, vec3(1), vec3(0));
            const bool shines = kind != 4 && dot(l, n) * dot(v, n) > 0;
            const double lobe = shines ? 0.6 * facing * highlight(model, point, l, 16) : 0;
            EXPECT_NEAR(modelTerm(model, point, vec3(0.5), l).x, 0.7 * 0.5 * phase + lobe, 1e-9) << kind;
            point.normal = vec3(0);
            EXPECT_NEAR(modelTerm(model, point, vec3(0.5), l).x, 0.7 * 0.5 * phase, 1e-9) << kind;
        }
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
    for (const int kind : {0, 1, 3}) {
        const vec3 n(0, 0, 1), v = normalize(vec3(0.3, -0.2, 0.8));
        const LitPoint point = pointOf(modelOf(kind), n, v, vec3(1, 1, 0), vec3(0));
        const vec3 mirror(-v.x, -v.y, v.z);
        EXPECT_NEAR(modelTerm(modelOf(kind), point, vec3(0), mirror).x, kind == 3 ? v.z : 1, 1e-6) << kind;
        // straight through: diffuse light, with Equation 19's lobes specular too, in the material's colour, 1 − α of it
        EXPECT_NEAR(modelTerm(modelOf(kind), point, vec3(0), -v).x, 0, 1e-6) << kind;
        EXPECT_NEAR(modelTerm(modelOf(kind), point, vec3(0.5), -v).x, 0.7 * 0.5 * (v.z + (kind == 3 ? 0 : 1)), 1e-6)
            << kind;
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
        LightModel model = modelOf(kind, i % 2);
        model.kappa = i % 13 == 0 ? 1e-6 : 0.2;
        model.gamma = i % 7 == 0 ? 60 : 10;
        vec3 n = randomDirection(random), v = randomDirection(random), l = randomDirection(random);
        if (i % 3 == 0) n = vec3(0, 0, i % 2 == 0 ? 1 : -1);
        if (i % 4 == 0) l = i % 8 == 0 ? v : -v;
        const vec3 a = std::pow(10, exponent(random)) * randomDirection(random);
        const vec3 diagonal(a.x * a.x, a.y * a.y, a.z * a.z), others(a.x * a.y, a.x * a.z, a.y * a.z);
        LitPoint point = pointOf(model, n, v, i % 11 == 0 ? vec3(0) : diagonal, i % 11 == 0 ? vec3(0) : others);
        if (i % 5 == 0) point.side = 0;
        const vec3 term = modelTerm(model, point, vec3(1), l);
        ASSERT_TRUE(std::isfinite(term.x) && term.x >= 0 && term.x < 1e8) << i;
    }
}

}  // namespace
}  // namespace tetralux::glsl
