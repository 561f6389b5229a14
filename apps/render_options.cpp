// SPDX-License-Identifier: Apache-2.0
#include <apps/render_options.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <apps/add_option.h>
#include <apps/light_options.h>
#include <apps/option_values.h>
#include <apps/options/part_options.h>
#include <apps/read_options.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/verification.h>
#include <projection/gl/gl_path.h>

namespace tetralux::apps {

namespace {

constexpr int usualVerifiedPixels = 1000;

void addMeshOptions(CLI::App& command, RenderOptions& options) {
    command
        .add_option(
            "--scalar", options.scalar,
            "field to show: NAME (vectors by magnitude), or NAME:x, NAME:xy as the file calls a component; NAME@cells: "
            "beside one on points of that name")
        ->type_name("NAME");
    addReadOptions(command, options.read);
    addPartOptions(command, options.shaping);
    command.add_flag("--check", options.checkInterfaces,
                     "also of meshes of millions of cells: tell whether cells overlap or do not fit together");
}

void addPictureOptions(CLI::App& command, RenderOptions& options) {
    addColorOptions(command, options.colors);
    addParsed(command, "--mode", options.settings.mode, parseMode, modeNames(), "MODE");
    addParsed(
        command, "--background", options.background,
        [&options](const std::string& option, const std::string& text) {
            const auto background = parseBackground(option, text);
            options.png.alpha = !background;
            return background;
        },
        "colour put under the picture last; none: nothing, and a PNG has alpha; default: black under a PNG, nothing "
        "under "
        "an EXR",
        "r,g,b|none");
    addNumber<int>(
        command, "--bits", options.png.bits, [](double value) { return value == 8.0 || value == 16.0; }, "8 or 16",
        "of each channel of a PNG, 8 or 16");
}

void addLight(CLI::App& command, RenderOptions& options) {
    addLightOptions(command, options.settings.shading);
    command
        .add_option_function<std::string>(
            "--keep-anisotropy",
            [&options](const std::string& path) {
                if (std::filesystem::path(path).extension() != ".vtu")
                    throw std::runtime_error(
                        fmt::format("--keep-anisotropy: '{}' does not end in .vtu; give a name that does", path));
                options.keptAnisotropy = path;
            },
            "also write the mesh with its anisotropy, which render then takes up instead of computing it")
        ->type_name("FILE.vtu");
}

void addShape(CLI::App& command, RenderOptions& options) {
    addShapeOptions(command, options.shape, options.settings);
}

void addViewOptions(CLI::App& command, RenderOptions& options) {
    addCameraOptions(command, options.camera);
    addNumber<int>(
        command, "--samples", options.settings.samples, [](double value) { return value >= 1.0 && value <= 64.0; },
        "a whole number from 1 to 64",
        "anti-aliasing: so many rays per pixel, on a regular grid (the next square number: 4, 9, 16 … 64), are "
        "averaged");
}

void addMachineOptions(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--engine", options.engine.engine,
                    fmt::format("what draws: auto, {}", fmt::join(projection::engineNames(), ", ")))
        ->type_name("NAME");
    command.add_option("--context", options.engine.context, "OpenGL context: auto, egl, osmesa")->type_name("NAME");
    command
        .add_option("--gl-path", options.engine.glPath,
                    fmt::format("who sets cells up for OpenGL, the processor or the GPU, and who draws them: {}",
                                fmt::join(projection::glPathNames(), ", ")))
        ->type_name("PATH");
    addParsed(command, "--order", options.settings.order, parseOrder,
              "how cells are put in order, for measuring: auto (certain), graph (certain, no keys), centroid (wrong in "
              "places, which are counted)",
              "ORDER");
    addNumber<int>(command, "--threads", options.settings.threads, positive, "a whole number from 1",
                   "processor threads; default: all");
    command.add_flag_callback(
        "--no-early-termination", [&options] { options.settings.earlyTermination = false; },
        "for measuring: draw also what lies behind opaque pixels; the picture is the same");
    command.add_flag_callback(
        "--no-skip-invisible", [&options] { options.settings.skipInvisible = false; },
        "for measuring: draw also cells that the transfer function hides; the picture is the same");
    addParsed(command, "--integration", options.settings.everyNode, parseIntegration,
              "cpu: auto (of more than 64 nodes, runs that a line meets within 1e-5 are one) or exact (every node)",
              "auto|exact");
    addNumber<double>(
        command, "--table-error", options.settings.table.wantedError, positive, "a number above 0",
        "largest error of a pre-integration table, 1e-4; a table that misses it says so on standard error and in the "
        "report");
    addNumber<int>(
        command, "--table-size", options.settings.table.size,
        [](double value) { return value >= 2.0 && value <= 8192.0; }, "a whole number from 2 to 8192",
        "texels along a table's side; default: found from --table-error");
}

void addOutputOptions(CLI::App& command, RenderOptions& options) {
    command
        .add_option(
            "-o,--output", options.output,
            "picture to write, - for standard output (PNG): .png or .exr (32-bit float RGBA), or with --frames or "
            "--times a film: .mp4 .mov .mkv .webm .avi .gif (by ffmpeg)")
        ->type_name("FILE")
        ->required();
    addNumber<int>(
        command, "--frames", options.frames, [](double value) { return value >= 1.0 && value <= 1e6; },
        "a whole number from 1", "an orbit of so many pictures: OUT_0000.png, OUT_0001.png, ...");
    addTimeOptions(command, options.time);
    addNumber<double>(
        command, "--preview", options.previewMilliseconds, positive, "milliseconds above 0",
        "first a quick picture, OUT_preview.png, whose frame takes no longer than so many milliseconds: fewer "
        "pixels, a coarser mesh if need be");
    addNumber<int>(
        command, "--verify", options.verifiedPixels, positive, "a whole number from 1",
        "measure the error: compute so many pixels (1000) of each frame again by the reference, with a 95 % bound for "
        "all of them")
        ->expected(0, 1)
        ->default_str(std::to_string(usualVerifiedPixels))
        ->type_name("N");
    addNumber<double>(command, "--max-error", options.maxError, notNegative, "a number from 0",
                      "end with status 3 unless the rmse of all pixels is vouched for (95 % bound of --verify; without "
                      "it, as many pixels are computed again as that takes: nearly all)");
    command.add_option("--report", options.report, "JSON file with cells, times and memory; -: standard output")
        ->type_name("FILE.json");
    command.add_flag("--quiet", options.quiet, "nothing on standard output, no progress bar");
}

}  // namespace

