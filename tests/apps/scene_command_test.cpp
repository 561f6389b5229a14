// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: where from, and the part as a surface.
#include <cmath>

#include <glm/geometric.hpp>

#include <projection/image/image.h>

#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using SceneCommand = CommandLine;
using projection::Image;
using projection::readImage;

/// Columns and rows in which anything shows.
struct Shown {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
Shown shownIn(const Image& image) {
    Shown shown;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y).w > 0.0f) {
                shown.left = std::min(shown.left, x);
                shown.right = std::max(shown.right, x);
                shown.top = std::min(shown.top, y);
                shown.bottom = std::max(shown.bottom, y);
            }
    return shown;
}

TEST_F(SceneCommand, ViewsAreFittedTightly) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));  // 4 along x and y, 2 along z
    const std::string render =
        "render corner.vtu -o a.exr --quiet --tf constant.json --engine reference --size 100x60 ";
    for (const char* view :
         {"--view x", "--view -y", "--view z", "--view iso", "--direction 1,2,-1", "--view xz --orthographic"}) {
        expectGood(render + view);
        const Shown shown = shownIn(readImage(path("a.exr")));
        const bool wide = shown.left <= 3 && shown.right >= 96, tall = shown.top <= 2 && shown.bottom >= 57;
        EXPECT_TRUE(wide || tall) << view << ": " << shown.left << " " << shown.right << " " << shown.top << " "
                                  << shown.bottom;
        EXPECT_TRUE(shown.left >= 1 && shown.right <= 98 && shown.top >= 0 && shown.bottom <= 59) << view;
    }
    expectGood(render + "--view z");
    const Shown whole = shownIn(readImage(path("a.exr")));
    expectGood(render + "--view z --zoom 0.5");
    const Shown half = shownIn(readImage(path("a.exr")));
    constexpr double narrower = 0.4641;  // tan 15° over tan 30°: the angle of view is doubled
    EXPECT_NEAR(half.bottom - half.top, narrower * (whole.bottom - whole.top), 2.0);
    expectGood(render + "--view z --roll 90 --report r.json");
    EXPECT_NEAR(json("r.json")["camera"]["up"][0].get<double>(), 1.0, 1e-9) << "vtkCamera's Roll";
    expectRefused("render corner.vtu -o a.png --view front", {"front", "iso"});
    expectRefused("render corner.vtu -o a.png --view x --eye 1,1,1", {"--eye", "--view"});
    expectRefused("render corner.vtu -o a.png --view x --target 1,1,1", {"--target"});
    expectRefused("render corner.vtu -o a.png --direction 0,0,0", {"--direction", "0,0,0"});
    expectRefused("render corner.vtu -o a.png --zoom 0", {"--zoom"});
}

TEST_F(SceneCommand, OrbitsHoldTheMeshAllTheWay) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    expectGood(
        "render corner.vtu -o o.exr --quiet --tf constant.json --engine reference --size 40x40 --view -y --frames 5");
    for (int frame = 0; frame < 5; ++frame) {
        const Shown shown = shownIn(readImage(path("o_000" + std::to_string(frame) + ".exr")));
        EXPECT_TRUE(shown.left > 0 && shown.right < 39 && shown.top > 0 && shown.bottom < 39) << frame;
    }
}

TEST_F(SceneCommand, AnEmptyPictureSaysWhy) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = "render corner.vtu -o a.png --quiet --size 9x9 ";
    const auto warningOf = [&](const std::string& options) {
        const Outcome outcome = tetralux(render + options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("tetralux: warning: corner.vtu: nothing shows", 0), 0u) << outcome.err;
        return outcome.err;
    };
    write("nothing.json", R"({"color": [[0, 1, 1, 1]], "extinction": [[0, 0]]})");
    EXPECT_NE(warningOf("--tf nothing.json").find("transfer function"), std::string::npos);
    EXPECT_NE(warningOf("--clip-plane 0,0,9,0,0,1").find("clipping planes"), std::string::npos);
    EXPECT_NE(warningOf("--eye 0,0,9 --target 0,0,20").find("behind the eye"), std::string::npos);
}

TEST_F(SceneCommand, SurfacesShowFieldsOfTheirOwn) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    write("colors.json", R"({"color": [[0, 0, 0, 0], [10, 1, 0.5, 0.25]], "extinction": [[0, 0]]})");
    write("patch.vtk",  // at 1,1: p is 0.25 · 8 + 0.25 · 4
          "# vtk DataFile Version 3.0\npatch\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 3 4 0 3 0 4 3 4 4 3\n"
          "POLYGONS 2 8\n3 0 1 2 3 1 3 2\nCELL_DATA 2\nSCALARS c double\nLOOKUP_TABLE default\n6 9\n"
          "POINT_DATA 4\nSCALARS p double\nLOOKUP_TABLE default\n0 8 4 1e300\n");
    const std::string render =
        std::string("render corner.vtu -o a.exr --quiet --tf colors.json --surface patch.vtk --surface-flat") +
        lineView;
    const auto colorWith = [&](const std::string& options) {
        expectGood(render + options);
        return glm::vec3(readImage(path("a.exr")).at(0, 0));
    };
    const glm::vec3 full(1.0f, 0.5f, 0.25f);
    EXPECT_LT(glm::distance(colorWith(" --surface-scalar p"), 0.3f * full), 1e-6f);
    EXPECT_LT(glm::distance(colorWith(" --surface-scalar c"), 0.6f * full), 1e-6f);
    EXPECT_LT(glm::distance(colorWith(" --surface-scalar none --surface-color 0.5,0.5,0.5"), glm::vec3(0.5f)), 1e-6f);
    expectRefused(render + " --surface-scalar q", {"patch.vtk", "q", "'p'", "'c'"});
    expectRefused(render + " --surface-scalar p --surface-scalar c", {"--surface-scalar", "2 for 1"});
    expectRefused("render bucky:4 -o a.png --surface-scalar p", {"--surface-scalar", "1 for 0"});
}

TEST_F(SceneCommand, TheBoundaryHidesTheVolume) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = std::string("render corner.vtu -o a.exr --quiet --tf constant.json") + lineView;
    expectGood(render + " --boundary --surface-flat");
    glm::vec4 pixel = readImage(path("a.exr")).at(0, 0);
    EXPECT_NEAR(pixel.y, 0.5, 1e-6);
    EXPECT_EQ(pixel.w, 1.0f);
    expectGood(render + " --boundary --surface-flat --boundary-opacity 0.5");  // front face, a length of 1, back face
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - 0.25 * std::exp(-0.7), 2e-6);
    expectGood(render + " --boundary --surface-flat --boundary-color 0,0,1 --clip-plane 0,0,0.5,0,0,-1");
    pixel = readImage(path("a.exr")).at(0, 0);
    EXPECT_EQ(pixel, glm::vec4(0, 0, 1, 1)) << "the cut is closed";
    expectGood(render + " --boundary");  // lit by a head light: the slanted face's normal is 1,1,2
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).y, 0.5 * (0.1 + 0.9 * 2.0 / std::sqrt(6.0)), 1e-5);
    expectRefused("render corner.vtu -o a.png --edges", {"--edges", "--boundary"});
    expectRefused("render corner.vtu -o a.png --boundary --boundary-opacity 2", {"--boundary-opacity"});
}

}  // namespace
}  // namespace tetralux::tests
