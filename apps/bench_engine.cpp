// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_engine.h>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <apps/bench_memory.h>
#include <apps/bench_scene.h>
#include <apps/bench_statistics.h>
#include <apps/option_values.h>
#include <apps/stopwatch.h>
#include <projection/frame/engine_registry.h>

namespace tetralux::apps {

namespace {

using projection::Engine;
using projection::FrameReport;
using projection::Image;

/// Processor time of all threads of this process so far.
double processorMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Errors of libraries are one line, but not everybody's.
std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void describeEngine(const Engine& engine, double prepareMilliseconds, BenchRow& row) {
    row.renderer = engine.renderer();
    row.prepareMilliseconds = engine.prepareMilliseconds();
    row.prepareTotalMilliseconds = prepareMilliseconds;
    if (const preint::PreintegrationTable* table = engine.table()) {
        row.tableSize = table->size;
        row.tableSlices = table->slices;
        row.tableError = table->measuredError;
        row.tableMilliseconds = table->buildMilliseconds;
    }
}

void describeFirstFrame(const FrameReport& report, BenchRow& row) {
    row.cellsDrawn = report.cellsDrawn;
    row.cellsSkipped = report.cellsSkipped;
    row.cellsSorted = report.cellsSorted;
    row.fragments = report.fragments;
    row.orderMethod = report.orderMethod;
    row.bytesUploaded = report.bytesUploaded;
    row.tileEntries = report.tileEntries;
    row.tileEntriesSaved = report.tileEntriesSaved;
}

/// Medians by stage; a frame without a stage has spent nothing on it.
std::map<std::string, double> stageMedians(const std::vector<FrameReport>& reports) {
    std::map<std::string, std::vector<double>> byStage;
    for (const FrameReport& report : reports)
        for (const auto& [stage, milliseconds] : report.stageMilliseconds) byStage[stage].push_back(milliseconds);
    std::map<std::string, double> medians;
    for (auto& [stage, values] : byStage) {
        values.resize(reports.size());
        medians[stage] = median(values);
    }
    return medians;
}

void describeFrames(const std::vector<FrameReport>& reports, BenchRow& row) {
    describeFirstFrame(reports.front(), row);
    row.dataPath = reports.back().dataPath;  // where it is chosen by measurement, it is chosen by then
    row.stageMilliseconds = stageMedians(reports);
}

/// The largest resident memory while an engine works, without what the benchmark itself needs between frames.
class EngineMemory {
public:
    EngineMemory() : before_(trimmedMemoryBytes()) { restartPeakMemory(); }

