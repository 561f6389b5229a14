// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: colour and opacity in words; tetralux colors.
#include <cmath>

#include <projection/image/image.h>

#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using ColorCommand = CommandLine;
using projection::Image;
using projection::readImage;

/// Along the line of lineView the corner's scalar is met from 1 to 0, over a length of 1.
TinyMesh rampTetrahedron() {
    TinyMesh corner = cornerTetrahedron(0);
    corner.values = {0, 0, 0, 2};
    return corner;
}

TEST_F(ColorCommand, OpacityWordsAndScale) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));  // constant: the middle of the range
    const std::string render = std::string("render corner.vtu -o a.exr --quiet") + lineView;
    // τ = −ln(1 − α)/d over a length of 1
    expectGood(render + " --opacity linear --opacity-distance 2");
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - std::sqrt(0.5), 1e-3);
    expectGood(render + " --opacity linear --opacity 2 --opacity-distance 2 --tf Viridis_r");
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 0.5, 1e-3);
    expectGood(render + " --tf constant.json --opacity 0.5");
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - std::exp(-0.35), 1e-6);
}

TEST_F(ColorCommand, ANameGivesColoursAlone) {
    write("ramp.vtu", vtuText(rampTetrahedron()));
    const std::string render = "render ramp.vtu -o a.exr --quiet --size 24x24";
    expectGood(render);
    const Image suggested = readImage(path("a.exr"));
    expectGood(render + " --tf magma");
    const Image named = readImage(path("a.exr"));
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) EXPECT_NEAR(named.at(x, y).w, suggested.at(x, y).w, 1e-6) << x << " " << y;
}

TEST_F(ColorCommand, RangeAndLogarithm) {
    TinyMesh corner = cornerTetrahedron(100);
    write("corner.vtu", vtuText(corner));
    const std::string render = std::string("render corner.vtu -o a.exr --quiet --mode first-hit --tf gray") + lineView;
    expectGood(render + " --range 0,400");
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).x, 0.25, 1e-4);
    expectGood(render + " --range 1,10000 --log");
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).x, 0.5, 2e-3);
    expectRefused("render corner.vtu -o a.png --size 8x8 --log --range -1,5", {"logarithmic", "-1", "range above 0"});
    expectRefused("render corner.vtu -o a.png --size 8x8 --log --tf constant.json",
                  {"--log", "constant.json", "--range"});
    expectRefused("render corner.vtu -o a.png --size 8x8 --range 0,1 --window 0,1", {"--window", "--range"});
    expectRefused("render corner.vtu -o a.png --size 8x8 --range 2,1", {"--range", "2 is not below 1"});
}

TEST_F(ColorCommand, UnknownNamesAreToldTheNearest) {
    const std::string render = "render bucky:6 -o a.png --size 8x8";
    expectRefused(render + " --tf virids", {"--tf virids", "did you mean \"viridis\"", "tetralux colors"});
    expectRefused(render + " --opacity sigmod", {"--opacity", "did you mean \"sigmoid\""});
    expectRefused(render + " --opacity 0", {"--opacity", "above 0"});
    expectRefused(render + " --opacity-distance 2", {"--opacity", "distance"});
}

TEST_F(ColorCommand, FunctionsThatCannotHaveBeenMeantAreTold) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    write("far.json", R"({"color": [[100, 0, 0, 1], [200, 1, 0, 0]], "extinction": [[100, 1]]})");
    write("thin.json", R"({"color": [[0, 1, 1, 1]], "extinction": [[0, 1e-6]]})");
    const Outcome far = tetralux("render corner.vtu -o a.png --size 9x9 --quiet --tf far.json");
    EXPECT_EQ(far.status, 0) << far.err;
    EXPECT_NE(far.err.find("nodes, 100 to 200, all lie above the field's scalars, 5 to 5"), std::string::npos)
        << far.err;
    const Outcome thin = tetralux("render corner.vtu -o a.png --size 9x9 --quiet --tf thin.json");
    EXPECT_NE(thin.err.find("tetralux: warning: corner.vtu: next to nothing shows"), std::string::npos) << thin.err;
    expectGood("render corner.vtu -o a.png --size 9x9 --quiet --tf far.json --range 4,6");
}

TEST_F(ColorCommand, StandardOutputInThePlaceOfFiles) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const Outcome picture = tetralux("render corner.vtu -o - --size 9x9");
    EXPECT_EQ(picture.status, 0) << picture.err;
    EXPECT_EQ(picture.out.substr(1, 3), "PNG");
    const Outcome report = tetralux("render corner.vtu -o a.png --size 9x9 --report -");
    EXPECT_EQ(nlohmann::json::parse(report.out)["size"][0], 9);
    expectRefused("render corner.vtu -o - --report -", {"-o -", "one picture"});
}

TEST_F(ColorCommand, ColorsAreListedAndDrawn) {
    const Outcome all = tetralux("colors");
    EXPECT_EQ(all.status, 0);
    for (const char* name : {"viridis\n", "jet\n", "Cool to Warm (Extended)\n", "tab10 (10 colours for ids)\n"})
        EXPECT_NE(all.out.find(name), std::string::npos) << name;
    EXPECT_EQ(tetralux("colors JET_R").out, "jet_r\n");
    expectGood("colors gray Set1 -o chart.png");
    const Image chart = readImage(path("chart.png"));
    EXPECT_LT(chart.at(10, 12).x, 0.1) << "the grey bar begins dark";
    EXPECT_GT(chart.at(185, 12).x, 0.9);
    expectRefused("colors plumm", {"plumm"});
}

}  // namespace
}  // namespace tetralux::tests
