// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include <projection/frame/verification.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

class VerifyImage : public ::testing::Test {
protected:
    Scene scene = sceneOf(boxMesh(4, [](const glm::dvec3& p) { return p.x; }), smoothFunction(0, 1));
    Camera camera = cameraAt({1.9, 1.4, 2.3});
    RayCastCounts counts;
    Image exact = ReferenceRayCaster(scene).render(camera, counts);
};

TEST_F(VerifyImage, FindsNothingWrongWithTheReference) {
    const Verification v = verifyImage(exact, scene, camera, 200, 1);
    EXPECT_EQ(v.pixels, 200u);
    EXPECT_EQ(v.max, 0.0);
    EXPECT_EQ(v.rmse, 0.0);
    // 3/200 of them by the rule of three, less since what was drawn is not put back
    EXPECT_EQ(v.unseen(), exact.pixels.size() - 200);
    EXPECT_LE(v.unseenShare(), 3.0 / 200);
    EXPECT_GE(v.unseenShare(), 0.9 * 3.0 / 200);
    EXPECT_NEAR(v.rmseBound, std::sqrt(v.unseenShare()), 1e-12) << "as wrong as a channel can be";
}

// By hand: a sample of 20 of 400 misses 53 bad pixels with more than 5 %, 54 with less.
TEST(Verification, TellsHowManyMayBeWorse) {
    const auto missed = [](int bad) {
        double chance = 1.0;
        for (int i = 0; i < 20; ++i) chance *= (400.0 - bad - i) / (400.0 - i);
        return chance;
    };
    Scene scene = sceneOf(boxMesh(2, [](const glm::dvec3& p) { return p.x; }), smoothFunction(0, 1));
    const Camera camera = cameraAt({1.9, 1.4, 2.3}, glm::dvec3(0.5), 20, 20);
    RayCastCounts counts;
    const Image exact = ReferenceRayCaster(scene).render(camera, counts);
    const Verification v = verifyImage(exact, scene, camera, 20, 1);
    const int worse = static_cast<int>(v.unseenWorse);
    EXPECT_GE(missed(worse), 0.05);
    EXPECT_LT(missed(worse + 1), 0.05);
    EXPECT_EQ(verifyImage(exact, scene, camera, 400, 1).unseenWorse, 0u);
    EXPECT_EQ(verifyImage(exact, scene, camera, 399, 1).unseenWorse, 0u) << "1 in 400 that the one not seen is bad";
}

TEST(Verification, TellsHowManyHaveToBeSeen) {
    EXPECT_EQ(pixelsToVouchFor(1.0, 1000), 1u);
    const std::size_t some = pixelsToVouchFor(0.1, 10000);  // 1 % of all may be as wrong as they like
    EXPECT_GT(some, 250u);
    EXPECT_LT(some, 310u);
    EXPECT_EQ(pixelsToVouchFor(1e-4, 10000), 9501u) << "not one may be: more than 95 % have to be seen";
    EXPECT_EQ(pixelsToVouchFor(0.0, 1), 1u);
    EXPECT_GT(pixelsToVouchFor(0.1, 10000, 5.0), pixelsToVouchFor(0.1, 10000)) << "brighter pictures may be more wrong";
}

// One pixel in a hundred is wrong by all that a channel can be, and few samples meet one: the bound has to hold all the
// same.
TEST_F(VerifyImage, BoundsWhatItHasNotSeen) {
    Image wrong = exact;
    for (std::size_t i = 0; i < wrong.pixels.size(); i += 100)
        wrong.pixels[i].x = wrong.pixels[i].x < 0.5f ? 1.0f : 0.0f;
    const double rmse = compareImages(wrong, exact).rmse;
    int held = 0, blind = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Verification v = verifyImage(wrong, scene, camera, 20, seed);
        held += v.rmseBound >= rmse ? 1 : 0;
        blind += v.max == 0.0 ? 1 : 0;
    }
    EXPECT_GE(held, 95);
    EXPECT_GT(blind, 50) << "otherwise this tests nothing";
}

TEST_F(VerifyImage, IsExactWhenAllPixelsAreSampled) {
    Image wrong = exact;
    wrong.at(7, 9).x += 0.25f;
    const Verification v = verifyImage(wrong, scene, camera, 1u << 30, 1);
    const ImageDifference difference = compareImages(wrong, exact);
    EXPECT_EQ(v.pixels, exact.pixels.size());
    EXPECT_NEAR(v.rmse, difference.rmse, 1e-9);
    EXPECT_NEAR(v.rmseBound, difference.rmse, 1e-9);
    EXPECT_NEAR(v.max, 0.25, 1e-6);
    EXPECT_EQ(v.unseenShare(), 0.0);
}

TEST_F(VerifyImage, BoundsTheErrorOfNoise) {
    Image noisy = exact;
    for (std::size_t i = 0; i < noisy.pixels.size(); ++i)
        noisy.pixels[i] += glm::vec4(1e-3f * static_cast<float>(std::sin(12.9898 * static_cast<double>(i))));
    const double rmse = compareImages(noisy, exact).rmse;
    int held = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const Verification v = verifyImage(noisy, scene, camera, 150, seed);
        EXPECT_NEAR(v.rmse, rmse, 0.25 * rmse);
        held += v.rmseBound >= rmse ? 1 : 0;
    }
    EXPECT_GE(held, 34) << "a 95 % bound holds 38 times of 40 on average";
}

TEST_F(VerifyImage, BoundsErrorsOfLongTails) {
    // log-normal, as errors of pictures are: most of the rmse comes from few pixels
    Image wrong = exact;
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1.2);
    for (glm::vec4& pixel : wrong.pixels) pixel.x += static_cast<float>(1e-4 * std::exp(normal(random)));
    const double rmse = compareImages(wrong, exact).rmse;
    int held = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed)
        held += verifyImage(wrong, scene, camera, 300, seed).rmseBound >= rmse ? 1 : 0;
    EXPECT_GE(held, 95);
    const Verification most = verifyImage(wrong, scene, camera, exact.pixels.size() * 96 / 100, 1);
    EXPECT_GE(most.rmseBound, rmse);
    EXPECT_LE(most.rmseBound, 6 * rmse) << "a bound that is no use";
}

TEST_F(VerifyImage, ANaNIsNoMatch) {
    Image broken = exact;
    for (auto& pixel : broken.pixels) pixel.y = NAN;
    EXPECT_TRUE(std::isinf(verifyImage(broken, scene, camera, 10, 1).max));
}

TEST_F(VerifyImage, RefusesAnotherSize) {
    EXPECT_THROW(verifyImage(Image(3, 3), scene, camera, 10, 1), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::projection
