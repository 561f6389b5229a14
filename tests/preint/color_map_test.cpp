// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <preint/color_space.h>
#include <preint/transfer_function.h>

namespace tetralux::preint {
namespace {

void expectNear(const glm::dvec3& color, const glm::dvec3& expected, double tolerance, const std::string& what) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(color[channel], expected[channel], tolerance) << what << " channel " << channel;
}

// Expected values are those of vtkColorTransferFunction (VTK 9.1) between the ends of "Cool to Warm". VTK rounds its
// own matrices, hence 1e-5.
const glm::dvec3 cool{0.231373, 0.298039, 0.752941}, warm{0.705882, 0.0156863, 0.14902},
    gray{0.865003, 0.865003, 0.865003};

struct Known {
    ColorSpace space;
    double fraction;
    glm::dvec3 color;
};

TEST(ColorSpace, InterpolatesAsVtkDoes) {
    const Known table[] = {
        {ColorSpace::Rgb, 0.25, {0.350000, 0.227451, 0.601961}},
        {ColorSpace::Hsv, 0.25, {0.376427, 0.174936, 0.741176}},
        {ColorSpace::Hsv, 0.9, {0.710588, 0.036048, 0.296856}},
        {ColorSpace::Lab, 0.1, {0.355755, 0.280486, 0.689156}},
        {ColorSpace::Lab, 0.6, {0.613357, 0.179330, 0.383717}},
        {ColorSpace::Diverging, 0.1, {0.351735, 0.468506, 0.890376}},
        {ColorSpace::Diverging, 0.25, {0.553318, 0.688635, 0.995188}},
        {ColorSpace::Diverging, 0.5, {0.865395, 0.865410, 0.865396}},
        {ColorSpace::Diverging, 0.9, {0.842251, 0.326619, 0.266613}},
        {ColorSpace::Step, 0.1, warm},
    };
    for (const Known& known : table) {
        expectNear(interpolateColor(known.space, cool, warm, known.fraction), known.color, 1e-5,
                   "fraction " + std::to_string(known.fraction));
    }
    expectNear(interpolateColor(ColorSpace::Diverging, cool, gray, 0.2), {0.351956, 0.468420, 0.890252}, 1e-5,
               "towards gray");
}

TEST(ColorSpace, HueTurnsTheShortWayOnlyWhenWrapped) {
    const glm::dvec3 blue{0, 0, 1}, red{1, 0, 0};
    expectNear(interpolateColor(ColorSpace::Hsv, blue, red, 0.5), {0, 1, 0}, 1e-12, "through green");
    expectNear(interpolateColor(ColorSpace::HsvWrapped, blue, red, 0.5), {1, 0, 1}, 1e-12, "through magenta");
}

TEST(ColorSpace, SamplingFollowsTheSpaceClosely) {
    for (const ColorSpace space : {ColorSpace::Hsv, ColorSpace::HsvWrapped, ColorSpace::Lab, ColorSpace::Diverging}) {
        TransferFunction function;
        function.color = sampledInRgb(space, {{10.0, cool}, {20.0, warm}});
        EXPECT_LE(function.color.size(), 130u);
        for (int i = 0; i <= 1000; ++i) {
            expectNear(function.colorAt(10.0 + 0.01 * i), interpolateColor(space, cool, warm, 0.001 * i), 1.5e-3,
                       "sample " + std::to_string(i));
        }
    }
}

TEST(Presets, AreWholeAndVisible) {
    EXPECT_EQ(presetNames(),
              (std::vector<std::string>{"viridis", "inferno", "plasma", "magma", "cividis", "turbo", "cool-to-warm",
                                        "grayscale", "rainbow", "black-body", "blue-to-yellow"}));
    for (const std::string& name : presetNames()) {
        const TransferFunction function = preset(name);
        EXPECT_TRUE(function.normalized && function.extinctionPerExtent) << name;
        EXPECT_EQ(function.color.front().scalar, 0.0) << name;
        EXPECT_EQ(function.color.back().scalar, 1.0) << name;
        EXPECT_TRUE(function.extinctionSuggested) << name << ": a name is of colours alone";
        EXPECT_GT(function.extinctionAt(0.0), 0.0) << name << ": all of the mesh shows";
        EXPECT_LT(function.extinctionAt(0.1), 1.0) << name << ": low values show through";
        EXPECT_GT(function.extinctionAt(0.9), 5.0) << name << ": high values hide what is behind";
    }
}

TEST(Presets, HaveTheirPublishedColors) {
    // matplotlib's viridis[128] and inferno[64], which are not among the thinned nodes
    expectNear(preset("viridis").colorAt(128.0 / 255.0), {0.127568, 0.566949, 0.550556}, 1.0 / 510.0 + 1e-6, "viridis");
    expectNear(preset("inferno").colorAt(64.0 / 255.0), {0.341500, 0.062325, 0.429425}, 1.0 / 510.0 + 1e-6, "inferno");
    // the same of plasma[128], magma[128], cividis[128] and turbo[64]
    expectNear(preset("plasma").colorAt(128.0 / 255.0), {0.798216, 0.280197, 0.469538}, 1.0 / 510.0 + 1e-6, "plasma");
    expectNear(preset("magma").colorAt(128.0 / 255.0), {0.716387, 0.214982, 0.475290}, 1.0 / 510.0 + 1e-6, "magma");
    expectNear(preset("cividis").colorAt(128.0 / 255.0), {0.488697, 0.485318, 0.471008}, 1.0 / 510.0 + 1e-6, "cividis");
    expectNear(preset("turbo").colorAt(64.0 / 255.0), {0.158440, 0.735510, 0.923050}, 1.0 / 510.0 + 1e-6, "turbo");
    expectNear(preset("cool-to-warm").colorAt(0.1), {0.351956, 0.468420, 0.890252}, 1.5e-3,
               "cool-to-warm as VTK has it");
    expectNear(preset("rainbow").colorAt(0.125), interpolateColor(ColorSpace::Hsv, {0, 0, 1}, {1, 0, 0}, 0.125), 1e-12,
               "rainbow");
    expectNear(preset("black-body").colorAt(0.6), {230.0 / 255.0, 115.0 / 255.0, 0.0}, 1e-12, "black-body");
}

TEST(ParaViewColorMap, OpacityFollowsMidpointAndSharpness) {
    // opacity 0.1 → 0.9, midpoint 0.3, sharpness 0.4 from 0 to 1; sharpness 1 (a step) from 2 to 3. Values of
    // vtkPiecewiseFunction.
    const TransferFunction function = parseTransferFunction(
        R"([{"ColorSpace": "RGB", "RGBPoints": [0, 0, 0, 0, 3, 1, 1, 1], "Points": [0, 0.1, 0.3, 0.4, 1, 0.9, 0.5, 0, 2, 0.1, 0.3, 1, 3, 0.9, 0.5, 0]}])",
        "map.json");
    const double unit = 50.0;  // extinction per extent of opacity 1
    EXPECT_TRUE(function.extinctionPerExtent);
    EXPECT_FALSE(function.normalized);
    EXPECT_NEAR(function.extinctionAt(0.25), unit * 0.23001952, unit * 1e-3);
    EXPECT_NEAR(function.extinctionAt(0.5), unit * 0.84759279, unit * 1e-3);
    EXPECT_NEAR(function.extinctionAt(0.1), unit * 0.10099171, unit * 1e-3);
    EXPECT_NEAR(function.extinctionAt(1.5), unit * 0.5, 1e-12);
    EXPECT_NEAR(function.extinctionAt(2.299), unit * 0.1, 1e-12);
    EXPECT_NEAR(function.extinctionAt(2.301), unit * 0.9, 1e-12);
}

TEST(ParaViewColorMap, PresetRangeMeansTheFieldsRange) {
    const TransferFunction function = parseTransferFunction(R"([{"RGBPoints": [0, 0, 0, 0, 1, 1, 1, 1]}])", "map.json");
    EXPECT_TRUE(function.normalized);
    EXPECT_EQ(function.extinctionAt(0.0), 0.0);
    EXPECT_GT(function.extinctionAt(1.0), 0.0);
}

TEST(ParaViewColorMap, StepsBecomeJumps) {
    const TransferFunction function = parseTransferFunction(
        R"([{"ColorSpace": "Step", "RGBPoints": [0, 1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1]}])", "map.json");
    EXPECT_EQ(function.colorAt(0.5), glm::dvec3(0, 1, 0));
    EXPECT_EQ(function.colorAt(1.5), glm::dvec3(0, 0, 1));
}

/// Linear in the logarithm, colours and opacity, to within 1/1024 of a channel and of the largest opacity.
TEST(ParaViewColorMap, LogarithmicScale) {
    const TransferFunction function = parseTransferFunction(
        R"([{"ColorSpace": "RGB", "RGBPoints": [0.001, 0, 0, 1, 1, 0, 1, 0, 1000.0, 1, 0, 0], "UseLogScale": 1,
             "Points": [0.001, 0, 0.5, 0, 10, 0.8, 0.5, 0, 10, 0.2, 0.5, 0, 1000, 1, 0.5, 0]}])",
        "map.json");
    const double unit = 50.0;  // extinction per extent of opacity 1
    for (int i = 0; i <= 6000; ++i) {
        const double decade = -3.0 + i * 1e-3, s = std::pow(10.0, decade);
        const double up = std::clamp(decade / 3.0, 0.0, 1.0), down = std::clamp(-decade / 3.0, 0.0, 1.0);
        expectNear(function.colorAt(s), {up, 1.0 - up - down, down}, 1.0 / 1024.0, "at " + std::to_string(s));
        const double opacity = decade < 1.0 ? 0.8 * (decade + 3.0) / 4.0 : 0.2 + 0.8 * (decade - 1.0) / 2.0;
        const double jumps = std::abs(decade - 1.0) < 1e-9 ? unit : 0.0;
        EXPECT_NEAR(function.extinctionAt(s), unit * opacity, unit / 1024.0 + jumps) << s;
    }
    // What the map names is met exactly, a jump from above.
    EXPECT_EQ(function.colorAt(1.0), glm::dvec3(0, 1, 0));
    EXPECT_EQ(function.colorAt(1000.0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(function.extinctionAt(10.0), unit * 0.2);
    EXPECT_LT(function.color.size(), 100u);
    try {
        parseTransferFunction(R"([{"RGBPoints": [0, 0, 0, 1, 2, 0, 1, 0], "UseLogScale": 1}])", "map.json");
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("UseLogScale needs points above 0"), std::string::npos)
            << error.what();
    }
}

