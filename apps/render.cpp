// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: one image, or an orbit of them.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <apps/commands.h>
#include <apps/film/film_writer.h>
#include <apps/progress.h>
#include <apps/render_options.h>
#include <apps/render_report.h>
#include <apps/render_scene.h>
#include <apps/report/warning.h>
#include <apps/report_text.h>
#include <projection/image/image.h>
#include <projection/image/whole_file.h>

namespace tetralux::apps {

namespace {

constexpr int errorTooLarge = 3;  // the picture is whole and on disk, but not as exact as --max-error wants it

/// "OUT.png" with `addition` before the dot.
std::string outputPath(const RenderOptions& options, const std::string& addition) {
    std::filesystem::path path(options.output);
    path.replace_filename(path.stem().string() + addition + path.extension().string());
    return path.string();
}

/// Standard output in the place of a file.
bool isStandardOutput(const std::string& path) {
    return path == "-";
}

void writeOut(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        throw std::runtime_error("standard output: cannot be written; see where it goes");
}

void put(const projection::Image& image, const std::string& path, const projection::PngOutput& png) {
    if (isStandardOutput(path))
        writeOut(projection::imageFile(image, "-.png", png));
    else
        projection::writeImage(image, path, png);
}

bool makesMany(const RenderOptions& options) {
    return options.frames.has_value() || !options.time.times.empty();
}

/// OUT.png, or OUT_0000.png and so on; a film is one file.
std::vector<std::string> outputPaths(const RenderOptions& options, std::size_t count) {
    if (!makesMany(options) || isFilm(options.output)) return {options.output};
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < count; ++i) paths.push_back(outputPath(options, fmt::format("_{:04}", i)));
    return paths;
}

/// OUT_preview.png; empty when none is asked for.
std::string previewPath(const RenderOptions& options) {
    if (options.previewMilliseconds <= 0.0) return "";
    if (makesMany(options))
        throw std::runtime_error(
            "--preview: goes with one picture, not with --frames or --times; leave one of them out");
    return outputPath(options, "_preview");
}

/// What goes together, and everything that could keep the results from being written, shows before the work.
void checkOutputs(const RenderOptions& options) {
    if (options.frames && !options.time.times.empty())
        throw std::runtime_error("--times and --frames: each says which pictures there are; give one of them");
    if (options.read.time && !options.time.times.empty())
        throw std::runtime_error("--times and --time: each says which step is drawn; give one of them");
    const bool toOutput = isStandardOutput(options.output);
    if (toOutput && (makesMany(options) || options.previewMilliseconds > 0.0 || isStandardOutput(options.report)))
        throw std::runtime_error(
            "-o -: standard output holds one picture; give files for the others, or leave them out");
    if (toOutput) {
        // there is no file to look after
    } else if (isFilm(options.output)) {
        if (!makesMany(options))
            throw std::runtime_error(
                fmt::format("{}: a film needs pictures; give --frames N or --times all, or OUT.png", options.output));
        checkFilm(options.output);
    } else {
        for (const std::string& path :
             outputPaths(options, options.frames ? static_cast<std::size_t>(*options.frames) : 1))
            projection::checkImagePath(path);
    }
    if (!options.report.empty() && !isStandardOutput(options.report)) projection::checkWritable(options.report);
}

void tellPreview(const std::string& path, const RenderOptions& options, const projection::Preview& preview) {
    fmt::print("{}: {}x{} pixels{}, {:.0f} ms of {:g} promised{}\n", path, preview.width, preview.height,
               preview.gridPoints > 0 ? fmt::format(" of a coarse mesh ({0}x{0}x{0} points)", preview.gridPoints) : "",
               preview.frameMilliseconds, options.previewMilliseconds,
               preview.kept ? "" : ": even the least takes longer here");
}

std::string verificationLine(const projection::Verification& found) {
    const std::string seen = fmt::format("error against the reference: rmse {:.2g}, max {:.2g} in {} of {} pixels",
                                         found.rmse, found.max, found.pixels, found.allPixels);
    if (found.unseen() == 0) return seen;
    return fmt::format("{}; {} were not seen, of which at most {} differ by more (95 % sure: rmse not above {:.2g})",
                       seen, found.unseen(), found.unseenWorse, found.rmseBound);
}

/// On standard error, --quiet or not: the table is less exact than was asked for, and what comes of it.
void warnOfTable(const projection::Engine& engine) {
    const preint::PreintegrationTable* table = engine.table();
    if (table == nullptr || table->measuredError <= engine.wantedTableError()) return;
    warn(fmt::format("--table-error {:g}: a table of this transfer function has an error of {:.2g}; {}",
                     engine.wantedTableError(), table->measuredError,
                     engine.walksNodes() ? "every segment is walked along node by node instead, which takes longer"
                                         : "leave --table-size out"));
}

/// What --max-error has to say of a picture that it cannot vouch for.
std::string errorTooLargeLine(double maxError, const projection::Verification& found) {
    const bool seenTooLarge = !(found.rmse <= maxError);
    const std::size_t needed = projection::pixelsToVouchFor(maxError, found.allPixels, found.largest);
    const std::string more = seenTooLarge || found.pixels >= needed
                                 ? "see --table-error for tables and --engine reference for the truth"
                                 : fmt::format("{} of {} pixels were not seen: --verify {} could tell", found.unseen(),
                                               found.allPixels, needed);
    return fmt::format(
        "--max-error {:g}: the rmse is {:.2g}, the largest error {:.2g} in {} pixels, and that of all may be "
        "{:.2g} (95 % sure: not more); {}",
        maxError, found.rmse, found.max, found.pixels, found.rmseBound, more);
}

/// Which step of a series was drawn; of several the range.
std::string stepText(const RenderOptions& options, const RenderRecord& record) {
    if (!record.step || !options.time.times.empty()) return "";
    return fmt::format("time {:.6g} (step {} of {}, from 0), ", record.step->time, record.step->number,
                       record.step->count);
}

/// A time that is far from any step: the nearest was drawn.
void warnOfTime(const RenderOptions& options, const SceneRenderer& renderer) {
    const std::vector<double>& times = renderer.times();
    if (!options.read.time) return;
    if (times.empty()) {
        warn(fmt::format("--time {:g}: {} has no steps; it is drawn as it is", *options.read.time, options.source));
        return;
    }
    const auto [low, high] = std::minmax_element(times.begin(), times.end());
    const double slack = 1e-6 * (*high - *low);
    if (*options.read.time < *low - slack || *options.read.time > *high + slack)
        warn(fmt::format("--time {:g}: outside the series, which goes from {:g} to {:g}; drawn is {:g}",
                         *options.read.time, *low, *high, renderer.record().step->time));
}

void tell(const RenderOptions& options, const std::vector<std::string>& paths, const SceneRenderer& renderer) {
    const RenderRecord& record = renderer.record();
    for (const std::string& note : record.mesh.notes) fmt::print("{}: {}\n", options.source, note);
    for (const std::string& line : defectLines(record.mesh)) fmt::print("{}: {}\n", options.source, line);
    if (!record.interfacesChecked)
        fmt::print("{}: not checked whether cells overlap or do not fit together; --check does it\n", options.source);
    for (const auto& [reason, count] : record.mesh.skipped)
        if (reason.starts_with("not solid")) fmt::print("{}: left out: {} {}\n", options.source, count, reason);
    if (record.verification) fmt::print("{}\n", verificationLine(*record.verification));
    const projection::FrameReport& first = record.frames.front();
    double total = 0.0;
    for (const projection::FrameReport& frame : record.frames) total += frame.frameMilliseconds;
    const bool many = record.frames.size() > 1;
    fmt::print("{}{}: {}{}x{}, {}{} of {} tetrahedra, {} ({}), {:.0f} ms{}\n", paths.front(),
               paths.size() > 1 ? " to " + paths.back() : "",
               many ? fmt::format("{} pictures, ", record.frames.size()) : "", record.camera.width,
               record.camera.height, stepText(options, record), first.cellsDrawn, record.tetrahedra,
               renderer.engine().name(), renderer.engine().renderer(),
               total / static_cast<double>(record.frames.size()), many ? " a frame" : "");
}

/// Draws and writes every picture that is asked for. \returns the files.
std::vector<std::string> drawAll(const RenderOptions& options, SceneRenderer& renderer) {
    std::vector<std::size_t> steps;
    if (!options.time.times.empty()) {
        try {
            steps = chosenSteps(options.time, renderer.times().size());
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fmt::format("{}: {}", options.source, error.what()));
        }
    }
    const std::size_t count = !steps.empty() ? steps.size() : static_cast<std::size_t>(options.frames.value_or(1));
    const std::vector<std::string> paths = outputPaths(options, count);
    std::optional<FilmWriter> film;
    if (isFilm(options.output))
        film.emplace(options.output, options.camera.size.x, options.camera.size.y, options.time.framesPerSecond);
    ProgressBar progress(static_cast<int>(count), count > 1 && !options.quiet);
    for (std::size_t i = 0; i < count; ++i) {
        if (!steps.empty()) renderer.moveTo(steps[i]);
        const double turn = options.frames ? static_cast<double>(i) / static_cast<double>(count) : 0.0;
        const projection::Image image = renderer.render(turn);
        if (film)
            film->add(image);
        else
            put(image, paths[i], options.png);
        progress.show(static_cast<int>(i) + 1);
    }
    if (film) film->finish();
    return paths;
}

