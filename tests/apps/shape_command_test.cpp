// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: limits, modes, classification, silhouettes, isosurfaces, adaptive opacity.
#include <projection/image/image.h>

#include <algorithm>
#include <cmath>

#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using ShapeCommand = CommandLine;
using projection::Image;
using projection::readImage;

TEST_F(ShapeCommand, ClipPlanesKeepTheSideOfTheirNormal) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const auto alphaOf = [&](const std::string& options) {
        expectGood("render corner.vtu -o a.exr --tf constant.json" + options + lineView);
        return static_cast<double>(readImage(path("a.exr")).at(0, 0).w);
    };
    const auto ofLength = [](double length) { return -std::expm1(-0.7 * length); };
    EXPECT_NEAR(alphaOf(" --clip-plane 0,0,0.25,0,0,1"), ofLength(0.75), 1e-6);
    EXPECT_NEAR(alphaOf(" --clip-plane 0,0,0.25,0,0,-1"), ofLength(0.25), 1e-6);
    EXPECT_NEAR(alphaOf(" --clip-plane 0,0,0.25,0,0,1 --clip-plane 0,0,0.5,0,0,-1"), ofLength(0.25), 1e-6);
    EXPECT_NEAR(alphaOf(" --clip-box 0,2,0,2,0.1,0.4"), ofLength(0.3), 1e-6);
    const Outcome empty =
        tetralux("render corner.vtu -o a.exr --tf constant.json --clip-box 2,3,0,2,0.1,0.4" + std::string(lineView));
    EXPECT_EQ(empty.status, 0);
    EXPECT_NE(empty.err.find("the clipping planes leave nothing"), std::string::npos) << empty.err;
    EXPECT_EQ(readImage(path("a.exr")).at(0, 0).w, 0.0f);
    EXPECT_NEAR(alphaOf(" --slab 0,0,0.5,0,0,3,0.2"), ofLength(0.2), 1e-6);
}

TEST_F(ShapeCommand, ModesByTheirNames) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const auto pixelOf = [&](const std::string& options) {
        expectGood("render corner.vtu -o a.exr --tf constant.json" + options + lineView);
        return readImage(path("a.exr")).at(0, 0);
    };
    EXPECT_NEAR(pixelOf(" --mode additive").y, 0.35, 1e-6);
    EXPECT_NEAR(pixelOf(" --mode additive").w, 0.7, 1e-6);
    EXPECT_NEAR(pixelOf(" --mode emission").y, 0.35, 1e-6);
    EXPECT_EQ(pixelOf(" --mode emission").w, 0.0f);
    EXPECT_NEAR(pixelOf(" --mode minimum").y, 0.5, 1e-6);
    EXPECT_EQ(pixelOf(" --mode depth").w, 1.0f);
    // a radiograph stands before white unless something else is asked for
    EXPECT_NEAR(pixelOf(" --mode absorption").x, std::exp(-0.7), 1e-6);
    EXPECT_NEAR(pixelOf(" --mode absorption --background none").w, -std::expm1(-0.7), 1e-6);
    EXPECT_EQ(pixelOf(" --mode absorption --background none").x, 0.0f);
    EXPECT_NEAR(pixelOf(" --classification post-linear").w, 0.7, 1e-6);
    EXPECT_NEAR(pixelOf(" --classification pre").w, -std::expm1(-0.7), 1e-6);
}

TEST_F(ShapeCommand, SilhouetteNeedsNoValue) {
    const std::string render = "render bucky:5 --size 12x12 --mode scale-invariant --engine reference -o ";
    const auto differ = [&](const std::string& a, const std::string& b) {
        return projection::compareImages(readImage(path(a)), readImage(path(b))).max;
    };
    expectGood(render + "plain.exr");
    expectGood(render + "bare.exr --silhouette");
    expectGood("render --silhouette bucky:5 --size 12x12 --mode scale-invariant --engine reference -o first.exr");
    expectGood(render + "exact.exr --silhouette exact");
    expectGood(render + "approximate.exr --silhouette approximate");
    EXPECT_EQ(differ("bare.exr", "exact.exr"), 0.0);
    EXPECT_EQ(differ("bare.exr", "first.exr"), 0.0);
    EXPECT_GT(differ("bare.exr", "plain.exr"), 1e-3);
    EXPECT_GT(differ("bare.exr", "approximate.exr"), 1e-3);
    expectRefused(render + "a.exr --silhouette=thick", {"--silhouette", "thick", "exact, approximate"});
}

TEST_F(ShapeCommand, PicturesWithMapsAreVerified) {
    for (const std::string options : {"--clip-plane 0.5,0.5,0.5,1,0.2,0.3", "--adaptive length", "--adaptive cells"}) {
        expectGood("render bucky:6 --size 24x24 -o a.png --verify 200 --report r.json --quiet " + options);
        EXPECT_LT(json("r.json")["verification"]["rmse"].get<double>(), 1e-3) << options;
    }
    expectGood("render bucky:6 --size 12x12 -o a.png --isosurfaces 12 --quiet");
    expectGood("render bucky:6 --size 12x12 -o a.png --gradient-opacity 0.3 --quiet");
}

