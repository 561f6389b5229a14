// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: slices, surfaces, window, annotation, preview; compare --structure.
#include <cmath>

#include <projection/image/image.h>

#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using PictureOptions = CommandLine;
using projection::Image;
using projection::readImage;

constexpr const char* squareOff = "OFF\n4 1 0\n-9 -9 0.5\n9 -9 0.5\n9 9 0.5\n-9 9 0.5\n4 0 1 2 3\n";

TEST_F(PictureOptions, SliceAndSurfaceEndTheVolume) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    write("square.off", squareOff);
    const std::string render = std::string("render corner.vtu -o a.exr --quiet --tf constant.json") + lineView;
    // a length of 1 in the cell, from z = 1 to 0; what is opaque stands at z = 0.5
    const double alpha = 1.0 - std::exp(-0.35);
    expectGood(render + " --surface square.off --surface-color 0,1,0 --surface-flat");
    glm::vec4 pixel = readImage(path("a.exr")).at(0, 0);
    EXPECT_NEAR(pixel.x, alpha, 2e-6);
    EXPECT_NEAR(pixel.y, 0.5 * alpha + (1 - alpha), 2e-6);
    EXPECT_NEAR(pixel.z, 0.25 * alpha, 2e-6);
    EXPECT_EQ(pixel.w, 1.0f);
    expectGood(render + " --slice 0,0,0.5,0,0,1");  // in the transfer function's colour, which is the volume's
    pixel = readImage(path("a.exr")).at(0, 0);
    EXPECT_NEAR(pixel.x, 1.0, 2e-6);
    EXPECT_NEAR(pixel.y, 0.5, 2e-6);
    EXPECT_EQ(pixel.w, 1.0f);
}

TEST_F(PictureOptions, ClippingTakesSlicesAway) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render =
        std::string("render corner.vtu -o a.exr --quiet --tf constant.json --slice 0,0,0.5,0,0,1") + lineView;
    expectGood(render + " --clip-plane 0,0,0.4,0,0,1");  // what lies above stays
    EXPECT_EQ(readImage(path("a.exr")).at(0, 0).w, 1.0f);
    expectGood(render + " --clip-plane 0,0,0.6,0,0,1");  // and with it a length of 0.4 of the volume
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - std::exp(-0.28), 2e-6);
}

TEST_F(PictureOptions, BadObjectsAreRefused) {
    write("square.off", squareOff);
    write("broken.stl", "solid\nfacet nor");
    write("noise.ply", "\x01\x02");
    const std::string render = "render bucky:6 -o a.png --size 8x8";
    expectRefused(render + " --surface missing.stl", {"missing.stl", "no such surface file"});
    expectRefused(render + " --surface broken.stl", {"broken.stl"});
    expectRefused(render + " --surface noise.ply", {"noise.ply"});
    expectRefused(render + " --surface constant.json", {"constant.json", ".stl"});
    expectRefused(render + " --surface square.off --surface-color 1,2,0", {"--surface-color", "1,2,0"});
    expectRefused(render + " --surface square.off --surface-color 1,0,0 --surface-color 1,1,0",
                  {"--surface-color", "2 colours for 1"});
    expectRefused(render + " --slice 0,0,0,0,0,0", {"--slice", "normal"});
    expectRefused(render + " --slice 0,0,0,1", {"--slice", "px,py,pz,nx,ny,nz"});
    expectRefused(render + " --slice 0,0,nan,0,0,1", {"--slice"});
    expectRefused(render + " --slice 0,0,7,0,0,1", {"slice", "0,0,7", "misses the mesh"});
}

TEST_F(PictureOptions, WindowStretchesTheTransferFunction) {
    write("ramp.json", R"({"normalized": true, "color": [[0, 0, 0, 0], [1, 1, 1, 1]], "extinction": [[0, 1000]]})");
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = std::string("render corner.vtu -o a.exr --quiet --tf ramp.json") + lineView;
    for (const auto& [window, gray] :
         {std::pair("5,2", 0.5), std::pair("4,4", 0.75), std::pair("7,2", 0.0), std::pair("0,2", 1.0)}) {
        expectGood(render + " --window " + window);
        EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).x, gray, 1e-5) << window;
    }
    expectRefused("render bucky:6 -o b.png --window 1,0", {"--window", "width"});
    expectRefused("render bucky:6 -o b.png --window 1", {"--window", "centre,width"});
    expectRefused("render bucky:6 -o b.png --window 1,2 --tf constant.json", {"window"});
}

/// What DICOM PS3.3, C.11.2.1.2.1 says of a window: the grey of x, as it stands there.
double dicomGrey(double x, double c, double w) {
    if (x <= c - 0.5 - (w - 1) / 2) return 0.0;
    if (x > c - 0.5 + (w - 1) / 2) return 1.0;
    return (x - (c - 0.5)) / (w - 1) + 0.5;
}

TEST_F(PictureOptions, WindowOfWholeNumbers) {
    write("ramp.json", R"({"normalized": true, "color": [[0, 0, 0, 0], [1, 1, 1, 1]], "extinction": [[0, 1000]]})");
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = std::string("render corner.vtu -o a.exr --quiet --tf ramp.json") + lineView;
    for (const double c : {4.0, 5.0, 5.5, 6.0, 7.0})
        for (const double w : {1.0, 2.0, 3.0, 4.5, 256.0}) {
            // windows beside the only value are warned of
            EXPECT_EQ(tetralux(fmt::format("{} --window dicom:{},{}", render, c, w)).status, 0);
            EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).x, dicomGrey(5, c, w), 1e-5) << c << ", " << w;
        }
    expectGood("render corner.vtu -o b.png --quiet --window dicom:5,1 --color-bar --size 64x64");
    expectRefused("render bucky:6 -o b.png --window dicom:1,0.5", {"--window", "whole number", "dicom:centre,width"});
    expectRefused("render bucky:6 -o b.png --window pet:1,2", {"--window", "dicom:centre,width"});
}

