// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: parts and shapes of a mesh, and the steps of a series.
#include <cmath>
#include <cstdlib>
#include <functional>

#include <projection/image/image.h>

#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using PartCommand = CommandLine;
using projection::Image;
using projection::readImage;

/// Two corner tetrahedra beside each other, with the values 5 and 9.
TinyMesh twoCorners() {
    TinyMesh mesh = cornerTetrahedron(5);
    for (const auto& p : cornerTetrahedron(9).points) mesh.points.push_back({p[0] + 10, p[1], p[2]});
    mesh.cells.push_back({4, 5, 6, 7});
    mesh.values.insert(mesh.values.end(), 4, 9.0);
    return mesh;
}

std::uint64_t tetrahedraIn(const nlohmann::json& report) {
    return report["cells"]["tetrahedra"].get<std::uint64_t>();
}

TEST_F(PartCommand, ThresholdsKeepWholeCells) {
    write("two.vtu", vtuText(twoCorners()));
    const std::string render = "render two.vtu -o a.png --quiet --size 9x9 --report r.json ";
    const auto left = [&](const std::string& options) {
        expectGood(render + options);
        return tetrahedraIn(json("r.json"));
    };
    EXPECT_EQ(left("--threshold s:5:9"), 2u);
    EXPECT_EQ(left("--threshold s:6:"), 1u);
    EXPECT_EQ(left("--threshold s::5"), 1u);
    EXPECT_EQ(json("r.json")["scalar"]["max"].get<double>(), 5.0) << "the range is that of what is left";
    EXPECT_EQ(left("--threshold x:-1:4"), 1u) << "a coordinate";
    expectRefused("render two.vtu -o a.png --threshold s:6:7", {"two.vtu", "no cell"});
    expectRefused("render two.vtu -o a.png --threshold t:6:7", {"no field named 't'", "'s'"});
    expectRefused("render two.vtu -o a.png --threshold s", {"--threshold", "FIELD:LOW:HIGH"});
    expectRefused("render two.vtu -o a.png --threshold s:9:5", {"--threshold", "9 is above 5"});
}

TEST_F(PartCommand, ScaleStretchesTheMesh) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = std::string("render corner.vtu -o a.exr --quiet --tf constant.json --scale ");
    // twice as long along the ray of lineView; a factor below 0 mirrors, and the cell is turned round
    expectGood(render + "1,1,2" + lineView);
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - std::exp(-1.4), 2e-6);
    expectGood(render + "1,1,-3" + lineView);
    EXPECT_NEAR(readImage(path("a.exr")).at(0, 0).w, 1.0 - std::exp(-2.1), 2e-6);
    expectRefused("render corner.vtu -o a.png --scale 1,0,1", {"--scale", "flat"});
    expectRefused("render corner.vtu -o a.png --warp s", {"no vector field", "'s'"});
}

TEST_F(PartCommand, BlocksByName) {
    write("low.vtu", vtuText(cornerTetrahedron(5)));
    TinyMesh other = cornerTetrahedron(9);
    for (auto& p : other.points) p[0] += 10;
    write("high.vtu", vtuText(other));
    write("both.vtm", R"(<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet>
<DataSet index="0" name="fluid" file="low.vtu"/><DataSet index="1" name="solid wall" file="high.vtu"/>
</vtkMultiBlockDataSet></VTKFile>)");
    const Outcome info = tetralux("info both.vtm");
    EXPECT_NE(info.out.find("blocks: 'fluid' (block 1), 'solid wall' (block 2)"), std::string::npos) << info.out;
    const std::string render = "render both.vtm -o a.png --quiet --size 9x9 --report r.json ";
    expectGood(render + "--blocks fluid");
    EXPECT_EQ(json("r.json")["scalar"]["max"].get<double>(), 5.0);
    EXPECT_EQ(json("r.json")["scalar"]["name"], "s") << "blocks are not shown unasked";
    expectGood(render + "--hide-blocks fluid");
    EXPECT_EQ(json("r.json")["scalar"]["min"].get<double>(), 9.0);
    expectGood(render + "--blocks 2,fluid --scalar block --tf tab10");
    EXPECT_EQ(tetrahedraIn(json("r.json")), 2u);
    expectRefused("render both.vtm -o a.png --blocks air", {"both.vtm", "no block 'air'", "'fluid' (block 1)"});
    expectRefused("render low.vtu -o a.png --blocks air", {"low.vtu", "no block 'air'", "does not say"});
}

/// Three steps at 0, 0.5 and 2 on one mesh, with the values 5, 7 and 9.
void writeSeries(const std::function<void(const std::string&, const std::string&)>& write) {
    std::string entries;
    for (const auto& [time, value] : {std::pair("0", 5.0), std::pair("0.5", 7.0), std::pair("2", 9.0)}) {
        TinyMesh step = cornerTetrahedron(value);
        step.values[0] = value - 1;
        write(fmt::format("step{}.vtu", time), vtuText(step));
        entries += fmt::format(R"(<DataSet timestep="{0}" file="step{0}.vtu"/>)", time);
    }
    write("run.pvd", R"(<VTKFile type="Collection" version="1.0"><Collection>)" + entries + "</Collection></VTKFile>");
}

