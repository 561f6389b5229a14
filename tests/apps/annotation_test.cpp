// SPDX-License-Identifier: Apache-2.0
#include <apps/annotation.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <apps/axes_box.h>
#include <apps/nice_ticks.h>
#include <apps/overlay.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::apps {
namespace {

std::string joined(const std::vector<Tick>& ticks) {
    std::string text;
    for (const Tick& tick : ticks) text += (text.empty() ? "" : " ") + tick.label;
    return text;
}

TEST(NiceTicks, AreRoundNumbers) {
    EXPECT_EQ(joined(niceTicks(0, 1, 6)), "0 0.2 0.4 0.6 0.8 1");
    EXPECT_EQ(joined(niceTicks(0, 1, 5)), "0 0.5 1");
    EXPECT_EQ(joined(niceTicks(0.137, 0.861, 6)), "0.2 0.4 0.6 0.8");
    EXPECT_EQ(joined(niceTicks(-3, 7, 6)), "-2 0 2 4 6");
    EXPECT_EQ(joined(niceTicks(1000.2, 1000.9, 4)), "1000.2 1000.4 1000.6 1000.8");
    EXPECT_EQ(joined(niceTicks(0, 2.5e7, 6)), "0 5e+06 1e+07 1.5e+07 2e+07 2.5e+07");
    EXPECT_EQ(joined(niceTicks(0, 3e-9, 4)), "0 1e-09 2e-09 3e-09");
    EXPECT_EQ(joined(niceTicks(273.15, 373.15, 5)), "280 300 320 340 360");
    EXPECT_EQ(joined(niceTicks(5, 5, 5)), "5");
    EXPECT_TRUE(niceTicks(1, 0, 5).empty());
    EXPECT_TRUE(niceTicks(0, INFINITY, 5).empty());
}

TEST(NiceTicks, KeepWhatTheyPromise) {
    for (const double low : {-1e6, -7.3, 0.0, 1e-7, 3.3, 12345.678})
        for (const double width : {1e-9, 0.003, 1.0, 17.0, 9.99e12})
            for (const int most : {2, 3, 5, 10}) {
                const double high = low + width;
                const std::vector<Tick> ticks = niceTicks(low, high, most);
                if (width < 1e-12 * std::abs(low)) continue;
                ASSERT_LE(ticks.size(), static_cast<std::size_t>(most)) << low << " " << high;
                for (std::size_t i = 0; i < ticks.size(); ++i) {
                    EXPECT_GE(ticks[i].value, low - 1e-8 * width - 1e-15 * std::abs(low));
                    EXPECT_LE(ticks[i].value, high + 1e-8 * width + 1e-15 * std::abs(high));
                    if (i > 0) {
                        EXPECT_NE(ticks[i].label, ticks[i - 1].label) << "labels tell neighbours apart";
                    }
                }
            }
}

const mesh::BoundingBox unitBox{glm::dvec3(0), glm::dvec3(1)};

int behindCount(const AxesBox& box) {
    return static_cast<int>(
        std::count_if(box.lines.begin(), box.lines.end(), [](const BoxLine& line) { return line.behind; }));
}

TEST(AxesBox, ThreeEdgesAreHiddenFromACorner) {
    const AxesBox box = axesBox(unitBox, test::cameraAt({3, 2.5, 4}, glm::dvec3(0.5), 200, 200));
    EXPECT_EQ(box.lines.size(), 12u);
    EXPECT_EQ(behindCount(box), 3) << "those that meet in the farthest corner";
    int names = 0;
    for (const BoxLabel& label : box.labels) {
        names += label.axisName ? 1 : 0;
        EXPECT_GT(label.at.x, 0);
        EXPECT_LT(label.at.x, 200);
        EXPECT_NEAR(glm::length(label.outward), 1.0, 1e-12);
    }
    EXPECT_EQ(names, 3);
}

TEST(AxesBox, SeenFromWithinItIsBehindEverything) {
    const AxesBox box = axesBox(unitBox, test::cameraAt({0.5, 0.5, 0.9}, {0.5, 0.5, 0}, 100, 100));
    EXPECT_FALSE(box.lines.empty());
    EXPECT_EQ(behindCount(box), static_cast<int>(box.lines.size()));
    EXPECT_TRUE(box.labels.empty());
    for (const BoxLine& line : box.lines) EXPECT_TRUE(std::isfinite(line.from.x + line.from.y + line.to.x + line.to.y));
}

TEST(AxesBox, LinesStandWhereTheCameraSeesThem) {
    projection::Camera camera = test::cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 100, 100);
    camera.orthographicHeight = 2.0;  // 50 pixels per unit: the box from 25 to 75
    for (const BoxLine& line : axesBox(unitBox, camera).lines)
        for (const glm::dvec2& end : {line.from, line.to})
            for (int i = 0; i < 2; ++i)
                EXPECT_TRUE(std::abs(end[i] - 25) < 1e-9 || std::abs(end[i] - 75) < 1e-9) << end[i];
}

