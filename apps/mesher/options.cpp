// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <stdexcept>

#include "file_name.h"

namespace tetralux::mesher {
namespace {

void check(const Options& options) {
    const auto refuse = [](bool wrong, const std::string& what) {
        if (wrong) throw std::runtime_error(what);
    };
    refuse(lowerEnding(options.output) != ".vtu",
           fmt::format("-o {}: the output is a .vtu file: give it that ending", options.output));
    refuse(options.quality != 0.0 && !(options.quality >= 1.0 && options.quality <= 100.0),
           "--quality must lie between 1 and 100 (1.2 is fine, 2 is usual), or be 0 for none");
    refuse(!(options.maxVolume >= 0.0) || !std::isfinite(options.maxVolume), "--max-volume must be a positive number");
    refuse(options.maxFieldError && !(*options.maxFieldError >= 0.0),
           "--max-field-error must be 0 or more (0.01 is 1 % of the range)");
    refuse(!(options.surfaceTolerance >= 0.0 && options.surfaceTolerance <= 0.1),
           "--surface-tolerance must lie between 0 and 0.1");
    refuse(!(options.timeLimit > 0.0), "--time-limit must be a positive number of seconds");
}

}  // namespace

std::optional<Options> parseCommandLine(int argumentCount, char** arguments) {
    Options options;
    CLI::App app("Turns a closed surface, a cloud of points with values, or any other mesh into tetrahedra.",
                 "tetralux mesh");
    app.add_option("INPUT", options.input,
                   "surface: .stl .off .ply .obj .vtp; points with values: .csv .xyz .txt .vtp .ply; or any mesh that "
                   "'tetralux info' reads")
        ->required();
    app.add_option("-o,--output", options.output, "the .vtu file to write")->required();
    app.add_flag("--repair", options.repair, "mend the surface where that is safe, and say what was done");
    app.add_option("--quality", options.quality, "surface: largest circumradius to shortest edge ratio; 0: none")
        ->capture_default_str();
    app.add_option("--max-volume", options.maxVolume, "surface: largest volume of a tetrahedron");
    app.add_flag("--keep-surface", options.keepSurface, "surface: add no points on it");
    app.add_flag("--points", options.points, "take the points of a surface alone, as a cloud");
    app.add_option("--method", options.method, "points: cgal or tetgen")
        ->check(CLI::IsMember({"cgal", "tetgen"}))
        ->capture_default_str();
    app.add_option("--field", options.fields,
                   "add a field: x, y, z, radius, distance (to the surface), FORMULA of these and of the fields there "
                   "are, or NAME=FORMULA; "
                   "repeatable");
    app.add_option("--target-cells", options.targetCells,
                   "coarsen to this many tetrahedra, and report the field's error");
    app.add_option("--max-field-error", options.maxFieldError,
                   "coarsen no further than this part of a field's range (0.01: 1 %)");
    app.add_option("--surface-tolerance", options.surfaceTolerance,
                   "coarsening may move the surface by this part of the diagonal; 0: it stays as it is");
    app.add_option("--time-limit", options.timeLimit, "seconds after which to give up")->capture_default_str();
    app.add_option("--report", options.report, "write what was found and done to this JSON file");
    app.add_flag("--quiet", options.quiet, "print nothing but errors");
    app.failure_message(CLI::FailureMessage::simple);
    try {
        app.parse(argumentCount, arguments);
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(fmt::format("{}; see 'tetralux mesh --help'", error.what()));
    }
    check(options);
    return options;
}

}  // namespace tetralux::mesher