void addRenderOptions(CLI::App& command, RenderOptions& options) {
    command.add_option("MESH", options.source, "mesh file, or bucky:N, coulomb:N, marschner-lobb:N, hydrogen:N")
        ->required();
    using Section = void (*)(CLI::App&, RenderOptions&);
    const std::pair<const char*, Section> sections[] = {
        {"Output", addOutputOptions},
        {"Mesh", addMeshOptions},
        {"Picture", addPictureOptions},
        {"Light", addLight},
        {"Shape", addShape},
        {"In the volume", [](CLI::App& c, RenderOptions& o) { addOpaqueOptions(c, o.opaque); }},
        {"Annotation", [](CLI::App& c, RenderOptions& o) { addAnnotationOptions(c, o.annotation); }},
        {"Camera", addViewOptions},
        {"Machine", addMachineOptions}};
    for (const auto& [title, add] : sections) {
        command.option_defaults()->group(title);
        add(command, options);
    }
    command.parse_complete_callback([&options] {
        if (options.maxError && options.verifiedPixels == 0) {
            const auto pixels =
                static_cast<std::size_t>(options.camera.size.x) * static_cast<std::size_t>(options.camera.size.y);
            const std::size_t needed = projection::pixelsToVouchFor(*options.maxError, pixels);
            options.verifiedPixels = std::max(static_cast<int>(needed), usualVerifiedPixels);
        }
    });
}

}  // namespace tetralux::apps
