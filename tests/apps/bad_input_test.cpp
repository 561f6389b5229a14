// SPDX-License-Identifier: Apache-2.0
//
// Every wrong command and every broken file: one line that names the place, exit 2, no output file.
#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using BadInput = CommandLine;

TEST_F(BadInput, Commands) {
    expectRefused("", {"tetralux --help"});
    expectRefused("rendr bucky:8", {"rendr", "render", "info", "compare"});
    expectRefused("render", {"MESH", "tetralux render --help"});
    expectRefused("render bucky:8", {"--output", "tetralux render --help"});
    expectRefused("render bucky:8 -o", {"--output"});
    expectRefused("render bucky:8 -o a.png --no-such-option", {"--no-such-option"});
    expectRefused("render bucky:8 -o a.png more", {"more"});
    expectRefused("info", {"MESH"});
    expectRefused("compare a.png", {"B"});
}

TEST_F(BadInput, Values) {
    const std::string render = "render bucky:8 -o a.png ";
    for (const char* size :
         {"0x0", "0x5", "5x0", "-3x5", "axb", "5", "5x", "x5", "5x5x5", "5.5x5", "20000x5", "5x99999999999"})
        expectRefused(render + "--size " + size, {"--size", size, "512x512"});
    for (const char* option : {"--eye", "--target", "--up"})
        for (const char* vector : {"1,2", "1,2,3,4", "1,2,x", "nan,0,0", "1,,2", "inf,1,1", ","})
            expectRefused(render + option + " " + vector, {option, vector, "x,y,z"});
    for (const char* light : {"0,0,0", "1,2"}) expectRefused(render + "--light " + light, {"--light"});
    for (const char* background : {"2,0,0", "-0.1,0,0", "red", "1,1"})
        expectRefused(render + "--background " + background, {"--background"});
    for (const char* fov : {"0", "180", "-5", "nan", "inf", "wide"}) expectRefused(render + "--fov " + fov, {"--fov"});
    for (const char* height : {"0", "-1", "nan"}) expectRefused(render + "--height " + height, {"--height"});
    for (const char* frames : {"0", "-2", "2.5", "many"}) expectRefused(render + "--frames " + frames, {"--frames"});
    for (const char* threads : {"0", "-1", "x"}) expectRefused(render + "--threads " + threads, {"--threads"});
    for (const char* error : {"0", "-1", "nan"}) expectRefused(render + "--table-error " + error, {"--table-error"});
    expectRefused(render + "--table-size 1", {"--table-size"});
    expectRefused(render + "--mode x-ray", {"--mode", "x-ray", "standard, scale-invariant, mip, minimum, average"});
    expectRefused(render + "--engine vulkan", {"vulkan", "reference"});
    expectRefused(render + "--eye 1,1,1 --target 1,1,1", {"--eye"});
    expectRefused(render + "--eye 0,5,0 --target 0,0,0 --up 0,1,0", {"--up"});
}

TEST_F(BadInput, Outputs) {
    write("file", "");
    for (const char* output : {"a.jpg", "a", "missing/a.png", "file/a.exr", "/proc/a.png"})
        expectRefused(fmt::format("render bucky:8 -o {}", output), {output});
    expectRefused("render bucky:8 -o a.png --report missing/r.json", {"missing/r.json"});
    std::filesystem::create_directory(folder_ / "a_0001.png");
    expectRefused("render bucky:8 -o a.png --frames 3", {"a_0001.png"});
}

TEST_F(BadInput, OutputsAreLookedAtBeforeTheMesh) {
    expectRefused("render missing.vtu -o missing/a.png", {"missing/a.png"});
}

TEST_F(BadInput, TransferFunctions) {
    write("broken.json", R"({"color": [[0, 1, 1, 1], )");
    write("negative.json", R"({"color": [[0, 1, 1, 1]], "extinction": [[0, -1]]})");
    expectRefused("render bucky:8 -o a.png --tf broken.json", {"broken.json"});
    expectRefused("render bucky:8 -o a.png --tf negative.json", {"negative.json"});
    expectRefused("render bucky:8 -o a.png --tf missing.json", {"missing.json", "viridis", "inferno"});
    expectRefused("render bucky:8 -o a.png --tf .", {".: "});
}

TEST_F(BadInput, Meshes) {
    const std::string whole = vtuText(cornerTetrahedron(5));
    write("truncated.vtu", whole.substr(0, whole.size() / 2));
    write("nothing.vtu", "");
    write("empty.vtu", vtuText({}));
    write("nocells.vtu", vtuText({{{0, 0, 0}, {1, 0, 0}}, {}, {1, 2}}));
    write("noise.vtu", "\x01\x02not a mesh\xff");
    write("text.abc", "hello");
    for (const char* name :
         {"missing.vtu", "truncated.vtu", "nothing.vtu", "empty.vtu", "nocells.vtu", "noise.vtu", "text.abc"})
        expectRefused(fmt::format("render {} -o a.png", name), {name});
    for (const char* name : {"missing.vtu", "truncated.vtu", "nothing.vtu", "noise.vtu", "text.abc"})
        expectRefused(fmt::format("info {}", name), {name});
    expectRefused("render . -o a.png", {"."});
    for (const char* name :
         {"bucky:1", "bucky:0", "bucky:-3", "bucky:x", "bucky:", "bucky:99999999999999999999", "buckie:8"})
        expectRefused(fmt::format("render {} -o a.png", name), {name});
}

TEST_F(BadInput, Fields) {
    expectRefused("render bucky:8 -o a.png --scalar temperature", {"bucky:8", "temperature", "density"});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    write("nan.vtu", vtuText(cornerTetrahedron(nan)));
    expectRefused("render nan.vtu -o a.png", {"nan.vtu", "'s'"});
}

TEST_F(BadInput, Images) {
    write("broken.png", "PNG");
    expectGood("render bucky:4 -o a.png --size 4x4 --engine reference --quiet");
    expectGood("render bucky:4 -o b.png --size 5x4 --engine reference --quiet");
    expectRefused("compare a.png missing.png", {"missing.png"});
    expectRefused("compare a.png broken.png", {"broken.png"});
    expectRefused("compare a.png b.png", {"a.png", "b.png", "4x4", "5x4"});
    expectRefused("compare a.png constant.json", {"constant.json"});
}

}  // namespace
}  // namespace tetralux::tests