TEST_F(ShapeCommand, IsosurfacesAreLitUnlessOneSaysOtherwise) {
    const std::string render = "render bucky:6 --size 24x24 --isosurfaces 5 --quiet -o ";
    const auto differ = [&](const std::string& a, const std::string& b) {
        return projection::compareImages(readImage(path(a)), readImage(path(b))).max;
    };
    expectGood(render + "usual.exr");
    expectGood(render + "head.exr --headlight");
    expectGood(render + "unlit.exr --unlit");
    expectGood(render + "light.exr --light 1,2,3");
    EXPECT_EQ(differ("usual.exr", "head.exr"), 0.0);
    EXPECT_GT(differ("usual.exr", "unlit.exr"), 1e-2);
    EXPECT_GT(differ("usual.exr", "light.exr"), 1e-2);
    expectGood(render + "average.exr --mode average");  // of modes without light it asks none
    expectRefused(render + "a.exr --unlit --headlight", {"--unlit", "leave one of them out"});
    expectRefused("render bucky:4 -o a.png --unlit", {"--unlit", "--isosurfaces"});
}

TEST_F(ShapeCommand, TheMapOfContributionsHoldsNumbers) {
    const std::string render = "render bucky:6 --size 24x24 --mode contributions --report r.json --quiet -o ";
    const auto largest = [&](const std::string& name) {
        float most = 0;
        for (const glm::vec4& pixel : readImage(path(name)).pixels) most = std::max(most, pixel.x);
        return most;
    };
    expectGood(render + "n.exr");
    const float most = largest("n.exr");
    EXPECT_GT(most, 5.0f);
    EXPECT_EQ(most, std::round(most));  // cells, where nothing else is asked for
    EXPECT_EQ(json("r.json")["contributions"]["most"].get<float>(), most);
    expectGood(render + "n.png");
    EXPECT_EQ(largest("n.png"), 1.0f);
    expectGood(render + "l.exr --adaptive length --adaptive-step 0.05");
    EXPECT_NE(largest("l.exr"), std::round(largest("l.exr")));
}

TEST_F(ShapeCommand, SamplesAreAveragedAndTold) {
    const std::string render = "render bucky:6 --size 24x24 --quiet --report r.json --verify 100 -o ";
    expectGood(render + "one.exr");
    EXPECT_EQ(json("r.json")["samples"].get<int>(), 1);
    expectGood(render + "four.exr --samples 4");
    EXPECT_EQ(json("r.json")["samples"].get<int>(), 4);
    EXPECT_LT(json("r.json")["verification"]["rmse"].get<double>(), 1e-4);
    expectGood(render + "nine.exr --samples 8");
    EXPECT_EQ(json("r.json")["samples"].get<int>(), 9);
    const auto one = readImage(path("one.exr")), four = readImage(path("four.exr"));
    EXPECT_EQ(four.width, 24);
    EXPECT_GT(projection::compareImages(one, four).max, 1e-3);
    expectRefused("render bucky:4 -o a.png --samples 0", {"--samples", "1 to 64"});
    expectRefused("render bucky:4 -o a.png --samples 65", {"--samples", "1 to 64"});
}

TEST_F(ShapeCommand, RefusesWhatCannotBe) {
    const std::string render = "render bucky:4 -o a.png ";
    expectRefused(render + "--clip-plane 0,0,0,1,0", {"--clip-plane", "px,py,pz,nx,ny,nz"});
    expectRefused(render + "--clip-plane 0,0,0,0,0,0", {"--clip-plane", "no direction"});
    expectRefused(render + "--clip-box 0,1,0,1,2,1", {"--clip-box", "not below"});
    expectRefused(render + "--slab 0,0,0,0,0,1,-2", {"--slab", "thickness"});
    expectRefused(render + "--classification middle", {"--classification", "preintegrated, post"});
    expectRefused(render + "--classification post --mode mip", {"--classification", "first-hit"});
    expectRefused(render + "--isosurfaces 0", {"--isosurfaces", "1024"});
    expectRefused(render + "--adaptive voxels", {"--adaptive", "cells, length"});
    expectRefused(render + "--adaptive cells --mode mip", {"--adaptive", "additive"});
    expectRefused(render + "--adaptive cells --adaptive-max 2", {"--adaptive-max", "up to 1"});
    expectRefused(render + "--adaptive cells --adaptive-threshold 1", {"--adaptive-threshold", "below 1"});
    expectRefused(render + "--adaptive cells --classification pre", {"--classification pre", "post"});
    expectRefused(render + "--gradient-opacity -1", {"--gradient-opacity"});
}

}  // namespace
}  // namespace tetralux::tests
