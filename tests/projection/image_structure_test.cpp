// SPDX-License-Identifier: Apache-2.0
#include <projection/image_structure.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace tetralux::projection {
namespace {

Image gray(int width, int height, const std::function<double(int, int)>& value) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = glm::vec4(glm::vec3(static_cast<float>(value(x, y))), 1.0f);
    return image;
}

TEST(ImageStructure, UniformPicturesHaveNone) {
    EXPECT_EQ(structureScore(gray(16, 16, [](int, int) { return 0.0; })), 0.0);
    EXPECT_NEAR(structureScore(gray(16, 16, [](int, int) { return 0.7; })), 0.0, 1e-12);
    EXPECT_EQ(structureScore(gray(1, 16, [](int, int y) { return y % 2; })), 0.0);
}

TEST(ImageStructure, CheckerboardByHand) {
    // a b / c d = 0 1 / 1 0 or its inverse: D = 1/2 everywhere at the first scale; their mean is 1/2 everywhere, so
    // that the other two scales see nothing.
    EXPECT_NEAR(structureScore(gray(20, 20, [](int x, int y) { return (x + y) % 2; })), 0.5 / 3, 1e-7);
}

TEST(ImageStructure, RampByHand) {
    // slope k per pixel: at step s H = k·s/2, nothing else, so the score is k·(1 + 2 + 4)/6
    EXPECT_NEAR(structureScore(gray(40, 20, [](int x, int) { return 0.01 * x; })), 0.01 * 7 / 6, 1e-7);
}

TEST(ImageStructure, IsLinearInContrastAndBlindToWhereEdgesFall) {
    const auto edgeAt = [](int position, double height) {
        return structureScore(gray(64, 64, [&](int x, int) { return x < position ? 0.0 : height; }));
    };
    EXPECT_NEAR(edgeAt(30, 0.5), 0.5 * edgeAt(30, 1.0), 1e-9);
    EXPECT_NEAR(edgeAt(31, 1.0), edgeAt(30, 1.0), 1e-9);
    // one column of windows at scale 1 has H = 1/2; by hand 0.5/63 at the first scale, 1/61 and 2/57 at the others
    EXPECT_NEAR(edgeAt(30, 1.0), (0.5 / 63 + 1.0 / 61 + 2.0 / 57) / 3, 1e-9);
}

TEST(ImageStructure, MoreStructureRanksHigher) {
    const auto stripes = [](double perPicture, double contrast) {
        return structureScore(gray(96, 96, [=](int x, int y) {
            return 0.5 + 0.5 * contrast * std::sin(2 * std::numbers::pi * perPicture * (x + 0.5 * y) / 96);
        }));
    };
    EXPECT_GT(stripes(8, 1.0), 1.5 * stripes(2, 1.0)) << "more of them";
    EXPECT_GT(stripes(8, 1.0), 1.5 * stripes(8, 0.5)) << "clearer";
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
    EXPECT_GT(box(0), 2 * box(1));
    EXPECT_GT(box(1), 1.5 * box(3));
}

}  // namespace
}  // namespace tetralux::projection