TEST_F(PictureOptions, HistogramsAreDrawnOfTheScalarAskedFor) {
    EXPECT_EQ(tetralux("info bucky:6 --histogram a.png --histogram-log").status, 0);
    EXPECT_EQ(contentOf(folder_ / "a.png").substr(1, 3), "PNG");
    EXPECT_EQ(tetralux("info bucky:6 --json --histogram a.svg --scalar z").status, 0);
    EXPECT_NE(contentOf(folder_ / "a.svg").find("z of bucky:6"), std::string::npos);
    expectRefused("info bucky:6 --histogram b.pdf", {"b.pdf", ".png"});
    expectRefused("info bucky:6 --histogram missing/b.png", {"missing"});
    expectRefused("info bucky:6 --histogram b.png --scalar pressure", {"bucky:6", "pressure"});
    expectRefused("info bucky:6 --scalar density", {"--scalar", "--histogram"});
    expectRefused("info bucky:6 --histogram-log", {"--histogram-log", "--histogram FILE"});
}

TEST_F(PictureOptions, IsolinesStandOnSlices) {
    const std::string render = "render bucky:6 -o a.exr --size 32x32 --quiet --slice 0.5,0.5,0.5,0,0,1 ";
    const auto rendered = [&](const std::string& options) {
        expectGood(render + options);
        return readImage(path("a.exr"));
    };
    const Image plain = rendered(""), lines = rendered("--isolines 3 --isoline-color 0,1,0"),
                wide = rendered("--isolines 3 --isoline-color 0,1,0 --isoline-width 4");
    EXPECT_GT(projection::compareImages(plain, lines).rmse, 0.05);
    EXPECT_GT(projection::compareImages(plain, wide).rmse, projection::compareImages(plain, lines).rmse);
    const std::string bad = "render bucky:6 -o b.png ";
    expectRefused(bad + "--isolines 3", {"--isolines", "--slice"});
    expectRefused(bad + "--slice 0.5,0.5,0.5,0,0,1 --isolines 0", {"--isolines", "1024"});
    expectRefused(bad + "--slice 0.5,0.5,0.5,0,0,1 --isolines 3 --isoline-width 0", {"--isoline-width"});
    expectRefused(bad + "--slice 0.5,0.5,0.5,0,0,1 --isolines 3 --isoline-color 0,2,0", {"--isoline-color"});
}

TEST_F(PictureOptions, AnnotationChangesOnlyWhatItCovers) {
    const std::string render = "render bucky:6 --size 200x160 --quiet --engine cpu --eye 1.9,1.4,2.3 -o ";
    expectGood(render + "plain.exr");
    expectGood(render + "noted.exr --color-bar --axes --title Bucky");
    const Image plain = readImage(path("plain.exr")), noted = readImage(path("noted.exr"));
    int changed = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) changed += plain.pixels[i] != noted.pixels[i] ? 1 : 0;
    EXPECT_GT(changed, 1500);
    EXPECT_LT(changed, 200 * 160 / 2);
    expectGood(render + "noted.png --color-bar --axes --title Bucky --background 1,1,1");
}

TEST_F(PictureOptions, PreviewComesFirstAndBothTimesAreTold) {
    const Outcome outcome =
        tetralux("render bucky:8 -o a.png --size 128x96 --engine cpu --preview 500 --report r.json");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("a_preview.png: "), std::string::npos) << outcome.out;
    EXPECT_LT(outcome.out.find("a_preview.png: "), outcome.out.find("a.png: "));
    const Image preview = readImage(path("a_preview.png")), refined = readImage(path("a.png"));
    EXPECT_EQ(preview.width, 128);
    EXPECT_LT(projection::compareImages(preview, refined).rmse, 0.1);
    const nlohmann::json report = json("r.json");
    EXPECT_EQ(report["preview"]["promised_ms"], 500.0);
    EXPECT_EQ(report["preview"]["kept"], report["preview"]["frame_ms"].get<double>() <= 500.0);
    EXPECT_GT(report["ms"]["frame"][0], 0.0);
    EXPECT_LE(report["preview"]["size"][0], 128);
    expectRefused("render bucky:6 -o b.png --preview 0", {"--preview"});
    expectRefused("render bucky:6 -o b.png --preview 20 --frames 3", {"--preview", "--frames"});
}

TEST_F(PictureOptions, CompareTellsStructure) {
    Image flat(32, 32), stripes(32, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            flat.at(x, y) = {0.5f, 0.5f, 0.5f, 1};
            stripes.at(x, y) = glm::vec4(glm::vec3(x / 4 % 2 ? 1.0f : 0.0f), 1.0f);
        }
    projection::writeImage(flat, path("flat.exr"));
    projection::writeImage(stripes, path("stripes.exr"));
    const nlohmann::json found = nlohmann::json::parse(tetralux("compare flat.exr stripes.exr --structure --json").out);
    EXPECT_NEAR(found["structure"][0], 0.0, 1e-12);
    EXPECT_GT(found["structure"][1], 0.1);
    EXPECT_NE(tetralux("compare flat.exr stripes.exr --structure").out.find("structure "), std::string::npos);
    EXPECT_EQ(tetralux("compare flat.exr stripes.exr").out.find("structure"), std::string::npos);
}

}  // namespace
}  // namespace tetralux::tests