TEST_F(PartCommand, TheStepOfASeriesIsTold) {
    writeSeries([&](const std::string& name, const std::string& text) { write(name, text); });
    const Outcome info = tetralux("info run.pvd");
    EXPECT_NE(info.out.find("steps: 3, by number and time 0: 0, 1: 0.5, 2: 2"), std::string::npos) << info.out;
    const Outcome half = tetralux("render run.pvd -o a.png --size 9x9 --time 0.6 --report r.json");
    EXPECT_EQ(half.status, 0) << half.err;
    EXPECT_NE(half.out.find("time 0.5 (step 1 of 3, from 0)"), std::string::npos) << half.out;
    EXPECT_EQ(json("r.json")["time"]["step"], 1);
    EXPECT_EQ(json("r.json")["time"]["drawn"].get<double>(), 0.5);
    const Outcome beyond = tetralux("render run.pvd -o a.png --size 9x9 --quiet --time 3");
    EXPECT_EQ(beyond.status, 0);
    EXPECT_NE(beyond.err.find("tetralux: warning: --time 3: outside the series, which goes from 0 to 2; drawn is 2"),
              std::string::npos)
        << beyond.err;
}

TEST_F(PartCommand, OnePictureAStep) {
    writeSeries([&](const std::string& name, const std::string& text) { write(name, text); });
    const std::string render =
        "render run.pvd -o s.exr --quiet --size 64x64 --view z --tf gray --mode mip --title {time} ";
    expectGood(render + "--times all --range all --report r.json");
    for (const char* name : {"s_0000.exr", "s_0001.exr", "s_0002.exr"}) ASSERT_TRUE(exists(name)) << name;
    EXPECT_FALSE(exists("s_0003.exr"));
    EXPECT_EQ(json("r.json")["ms"]["frame"].size(), 3u);
    // one range, from 4 to 9: the largest scalar is 5, 7, 9
    const auto brightest = [&](const char* name) {
        float most = 0.0f;
        const Image image = readImage(path(name));
        for (int y = 32; y < image.height; ++y)  // below the title
            for (int x = 0; x < image.width; ++x) most = std::max(most, image.at(x, y).x);
        return most;
    };
    EXPECT_NEAR(brightest("s_0000.exr"), 0.2, 0.02);
    EXPECT_NEAR(brightest("s_0001.exr"), 0.6, 0.02);
    EXPECT_NEAR(brightest("s_0002.exr"), 1.0, 0.02);
    expectGood("render run.pvd -o t.png --quiet --size 9x9 --times 0:-1:2");
    EXPECT_TRUE(exists("t_0001.png") && !exists("t_0002.png"));
    expectRefused("render run.pvd -o t.png --times 0:5", {"run.pvd", "--times", "no step 5", "from 0 to 2"});
    expectRefused("render run.pvd -o t.png --times all --frames 3", {"--times", "--frames"});
    expectRefused("render bucky:6 -o t.png --times all", {"bucky:6", "no series"});
    expectRefused("render run.pvd -o t.mp4", {"t.mp4", "--times all"});
}

TEST_F(PartCommand, FilmsAreMadeByFfmpeg) {
    writeSeries([&](const std::string& name, const std::string& text) { write(name, text); });
    if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) {
        expectRefused("render run.pvd -o film.mp4 --times all", {"film.mp4", "ffmpeg", "install"});
        GTEST_SKIP() << "there is no ffmpeg";
    }
    for (const char* film : {"film.mp4", "film.gif"}) {
        expectGood(std::string("render run.pvd --quiet --size 33x21 --times all -o ") + film);
        EXPECT_GT(std::filesystem::file_size(path(film)), 100u) << film;
    }
    EXPECT_EQ(fileNames().size(), 7u) << "nothing else is left";
}

TEST_F(PartCommand, PngHoldsAlphaAndSixteenBits) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    const std::string render = std::string("render corner.vtu -o a.png --quiet --tf constant.json") + lineView;
    const double alpha = 1.0 - std::exp(-0.7);
    expectGood(render + " --background none --bits 16");
    glm::vec4 pixel = readImage(path("a.png")).at(0, 0);  // read at 8 bits
    EXPECT_NEAR(pixel.w, alpha, 1.0 / 255);
    EXPECT_NEAR(pixel.x, alpha, 1.0 / 255) << "premultiplied again";
    EXPECT_NEAR(pixel.y, 0.5 * alpha, 1.0 / 255);
    expectGood(render + " --background none");
    pixel = readImage(path("a.png")).at(0, 0);
    EXPECT_NEAR(pixel.w, alpha, 0.5 / 255 + 1e-6);
    EXPECT_NEAR(pixel.z, 0.25 * alpha, 1.0 / 255);
    expectGood(render);
    EXPECT_EQ(readImage(path("a.png")).at(0, 0).w, 1.0f) << "over black unless alpha is asked for";
    expectRefused("render corner.vtu -o a.png --bits 12", {"--bits", "8 or 16"});
}

}  // namespace
}  // namespace tetralux::tests
