// SPDX-License-Identifier: Apache-2.0
#include <preint/transfer_function.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "parse_any_text.h"

namespace tetralux::preint {
namespace {

std::string messageOf(const std::string& json) {
    try {
        parseTransferFunction(json, "tf.json");
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

TEST(TransferFunction, ReadsAllItsParts) {
    const TransferFunction function = parseTransferFunction(
        R"({"color": [[0, 0, 0.25, 1], [2, 1, 0.75, 0]], "extinction": [[0, 0], [1, 5], [1, 2], [4, 0]],
            "isosurfaces": [{"value": 3, "opacity": 0.5, "color": [1, 0, 0]}, {"value": 1, "opacity": 1, "color": [0, 1, 0]}], "normalized": false})",
        "tf.json");
    EXPECT_EQ(function.colorAt(-1.0), glm::dvec3(0, 0.25, 1));
    EXPECT_EQ(function.colorAt(1.0), glm::dvec3(0.5, 0.5, 0.5));
    EXPECT_EQ(function.colorAt(7.0), glm::dvec3(1, 0.75, 0));
    EXPECT_EQ(function.extinctionAt(0.5), 2.5);
    EXPECT_EQ(function.extinctionAt(1.0), 2.0) << "a jump: the value from above";
    EXPECT_EQ(function.extinctionAt(2.5), 1.0);
    ASSERT_EQ(function.isosurfaces.size(), 2u);
    EXPECT_EQ(function.isosurfaces[0].value, 1.0) << "sorted by value";
    EXPECT_EQ(function.isosurfaces[1].opacity, 0.5);
    EXPECT_FALSE(function.normalized);
}

TEST(TransferFunction, IsosurfacesAloneBringTheirColors) {
    const TransferFunction function = parseTransferFunction(
        R"({"isosurfaces": [{"value": 3, "opacity": 0.5, "color": [1, 0, 0]}, {"value": 1, "opacity": 1, "color": [0, 1, 0]}]})",
        "tf.json");
    EXPECT_EQ(function.colorAt(3.0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(function.extinctionAt(3.0), 0.0);
}

struct Wrong {
    const char* json;
    const char* message;
};

class TransferFunctionErrors : public testing::TestWithParam<Wrong> {};

TEST_P(TransferFunctionErrors, NamePlaceAndRemedy) {
    EXPECT_EQ(messageOf(GetParam().json), std::string("tf.json: ") + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Table, TransferFunctionErrors,
    testing::Values(
        Wrong{"[]",
              "is not a transfer function; write an object {\"color\": …, \"extinction\": …} or export a color map "
              "from ParaView"},
        Wrong{"{}",
              "has neither \"extinction\" nor \"isosurfaces\", so nothing could be seen; add \"extinction\": [[s, "
              "tau], …] or \"opacity\": \"linear\""},
        Wrong{R"({"extinction": [[0, 1]]})",
              "has no \"color\"; add \"color\": [[s, r, g, b], …] or \"colorMap\": \"viridis\""},
        Wrong{R"({"colour": []})",
              "has an unknown key \"colour\"; known are color, colorMap, extinction, opacity, unitDistance, "
              "opacityScale, "
              "isosurfaces, normalized, logScale, range, extinctionPerExtent"},
        Wrong{R"({"colorMap": "viridis", "color": [[0, 1, 1, 1]]})",
              "has both \"colorMap\" and \"color\"; leave one of them out"},
        Wrong{
            R"({"colorMap": "viridis", "normalized": false})",
            "has a name in the place of nodes, which counts in fractions of the range; set \"normalized\" to true, or "
            "leave it out"},
        Wrong{R"({"color": [[0, 1, 1, 1]], "opacity": [[0, 2]]})",
              "opacity[0][1] is 2, but an opacity must lie between 0 and 1"},
        Wrong{R"({"colorMap": "viridis", "unitDistance": 0})", "unitDistance is 0, must be above 0"},
        Wrong{R"({"colorMap": "viridis", "range": [2, 1]})", "range has its higher end first; write [low, high]"},
        Wrong{R"({"color": []})", "color is empty, must have at least one node [s, r, g, b]"},
        Wrong{R"({"color": 3})", "color is 3, must be a list: [[s, r, g, b], …]"},
        Wrong{R"({"color": [[0, 1, 1]]})", "color[0] has 3 numbers, a color node has four: [s, r, g, b]"},
        Wrong{R"({"color": [[0, 1, "x", 1]]})", "color[0][2] is \"x\", must be a number"},
        Wrong{R"({"color": [[0, 1, 255, 1]]})",
              "color[0][2] is 255, but a color channel (divide channels of 0 to 255 by 255) must lie between 0 and 1"},
        Wrong{R"({"color": [[1, 1, 1, 1], [0, 1, 1, 1]]})",
              "color[1] has scalar 0, below the 1 before it; sort the nodes by scalar"},
        Wrong{R"({"color": [[1, 1, 1, 1], [1, 0, 1, 1], [1, 0, 0, 1]]})",
              "color[2] is the third node at scalar 1; two make a jump, leave one out"},
        Wrong{R"({"extinction": []})", "extinction is empty, must have at least one node [s, tau]"},
        Wrong{R"({"extinction": [[0, -1]]})", "extinction[0][1] is -1, but extinction must not be negative"},
        Wrong{R"({"extinction": [[0, 1], [2, null]]})", "extinction[1][1] is null, must be a number"},
        Wrong{R"({"extinction": [[2, 1], [1, 1]]})",
              "extinction[1] has scalar 1, below the 2 before it; sort the nodes by scalar"},
        Wrong{R"({"isosurfaces": [{"value": 1, "opacity": 1.5, "color": [0, 0, 0]}]})",
              "isosurfaces[0].opacity is 1.5, but an opacity must lie between 0 and 1"},
        Wrong{R"({"isosurfaces": [{"value": 1, "color": [0, 0, 0]}]})", "isosurfaces[0] has no \"opacity\"; add it"},
        Wrong{R"({"isosurfaces": [{"value": 1, "opacity": 1, "color": [0, 0]}]})",
              "isosurfaces[0].color has 2 numbers, a color has three: [r, g, b]"},
        Wrong{R"({"isosurfaces": [{"value": 1, "alpha": 1}]})",
              "isosurfaces[0] has an unknown key \"alpha\"; known are value, opacity, color"},
        Wrong{R"({"isosurfaces": [7]})",
              "isosurfaces[0] must be an object: {\"value\": v, \"opacity\": a, \"color\": [r, g, b]}"},
        Wrong{R"({"normalized": 1})", "normalized is 1, must be true or false"},
        Wrong{R"([{"RGBPoints": [0, 0, 0, 0]}, {"RGBPoints": [0, 0, 0, 0]}])", "holds 2 color maps; export one alone"},
        Wrong{R"([{"ColorSpace": "RGB"}])",
              "is a ParaView color map without RGBPoints or IndexedColors; export one with either"},
        Wrong{R"([{"IndexedColors": [0, 0]}])", "IndexedColors has 2 numbers, must have three for each color: r, g, b"},
        Wrong{R"([{"RGBPoints": [0, 0, 0]}])", "RGBPoints has 3 numbers, must have four for each point: s, r, g, b"},
        Wrong{R"([{"RGBPoints": [1, 0, 0, 0, 0, 0, 0, 0]}])",
              "RGBPoints[4] is 0, below the 1 before it; sort the points by scalar"},
        Wrong{R"([{"RGBPoints": [1, 0, 0, 0], "Points": [0, 1.2, 0.5, 0]}])",
              "Points[1] is 1.2, but an opacity must lie between 0 and 1"},
        Wrong{R"([{"RGBPoints": [1, 0, 0, 0], "ColorSpace": "Lab/CIEDE2000"}])",
              "ColorSpace \"Lab/CIEDE2000\" is not a color space that is read here; choose CIELAB, Diverging, HSV, "
              "Lab, RGB or Step"}));

TEST(TransferFunction, InvalidJsonIsReportedWithLineAndColumn) {
    EXPECT_NE(
        messageOf("{\"color\": [[0, 1,\n 1, 1]").find("tf.json: is not valid JSON: parse error at line 2, column "),
        std::string::npos)
        << messageOf("{\"color\": [[0, 1,\n 1, 1]");
    EXPECT_NE(messageOf("{\"color\": [[0, NaN, 1, 1]]}").find("is not valid JSON"), std::string::npos);
    EXPECT_NE(messageOf("{\"color\": [[0, 1e999, 1, 1]]}").find("1e999"), std::string::npos);
}

TEST(TransferFunction, MissingAndEmptyFilesAreErrors) {
    EXPECT_THROW(readTransferFunction("no such file.json"), std::runtime_error);
    EXPECT_THROW(readTransferFunction(std::filesystem::temp_directory_path().string()), std::runtime_error);
}

TEST(TransferFunction, ResolvingTurnsFractionsAndExtentsIntoUnits) {
    TransferFunction function;
    function.color = {{0.0, {0, 0, 0}}, {0.5, {1, 1, 1}}};
    function.extinction = {{0.25, 6.0}};
    function.isosurfaces = {{1.0, 0.5, {1, 0, 0}}};
    function.normalized = true;
    function.extinctionPerExtent = true;
    const TransferFunction absolute = resolved(function, 100.0, 300.0, 3.0);
    EXPECT_EQ(absolute.color[1].scalar, 200.0);
    EXPECT_EQ(absolute.extinction[0].scalar, 150.0);
    EXPECT_EQ(absolute.extinction[0].extinction, 2.0);
    EXPECT_EQ(absolute.isosurfaces[0].value, 300.0);
    EXPECT_FALSE(absolute.normalized || absolute.extinctionPerExtent);
}

TEST(TransferFunction, ConstantFieldShowsAsTheMiddleOfItsRange) {
    const TransferFunction absolute = resolved(preset("grayscale"), 7.0, 7.0, 0.0);
    EXPECT_EQ(absolute.colorAt(7.0), glm::dvec3(0.5));
    EXPECT_GT(absolute.extinctionAt(7.0), 0.0);
}

TEST(TransferFunction, CorpusIsReadOrRefusedInOneLine) {
    int read = 0, files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TETRALUX_FUZZ_CORPUS)) {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        EXPECT_NO_THROW(read += parseAnyText(text)) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 9);
    EXPECT_EQ(read, files - 2) << "all but wrong.json and truncated.json";
}

/// The corpus with bytes changed, removed, doubled and joined: the same mutations every time.
TEST(TransferFunction, MutatedCorpusIsReadOrRefusedInOneLine) {
    std::vector<std::string> corpus;
    for (const auto& entry : std::filesystem::directory_iterator(TETRALUX_FUZZ_CORPUS)) {
        std::ifstream file(entry.path(), std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    std::sort(corpus.begin(), corpus.end());
    const std::string tokens[] = {"[", "]",      "{",    "}",    ",",    "-",    "1e308", "-1e308", "0",
                                  "1", "1e-320", "null", "\"\"", "true", "\xff", "[[",    "2e2"};
    std::mt19937_64 random(2005);
    auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
    int read = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text = corpus[below(corpus.size())];
        for (std::size_t change = 1 + below(3); change > 0 && !text.empty(); --change) {
            const std::size_t at = below(text.size());
            switch (below(4)) {
                case 0:
                    text[at] = static_cast<char>(below(256));
                    break;
                case 1:
                    text.erase(at, 1 + below(8));
                    break;
                case 2:
                    text.insert(at, tokens[below(std::size(tokens))]);
                    break;
                case 3:
                    text.replace(at, 1, tokens[below(std::size(tokens))]);
                    break;
            }
        }
        ASSERT_NO_THROW(read += parseAnyText(text)) << text;
    }
    EXPECT_GT(read, 500) << "mutations that still parse test the rest";
}

TEST(TransferFunction, WindowStretches) {
    TransferFunction function;
    function.color = {{0.0, {0, 0, 0}}, {1.0, {1, 0.5, 0}}};
    function.extinction = {{0.0, 2.0}, {0.5, 4.0}};
    function.isosurfaces = {{0.25, 0.5, {1, 1, 1}}};
    function.normalized = true;
    TransferFunction narrow = windowed(function, 10.0, 12.0, 7.0);
    EXPECT_FALSE(narrow.normalized);
    EXPECT_NEAR(narrow.colorAt(10.5).x, 0.25, 1e-12);
    EXPECT_EQ(narrow.colorAt(9.0), glm::dvec3(0)) << "what is below has the first colour";
    EXPECT_EQ(narrow.colorAt(99.0), glm::dvec3(1, 0.5, 0));
    EXPECT_NEAR(narrow.extinctionAt(10.5), 3.0, 1e-12) << "per unit as it was";
    EXPECT_NEAR(narrow.isosurfaces[0].value, 10.5, 1e-12);

    function.normalized = false;  // now 0 to 1 are scalars, and the same window takes the same nodes to the same places
    narrow = windowed(function, 10.0, 12.0, 7.0);
    EXPECT_NEAR(narrow.colorAt(10.5).x, 0.25, 1e-12);
    EXPECT_NEAR(narrow.isosurfaces[0].value, 10.5, 1e-12);

    function.extinctionPerExtent = true;
    EXPECT_NEAR(windowed(function, 10.0, 12.0, 2.0).extinctionAt(10.5), 1.5, 1e-12);

    const TransferFunction step = windowed(function, 10.0, 10.0, 2.0);
    EXPECT_EQ(step.colorAt(10.0), glm::dvec3(0)) << "a window without width is a step";
    EXPECT_EQ(step.colorAt(std::nextafter(10.0, 11.0)), glm::dvec3(1, 0.5, 0));
    EXPECT_EQ(step.extinctionAt(10.0), 1.0);
    EXPECT_EQ(step.extinctionAt(10.1), 2.0);

    function.color = {{3.0, {1, 1, 1}}};
    function.extinction = {{3.0, 1.0}};
    function.isosurfaces.clear();
    EXPECT_THROW(windowed(function, 0.0, 1.0, 1.0), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::preint