    /// What was in use since the last `resume`.
    void pause() { peak_ = std::max(peak_, peakMemoryBytes()); }
    void resume() {
        trimmedMemoryBytes();
        restartPeakMemory();
    }
    void tell(BenchRow& row) const {
        row.peakMemoryBytes = peak_;
        row.memoryOverMeshBytes = peak_ - std::min(before_, peak_);
    }

private:
    std::uint64_t before_, peak_ = 0;
};

/// Warm-up and timed frames of one size. Comparing is neither on the clock nor in the memory.
void drawFrames(Engine& engine, const projection::Scene& scene, const ReferenceImages& reference, const FramePlan& plan,
                EngineMemory& memory, BenchRow& row) {
    const glm::ivec2 size(row.subject.width, row.subject.height);
    std::vector<FrameReport> reports;
    double spent = 0.0;
    const auto draw = [&](int frame) {
        FrameReport report;
        const projection::Camera camera = benchCamera(scene.mesh->bounds, size, frame);
        const double processorBefore = processorMilliseconds();
        const Stopwatch watch;
        Image image = engine.render(camera, report);
        const double milliseconds = watch.milliseconds();
        spent += milliseconds;
        return std::tuple(std::move(image), std::move(report), milliseconds, processorMilliseconds() - processorBefore);
    };
    draw(-1);
    for (int frame = 0; frame < plan.frames; ++frame) {
        if (frame > 0 && spent > 1000.0 * plan.budgetSeconds) break;
        auto [image, report, milliseconds, processor] = draw(frame);
        row.frameMilliseconds.push_back(milliseconds);
        row.processorMilliseconds.push_back(processor);
        row.pixelsRepaired += report.pixelsRepaired;
        if (static_cast<std::size_t>(frame) < reference.images.size()) {
            memory.pause();
            judgeFrame(row, reference, static_cast<std::size_t>(frame), image);
            memory.resume();
        }
        reports.push_back(std::move(report));
    }
    describeFrames(reports, row);
}

projection::Scene withChoice(projection::Scene scene, const EngineChoice& choice) {
    scene.settings.threads = choice.threads;
    scene.settings.table.size = choice.tableSize;
    if (choice.tableError > 0.0) scene.settings.table.wantedError = choice.tableError;
    scene.settings.order = choice.order;
    scene.settings.everyNode = choice.everyNode;
    scene.settings.skipInvisible = choice.skipInvisible;
    scene.settings.earlyTermination = choice.earlyTermination;
    return scene;
}

std::vector<BenchRow> emptyRows(const EngineChoice& choice, const std::vector<BenchSubject>& subjects) {
    std::vector<BenchRow> rows;
    for (const BenchSubject& subject : subjects) {
        BenchRow& row = rows.emplace_back();
        row.subject = subject;
        row.engine = choice.name();
        row.setting = choice.setting();
    }
    return rows;
}

}  // namespace

std::string EngineChoice::name() const {
    return options.context == "auto" ? options.engine : fmt::format("{}:{}", options.engine, options.context);
}

std::string EngineChoice::setting() const {
    std::vector<std::string> parts;
    if (tableSize > 0) parts.push_back(fmt::format("table {}", tableSize));
    if (tableError > 0.0) parts.push_back(fmt::format("error {:g}", tableError));
    if (order != projection::OrderMethod::Auto) parts.push_back(orderName(order));
    if (everyNode) parts.emplace_back("every node");
    if (options.glPath != "auto") parts.push_back(options.glPath);
    if (!skipInvisible) parts.emplace_back("all cells");
    if (!earlyTermination) parts.emplace_back("to the end");
    if (threads > 0) parts.push_back(fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"));
    return fmt::format("{}", fmt::join(parts, ", "));
}

void judgeFrame(BenchRow& row, const ReferenceImages& reference, std::size_t frame, const Image& image) {
    const projection::ImageDifference difference = projection::compareImages(image, reference.images[frame]);
    row.error.rmse = std::max(row.error.rmse, difference.rmse);
    row.error.max = std::max(row.error.max, difference.max);
    row.error.percentile999 = std::max(row.error.percentile999, difference.percentile999);
    row.error.psnr = row.judged ? std::min(row.error.psnr, difference.psnr) : difference.psnr;
    row.judged = true;
}

ReferenceImages judge(const projection::Scene& scene, const BenchSubject& subject, const FramePlan& plan) {
    ReferenceImages result;
    result.row.subject = subject;
    result.row.engine = "reference";
    EngineMemory memory;
    const Stopwatch preparing;
    const auto engine = projection::makeEngine(scene, {.engine = "reference"});
    describeEngine(*engine, preparing.milliseconds(), result.row);
    std::vector<FrameReport> reports;
    for (int frame = 0; frame < plan.judged; ++frame) {
        const Stopwatch watch;
        result.images.push_back(engine->render(benchCamera(scene.mesh->bounds, {subject.width, subject.height}, frame),
                                               reports.emplace_back()));
        result.row.frameMilliseconds.push_back(watch.milliseconds());
    }
    describeFrames(reports, result.row);
    memory.pause();
    memory.tell(result.row);
    result.row.judged = true;
    return result;
}

std::vector<BenchRow> measureEngine(const projection::Scene& scene, const EngineChoice& choice,
                                    const std::vector<BenchSubject>& subjects,
                                    const std::vector<ReferenceImages>& references, const FramePlan& plan) {
    std::vector<BenchRow> rows = emptyRows(choice, subjects);
    std::optional<tbb::global_control> threadLimit;
    if (choice.threads > 0)
        threadLimit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(choice.threads));
    EngineMemory memory;
    std::unique_ptr<Engine> engine;
    std::size_t done = 0;
    try {
        const Stopwatch preparing;
        engine = projection::makeEngine(withChoice(scene, choice), choice.options);
        if (choice.asksForTable() && engine->table() == nullptr) return {};  // there is nothing to set
        const double prepareMilliseconds = preparing.milliseconds();
        memory.pause();
        for (; done < rows.size(); ++done) {
            BenchRow& row = rows[done];
            describeEngine(*engine, prepareMilliseconds, row);
            EngineMemory ofThisSize = memory;  // preparing counts for all
            drawFrames(*engine, scene, references[done], plan, ofThisSize, row);
            ofThisSize.pause();
            ofThisSize.tell(row);
            memory.resume();
        }
    } catch (const std::exception& error) {
        for (; done < rows.size(); ++done) rows[done].failure = oneLine(error.what());
    }
    return rows;
}

}  // namespace tetralux::apps