AnnotatedScene sampleScene() {
    AnnotatedScene scene;
    scene.fieldName = "density";
    scene.transferFunction.color = {{0.0, {1, 0, 0}}, {1.0, {0, 0, 1}}};
    scene.bounds = unitBox;
    return scene;
}

TEST(Annotation, NothingAskedForIsNothingDrawn) {
    projection::Image image(40, 30), before = image;
    drawBehind({}, sampleScene(), test::cameraAt({3, 2, 4}, glm::dvec3(0.5), 40, 30), image);
    drawInFront({}, sampleScene(), test::cameraAt({3, 2, 4}, glm::dvec3(0.5), 40, 30), image);
    EXPECT_EQ(projection::compareImages(image, before).max, 0.0);
}

TEST(Annotation, ColorBarShowsTheColors) {
    AnnotationOptions options;
    options.colorBar = true;
    projection::Image image(300, 200);
    const projection::Camera camera = test::cameraAt({3, 2, 4}, glm::dvec3(0.5), 300, 200);
    drawInFront(options, sampleScene(), camera, image);
    // the bar reaches from a fifth of the height to four fifths: blue (the high end) above, red below
    const auto covers = [&](double height, const glm::vec3& color) {
        for (int x = 200; x < 300; ++x)
            if (glm::length(glm::vec3(image.at(x, static_cast<int>(height * 200))) - color) < 0.06f) return true;
        return false;
    };
    EXPECT_TRUE(covers(0.22, {0.03, 0, 0.97}));
    EXPECT_TRUE(covers(0.50, {0.5, 0, 0.5}));
    EXPECT_TRUE(covers(0.78, {0.97, 0, 0.03}));
    for (int y = 0; y < 200; ++y) EXPECT_EQ(image.at(50, y).w, 0.0f) << "the rest stays clear";
}

TEST(Annotation, WhatTheVolumeHidesStaysHidden) {
    AnnotationOptions options;
    options.axes = true;
    const projection::Camera camera = test::cameraAt({3, 2.5, 4}, glm::dvec3(0.5), 100, 100);
    projection::Image clear(100, 100), opaque(100, 100);
    for (glm::vec4& pixel : opaque.pixels) pixel = {0.2f, 0.3f, 0.4f, 1.0f};
    const projection::Image before = opaque;
    drawBehind(options, sampleScene(), camera, clear);
    drawBehind(options, sampleScene(), camera, opaque);
    EXPECT_EQ(projection::compareImages(opaque, before).max, 0.0);
    double most = 0;
    for (const glm::vec4& pixel : clear.pixels) most = std::max<double>(most, pixel.w);
    EXPECT_GT(most, 0.5);
    drawInFront(options, sampleScene(), camera, opaque);
    EXPECT_GT(projection::compareImages(opaque, before).max, 0.3) << "the near edges are drawn over it";
}

TEST(Annotation, TitlesAreUtf8) {
    AnnotationOptions options;
    options.title = "Dichte ρ in kg/m³";
    projection::Image image(200, 60);
    const projection::Camera camera = test::cameraAt({3, 2, 4}, glm::dvec3(0.5), 200, 60);
    drawInFront(options, sampleScene(), camera, image);
    double most = 0;
    for (const glm::vec4& pixel : image.pixels) most = std::max<double>(most, pixel.x);
    EXPECT_GT(most, 0.9) << "white ink before black";
    options.title = "\xff\xfe";
    EXPECT_THROW(drawInFront(options, sampleScene(), camera, image), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::apps
