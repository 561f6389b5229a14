// SPDX-License-Identifier: Apache-2.0
//
// tetralux render: one image, or an orbit of them.
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
#include <apps/progress.h>
#include <apps/render_options.h>
#include <apps/render_report.h>
#include <apps/render_scene.h>
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

/// OUT.png, or OUT_0000.png and so on.
std::vector<std::string> outputPaths(const RenderOptions& options) {
    if (!options.frames) return {options.output};
    std::vector<std::string> paths;
    for (int i = 0; i < *options.frames; ++i) paths.push_back(outputPath(options, fmt::format("_{:04}", i)));
    return paths;
}

/// OUT_preview.png; empty when none is asked for.
std::string previewPath(const RenderOptions& options) {
    if (options.previewMilliseconds <= 0.0) return "";
    if (options.frames)
        throw std::runtime_error("--preview: goes with one picture, not with --frames; leave one of them out");
    return outputPath(options, "_preview");
}

/// Everything that could keep the results from being written must show before the work, not after.
void checkOutputs(const RenderOptions& options, const std::vector<std::string>& paths) {
    for (const std::string& path : paths) projection::checkImagePath(path);
    if (!options.report.empty()) projection::checkWritable(options.report);
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
    fmt::print(stderr, "tetralux: --table-error {:g}: a table of this transfer function has an error of {:.2g}; {}\n",
               engine.wantedTableError(), table->measuredError,
               engine.walksNodes() ? "every segment is walked along node by node instead, which takes longer"
                                   : "leave --table-size out");
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
    fmt::print("{}{}: {}x{}, {} of {} tetrahedra, {} ({}), {:.0f} ms{}\n", paths.front(),
               paths.size() > 1 ? " to " + paths.back() : "", record.camera.width, record.camera.height,
               first.cellsDrawn, record.tetrahedra, renderer.engine().name(), renderer.engine().renderer(),
               total / static_cast<double>(record.frames.size()), paths.size() > 1 ? " a frame" : "");
}

int render(const RenderOptions& options) {
    std::optional<tbb::global_control> threadLimit;
    if (options.settings.threads > 0)
        threadLimit.emplace(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(options.settings.threads));

    const std::vector<std::string> paths = outputPaths(options);
    const std::string preview = previewPath(options);
    checkOutputs(options, paths);
    if (!preview.empty()) projection::checkImagePath(preview);
    SceneRenderer renderer(options);
    if (!preview.empty()) {
        projection::writeImage(renderer.preview(options.previewMilliseconds), preview);
        if (!options.quiet) tellPreview(preview, options, *renderer.record().preview);
    }
    {
        ProgressBar progress(static_cast<int>(paths.size()), paths.size() > 1 && !options.quiet);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            projection::writeImage(renderer.render(static_cast<double>(i) / static_cast<double>(paths.size())),
                                   paths[i]);
            progress.show(static_cast<int>(i) + 1);
        }
    }
    if (!options.report.empty()) projection::writeWholeFile(options.report, jsonText(renderReport(options, renderer)));
    if (!options.quiet) tell(options, paths, renderer);
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
