// SPDX-License-Identifier: Apache-2.0
#include <projection/image/image_structure.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tetralux::projection {
namespace {

Image gray(int width, int height, const std::function<double(int, int)>& value) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = glm::vec4(glm::vec3(static_cast<float>(value(x, y))), 1.0f);
    return image;
}

double texture(int x, int y) {
    return 0.5 + 0.2 * std::sin(0.9 * x) * std::cos(0.7 * y);
}

TEST(ImageStructure, UniformPicturesHaveNone) {
    EXPECT_EQ(structureScore(gray(16, 16, [](int, int) { return 0.0; })), 0.0);
    EXPECT_NEAR(structureScore(gray(16, 16, [](int, int) { return 0.7; })), 0.0, 1e-12);
    EXPECT_EQ(structureScore(gray(7, 16, [](int, int y) { return y % 2; })), 0.0);
}

// a checkerboard of 0 and 1: every window of 8×8 has variance 1/4, all coarser scales are uniform
TEST(ImageStructure, CheckerboardByHand) {
    const double least = 1 - 0.01 / (0.25 + 0.01);
    EXPECT_NEAR(structureScore(gray(64, 64, [](int x, int y) { return (x + y) % 2; })), least / 4, 1e-7);
    EXPECT_NEAR(structureScore(gray(16, 16, [](int x, int y) { return (x + y) % 2; })), least / 2, 1e-7);  // two scales
}

// The same over itself: nothing is new; against its negative d = 1 + (2σ² − C)/(2σ² + C), weighted by h.
TEST(ImageStructure, IsWhatTheUnlitPictureDoesNotShow) {
    const auto board = [](int x, int y) { return 0.4 + 0.2 * ((x + y) % 2); };
    const Image unlit = gray(16, 16, board);
    EXPECT_NEAR(structureScore(unlit, unlit), 0, 1e-9);
    EXPECT_NEAR(structureScore(unlit, gray(16, 16, [&](int x, int y) { return board(x, y) + 0.2; })), 0, 1e-6);
    const double variance = 0.01, h = 0.01 / (variance + 0.01), d = 1 + (2 * variance - 0.01) / (2 * variance + 0.01);
    EXPECT_NEAR(structureScore(unlit, gray(16, 16, [&](int x, int y) { return 1 - board(x, y); })), h * d / 2, 1e-6);
}

TEST(ImageStructure, CountsMoreWhereTheUnlitPictureIsHomogeneous) {
    const auto added = [](int x, int y) { return 0.1 * ((x / 2 + y / 2) % 2); };
    const Image flat = gray(64, 64, [](int, int) { return 0.4; }), busy = gray(64, 64, texture);
    const Image litFlat = gray(64, 64, [&](int x, int y) { return 0.4 + added(x, y); });
    const Image litBusy = gray(64, 64, [&](int x, int y) { return texture(x, y) + added(x, y); });
    EXPECT_GT(structureScore(flat, litFlat), 1.5 * structureScore(busy, litBusy));
    EXPECT_GT(structureScore(busy, litBusy), 0.01);
}

TEST(ImageStructure, RefusesPicturesOfOtherSizes) {
    EXPECT_THROW(structureScore(gray(16, 16, texture), gray(16, 17, texture)), std::runtime_error);
}

TEST(ImageStructure, MoreStructureRanksHigher) {
    const auto stripes = [](double perPicture, double contrast) {
        return structureScore(gray(96, 96, [=](int x, int y) {
            return 0.5 + 0.5 * contrast * std::sin(2 * std::numbers::pi * perPicture * (x + 0.5 * y) / 96);
        }));
    };
    EXPECT_GT(stripes(8, 0.3), 1.1 * stripes(2, 0.3)) << "more of them";
    EXPECT_GT(stripes(8, 0.3), 1.5 * stripes(8, 0.15)) << "clearer";
    // what a blur leaves has less structure
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> noise(100 * 100);
    for (double& value : noise) value = uniform(random);
    const auto box = [&](int radius) {
        return structureScore(gray(80, 80, [&](int x, int y) {
            double sum = 0;
            for (int dy = -radius; dy <= radius; ++dy)
                for (int dx = -radius; dx <= radius; ++dx)
                    sum += noise[static_cast<std::size_t>((y + 10 + dy) * 100 + x + 10 + dx)];
            return sum / ((2 * radius + 1) * (2 * radius + 1));
        }));
    };
    EXPECT_GT(box(0), 1.5 * box(1));
    EXPECT_GT(box(1), 1.5 * box(3));
}

}  // namespace
}  // namespace tetralux::projection