int render(const RenderOptions& given) {
    RenderOptions options = given;
    options.quiet = options.quiet || isStandardOutput(options.output) || isStandardOutput(options.report);
    std::optional<tbb::global_control> threadLimit;
    if (options.settings.threads > 0)
        threadLimit.emplace(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(options.settings.threads));

    checkOutputs(options);
    const std::string preview = previewPath(options);
    if (!preview.empty()) projection::checkImagePath(preview);
    SceneRenderer renderer(options);
    if (!preview.empty()) {
        projection::writeImage(renderer.preview(options.previewMilliseconds), preview, options.png);
        if (!options.quiet) tellPreview(preview, options, *renderer.record().preview);
    }
    const std::vector<std::string> paths = drawAll(options, renderer);
    if (!options.report.empty()) {
        const std::string report = jsonText(renderReport(options, renderer));
        if (isStandardOutput(options.report))
            writeOut(report);
        else
            projection::writeWholeFile(options.report, report);
    }
    if (!options.quiet) tell(options, paths, renderer);
    if (!renderer.record().emptyBecause.empty())
        warn(fmt::format("{}: nothing shows in {}: {}", options.source,
                         renderer.record().frames.size() > 1 ? "a frame" : "the picture",
                         renderer.record().emptyBecause));
    warnOfTime(options, renderer);
    if (const std::string advice = renderer.advice(); !advice.empty())
        warn(fmt::format("{}: {}", options.source, advice));
    warnOfTable(renderer.engine());
    if (withinMaxError(options, renderer.record())) return 0;
    fmt::print(stderr, "tetralux: {}\n", errorTooLargeLine(*options.maxError, *renderer.record().verification));
    return errorTooLarge;
}

}  // namespace

void addRenderCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = program.add_subcommand("render", "one picture of a mesh, or an orbit of pictures");
    addRenderOptions(*command, *options);
    command->callback([options, &chosen] {
        finishShapeOptions(options->shape, options->settings);
        chosen = [options] { return render(*options); };
    });
}

}  // namespace tetralux::apps