TEST(XmlColorMap, OfParaView) {
    const TransferFunction function = parseTransferFunction(
        "<ColorMaps>\n<ColorMap name=\"m\" space='RGB'>\n<Point x=\"0\" o=\"0\" r=\"0\" g=\"0\" b=\"1\"/>\n"
        "<Point x=\"1\" o=\"1\" r=\"1\" g=\"0\" b=\"0\"/>\n</ColorMap>\n</ColorMaps>",
        "map.xml");
    EXPECT_TRUE(function.normalized);
    EXPECT_EQ(function.colorAt(0.25), glm::dvec3(0.25, 0, 0.75));
    EXPECT_EQ(function.extinctionAt(0.5), 25.0);
}

TEST(XmlColorMap, OfVisIt) {
    const auto point = [](const char* color, const char* position) {
        return std::string(
                   "<Object name=\"ColorControlPoint\">\n<Field name=\"colors\" type=\"unsignedCharArray\" "
                   "length=\"4\">") +
               color + " </Field>\n<Field name=\"position\" type=\"float\">" + position + "</Field>\n</Object>\n";
    };
    const TransferFunction function = parseTransferFunction(
        "<?xml version=\"1.0\"?>\n<Object name=\"ColorTable\">\n<Field name=\"Version\" "
        "type=\"string\">3.0.0</Field>\n<Object name=\"ColorControlPointList\">\n" +
            point("0 0 255 255", "0") + point("0 255 0 255", "0.75") + point("255 0 0 255", "1") +
            "</Object>\n</Object>\n",
        "map.ct");
    EXPECT_EQ(function.colorAt(0.0), glm::dvec3(0, 0, 1));
    EXPECT_EQ(function.colorAt(0.75), glm::dvec3(0, 1, 0));
    EXPECT_EQ(function.colorAt(1.0), glm::dvec3(1, 0, 0));
    for (const char* other : {"<a/>", "<", "<ColorMap><Point x=\"q\"/>", "<ColorMap indexedLookup='1'>"})
        EXPECT_THROW(parseTransferFunction(other, "map.xml"), std::runtime_error) << other;
}

TEST(ColorMaps, OfOtherProgramsAreRefusedByName) {
    const std::string path = testing::TempDir() + "map_slicer.vp";
    std::ofstream(path) << "10\n4 0 0 1 1\n";
    try {
        readTransferFunction(path);
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("is a volume property of 3D Slicer, which is not read"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace tetralux::preint
