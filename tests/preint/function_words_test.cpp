// SPDX-License-Identifier: Apache-2.0
#include <preint/function_words.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <preint/color_maps/color_maps.h>
#include <preint/opacity_words.h>
#include <preint/similar_names.h>

namespace tetralux::preint {
namespace {

glm::dvec3 colorOf(const ColorMap& map, double fraction) {
    TransferFunction function;
    function.color = map.nodes;
    return function.colorAt(fraction);
}

void expectNear(const glm::dvec3& color, const glm::dvec3& expected, double tolerance, const std::string& what) {
    EXPECT_NEAR(color.x, expected.x, tolerance) << what;
    EXPECT_NEAR(color.y, expected.y, tolerance) << what;
    EXPECT_NEAR(color.z, expected.z, tolerance) << what;
}

std::string messageOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(ColorMaps, AreThoseOfMatplotlib) {
    struct Known {
        const char* name;
        int entry;  // of 256
        glm::dvec3 color;
    };
    // matplotlib 3.11's own tables
    for (const Known& one :
         {Known{"jet", 37, {0.0, 0.080392, 1.0}}, Known{"jet", 201, {1.0, 0.45098, 0.0}},
          Known{"Blues", 128, {0.417086, 0.680631, 0.838231}}, Known{"coolwarm", 37, {0.409611, 0.540759, 0.935545}},
          Known{"gist_ncar", 128, {0.857375, 1.0, 0.124824}}, Known{"hsv", 201, {0.655513, 0.0, 1.0}},
          Known{"viridis", 128, {0.127568, 0.566949, 0.550556}}})
        expectNear(colorOf(colorMap(one.name), one.entry / 255.0), one.color, 1.0 / 510.0 + 1e-4, one.name);
}

TEST(ColorMaps, AreFoundHoweverTheyAreSpelled) {
    for (const char* name : {"Cool to Warm", "cool-to-warm", "COOL_TO_WARM", "coolToWarm"})
        EXPECT_EQ(colorMap(name).name, "Cool to Warm") << name;
    EXPECT_EQ(colorMap("Viridis").name, "viridis");
    EXPECT_EQ(colorMap("Viridis (matplotlib)").name, "viridis");
    EXPECT_EQ(colorMap("black-body").name, "Black-Body Radiation");
    EXPECT_EQ(colorMap("grey").nodes.size(), 2u);
    EXPECT_FALSE(isColorMap("plum"));
    for (const std::string& name : colorMapNames()) {
        ASSERT_TRUE(isColorMap(name)) << name;
        const ColorMap map = colorMap(name);
        ASSERT_EQ(map.nodes.empty(), !map.categories.empty()) << name;
        if (map.nodes.empty()) continue;
        EXPECT_EQ(map.nodes.front().scalar, 0.0) << name;
        EXPECT_EQ(map.nodes.back().scalar, 1.0) << name;
        for (std::size_t i = 1; i < map.nodes.size(); ++i)
            EXPECT_GE(map.nodes[i].scalar, map.nodes[i - 1].scalar) << name;
    }
    EXPECT_GE(colorMapNames().size(), 190u);
}

TEST(ColorMaps, Reverse) {
    const ColorMap forward = colorMap("inferno"), backward = colorMap("Inferno_r");
    EXPECT_EQ(backward.name, "inferno_r");
    for (int i = 0; i <= 50; ++i)
        expectNear(colorOf(backward, 0.02 * i), colorOf(forward, 1.0 - 0.02 * i), 1e-12, std::to_string(i));
    EXPECT_EQ(colorMap("Set1_r").categories.front(), colorMap("Set1").categories.back());
}

TEST(ColorMaps, UnknownNamesAreToldTheNearest) {
    EXPECT_NE(messageOf([] { colorMap("virids"); }).find("did you mean \"viridis\"?"), std::string::npos);
    EXPECT_NE(messageOf([] { colorMap("cool to wram"); }).find("\"cool-to-warm\""), std::string::npos);
    const std::string far = messageOf([] { colorMap("qqqqqqqqqqqq"); });
    EXPECT_EQ(far.find("did you mean"), std::string::npos) << far;
    EXPECT_NE(far.find("viridis"), std::string::npos) << far;
    EXPECT_EQ(similarNames("temprature", {"Pressure", "Temperature", "Velocity"}),
              (std::vector<std::string>{"Temperature"}));
}

/// PyVista's tables have 256 steps and are cut to whole 255ths.
TEST(OpacityWords, AreThoseOfPyVista) {
    struct Known {
        const char* word;
        int alpha[7];  // of 255, at entries 0, 1, 64, 128, 200, 240, 255 of PyVista 0.49's table
    };
    const int entries[] = {0, 1, 64, 128, 200, 240, 255};
    for (const Known& one :
         {Known{"linear", {0, 1, 64, 128, 200, 240, 255}}, Known{"geom", {0, 0, 0, 0, 3, 81, 255}},
          Known{"geom_r", {255, 236, 1, 0, 0, 0, 0}}, Known{"sigmoid", {0, 0, 1, 129, 254, 254, 254}},
          Known{"sigmoid_3", {12, 12, 46, 128, 215, 238, 242}}, Known{"Sigmoid_5", {1, 1, 19, 128, 240, 251, 253}},
          Known{"sigmoid_20", {0, 0, 0, 132, 254, 254, 254}}, Known{"sigmoid_4_r", {250, 250, 224, 126, 23, 7, 4}},
          Known{"foreground", {0, 255, 255, 255, 255, 255, 255}}}) {
        // τ over the unit distance of a transfer function that is fitted to the range 0 to 255, diagonal 50
        TransferFunction function = preset("gray");
        FunctionWords words;
        words.opacity = one.word;
        const TransferFunction absolute = resolved(withWords(function, words), {0.0, 255.0, 7.0, 50.0, {}});
        for (int i = 0; i < 7; ++i) {
            const double alpha = -std::expm1(-absolute.extinctionAt(entries[i]));
            EXPECT_NEAR(alpha, one.alpha[i] / 255.0, 1.0 / 255.0 + 1.0 / 1024.0) << one.word << " " << entries[i];
        }
        EXPECT_LE(absolute.extinction.size(), 64u) << one.word;
    }
    EXPECT_NE(messageOf([] { opacityOfWord("sigmod"); }).find("did you mean \"sigmoid\""), std::string::npos);
    EXPECT_NE(messageOf([] { opacityOfWord("sigmoid_99"); }), "");
}

TEST(FunctionWords, OpacityCountsOverItsDistance) {
    FunctionWords words;
    words.opacities = {0.0, 0.5, 1.0};
    const FitTo to{10.0, 20.0, 3.0, 100.0, {}};
    TransferFunction function = resolved(withWords(preset("viridis"), words), to);
    EXPECT_NEAR(function.extinctionAt(15.0), std::log(2.0) / 2.0, 1e-9) << "unit distance: 1/50 of the diagonal";
    EXPECT_EQ(function.extinctionAt(10.0), 0.0);
    EXPECT_NEAR(function.extinctionAt(20.0), 1e4 / 100.0, 1e-9) << "opaque";
    for (int i = 0; i <= 1000; ++i) {  // α is linear
        const double s = 10.0 + 0.01 * i;
        EXPECT_NEAR(-std::expm1(-2.0 * function.extinctionAt(s)), 0.001 * i, 1.0 / 1024.0 + 1e-12) << s;
    }
    words.unitDistance = 4.0;
    words.opacityScale = 3.0;
    function = resolved(withWords(preset("viridis"), words), to);
    EXPECT_NEAR(function.extinctionAt(15.0), 3.0 * std::log(2.0) / 4.0, 1e-9);
}

TEST(FunctionWords, ScaleLeavesWhatIsSuggestedOtherwise) {
    TransferFunction function = preset("viridis");
    function.isosurfaces = {{0.5, 0.4, {1, 1, 1}}, {0.7, 0.9, {1, 1, 1}}};
    FunctionWords words;
    words.opacityScale = 2.0;
    const TransferFunction plain = resolved(function, 0.0, 1.0, 2.0);
    const TransferFunction twice = resolved(withWords(function, words), 0.0, 1.0, 2.0);
    for (int i = 0; i <= 10; ++i) EXPECT_NEAR(twice.extinctionAt(0.1 * i), 2.0 * plain.extinctionAt(0.1 * i), 1e-12);
    EXPECT_NEAR(twice.isosurfaces[0].opacity, 0.8, 1e-12);
    EXPECT_EQ(twice.isosurfaces[1].opacity, 1.0);
}

TEST(FunctionWords, LogScale) {
    FunctionWords words;
    words.logScale = true;
    words.range = glm::dvec2(1e-3, 1e3);
    words.opacity = "linear";
    const TransferFunction function = resolved(withWords(preset("Cool to Warm"), words), {-5.0, 7.0, 1.0, 50.0, {}});
    const ColorMap map = colorMap("cool-to-warm");
    for (int i = 0; i <= 600; ++i) {
        const double fraction = i / 600.0, s = std::pow(10.0, 6.0 * fraction - 3.0);
        expectNear(function.colorAt(s), colorOf(map, fraction), 1.0 / 1024.0 + 1e-9, std::to_string(s));
        EXPECT_NEAR(-std::expm1(-function.extinctionAt(s)), fraction, 3.0 / 1024.0) << s;
    }
    words.range.reset();
    const std::string message = messageOf([&] {
        resolved(withWords(preset("viridis"), words), {-5.0, 7.0, 1.0, 1.0, {}});
    });
    EXPECT_NE(message.find("logarithmic scale: it goes from -5 to 7"), std::string::npos) << message;
}

TEST(FunctionWords, CategoriesAreSteps) {
    const ColorMap set = colorMap("Set1");
    const TransferFunction ids = resolved(preset("set1"), {1.0, 20.0, 1.0, 1.0, {1.0, 4.0, 20.0}});
    expectNear(ids.colorAt(1.0), set.categories[0], 1e-12, "1.0");
    expectNear(ids.colorAt(2.49), set.categories[0], 1e-12, "2.49");
    expectNear(ids.colorAt(2.51), set.categories[1], 1e-12, "2.51");
    expectNear(ids.colorAt(4.0), set.categories[1], 1e-12, "4.0");
    expectNear(ids.colorAt(20.0), set.categories[2], 1e-12, "20.0");
    const TransferFunction bands = resolved(preset("set1"), {0.0, 9.0, 1.0, 1.0, {}});
    expectNear(bands.colorAt(3.5), set.categories[3], 1e-12, "3.5");
    std::vector<double> many;
    for (int i = 0; i < 30; ++i) many.push_back(i);
    expectNear(resolved(preset("set1"), {0.0, 29.0, 1.0, 1.0, many}).colorAt(9.0), set.categories[0], 1e-12,
               "over again");
    const TransferFunction one = resolved(preset("set1"), {3.0, 3.0, 1.0, 1.0, {3.0}});
    expectNear(one.colorAt(3.0), set.categories[0], 1e-12, "3.0");
}

TEST(FunctionWords, InJson) {
    const TransferFunction function = parseTransferFunction(
        R"({"colorMap": "viridis_r", "opacity": "sigmoid_5", "range": [2, 4], "unitDistance": 0.5, "opacityScale": 2})",
        "tf.json");
    EXPECT_TRUE(function.normalized);
    const TransferFunction absolute = resolved(function, {0.0, 1.0, 1.0, 100.0, {}});
    expectNear(absolute.colorAt(4.0), colorOf(colorMap("viridis"), 0.0), 1e-12, "reversed");
    EXPECT_NEAR(absolute.extinctionAt(3.0), 2.0 * std::log(2.0) / 0.5, 1e-3);
    EXPECT_TRUE(parseTransferFunction(R"({"colorMap": "magma"})", "tf.json").extinctionSuggested);
    EXPECT_NE(
        messageOf([] { parseTransferFunction(R"({"colorMap": "magna"})", "tf.json"); }).find("did you mean \"magma\""),
        std::string::npos);
}

TEST(FunctionWords, WhatNoFunctionCanHave) {
    FunctionWords words;
    words.opacityScale = 0.0;
    EXPECT_NE(messageOf([&] { withWords(preset("viridis"), words); }), "");
    words = {};
    words.range = glm::dvec2(2.0, 1.0);
    EXPECT_NE(messageOf([&] { withWords(preset("viridis"), words); }), "");
    words = {};
    words.unitDistance = 1.0;
    EXPECT_NE(messageOf([&] { withWords(preset("viridis"), words); }), "") << "of extinction";
    words = {};
    words.opacities = {0.0, 1.5};
    EXPECT_NE(messageOf([&] { withWords(preset("viridis"), words); }), "");
}

}  // namespace
}  // namespace tetralux::preint
