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
    EXPECT_NEAR(v.unseenShare, 3.0 / 200, 1e-15);
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
    EXPECT_EQ(v.unseenShare, 0.0);
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
    double sum = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Verification v = verifyImage(wrong, scene, camera, 300, seed);
        held += v.rmseBound >= rmse ? 1 : 0;
        sum += v.rmseBound;
    }
    EXPECT_GE(held, 95);
    EXPECT_LE(sum / 100, 3 * rmse) << "a bound that is no use";
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
