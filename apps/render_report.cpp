// SPDX-License-Identifier: Apache-2.0
#include <apps/render_report.h>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include <apps/option_values.h>
#include <apps/report_text.h>
#include <projection/frame/sampled_engine.h>

namespace tetralux::apps {

bool withinMaxError(const RenderOptions& options, const RenderRecord& record) {
    return !options.maxError || record.verification->rmseBound <= *options.maxError;
}

namespace {

using nlohmann::json;
using projection::FrameReport;

std::uint64_t peakMemoryBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

json vectorJson(const glm::dvec3& v) {
    return json::array({v.x, v.y, v.z});
}

/// Source cells and tetrahedra that were left out before drawing, and by the first frame.
json skippedCells(const RenderRecord& record, const FrameReport& first) {
    std::map<std::string, std::uint64_t> skipped = record.mesh.skipped;
    for (const auto& [reason, count] : first.cellsSkipped) skipped[reason] += count;
    return skipped;
}

/// Wall times of every frame, whole and by stage; a frame without a stage has 0 there.
json timesJson(const RenderRecord& record, const projection::Engine& engine) {
    json times = {{"read", record.readMilliseconds},
                  {"check", record.checkMilliseconds},
                  {"prepare", record.prepareMilliseconds}};
    for (const auto& [stage, milliseconds] : engine.prepareMilliseconds()) times["prepare " + stage] = milliseconds;
    json frame = json::array();
    std::map<std::string, std::vector<double>> stages;
    for (std::size_t i = 0; i < record.frames.size(); ++i) {
        frame.push_back(record.frames[i].frameMilliseconds);
        for (const auto& [stage, milliseconds] : record.frames[i].stageMilliseconds) {
            stages[stage].resize(record.frames.size());
            stages[stage][i] = milliseconds;
        }
    }
    times["frame"] = std::move(frame);
    for (const auto& [stage, milliseconds] : stages)
        if (!times.contains(stage)) times[stage] = milliseconds;
    return times;
}

json tableJson(const preint::PreintegrationTable& table, const projection::Engine& engine) {
    return {{"wanted_error", engine.wantedTableError()},
            {"within", table.measuredError <= engine.wantedTableError()},
            {"used", !engine.walksNodes()},
            {"size", table.size},
            {"slices", table.slices},
            {"zones", table.zones.size()},
            {"measured_error", table.measuredError},
            {"build_ms", table.buildMilliseconds}};
}

json verificationJson(const projection::Verification& found) {
    return {{"pixels", found.pixels},        {"unseen", found.unseen()}, {"rmse", found.rmse},
            {"rmse_bound", found.rmseBound}, {"max", found.max},         {"unseen_share", found.unseenShare()}};
}

json previewJson(const projection::Preview& preview, double promised) {
    return {{"promised_ms", promised},
            {"frame_ms", preview.frameMilliseconds},
            {"kept", preview.kept},
            {"size", {preview.width, preview.height}},
            {"grid", preview.gridPoints}};
}

/// Of the last frame, by when a path that is chosen by measurement is; and how many frames took each.
json glJson(const RenderRecord& record) {
    const FrameReport& last = record.frames.back();
    json frames = json::object();
    for (const FrameReport& frame : record.frames) frames[frame.dataPath] = frames.value(frame.dataPath, 0) + 1;
    return {{"path", last.dataPath},
            {"why", last.dataPathReason},
            {"bytes_uploaded", last.bytesUploaded},
            {"frames", frames}};
}

/// How many frames sorted anew, kept the last frame's order or repaired it.
json incrementalSortJson(const RenderRecord& record) {
    json counts = json::object();
    for (const FrameReport& frame : record.frames)
        counts[frame.incrementalSort] = counts.value(frame.incrementalSort, 0) + 1;
    return counts;
}

json cameraJson(const projection::Camera& camera) {
    json result = {
        {"eye", vectorJson(camera.eye)}, {"target", vectorJson(camera.target)}, {"up", vectorJson(camera.up)}};
    if (camera.orthographic())
        result["height"] = camera.orthographicHeight;
    else
        result["fov"] = camera.fovDegrees;
    return result;
}

}  // namespace

json renderReport(const RenderOptions& options, const SceneRenderer& renderer) {
    const RenderRecord& record = renderer.record();
    const projection::Engine& engine = renderer.engine();
    const FrameReport first = record.frames.empty() ? FrameReport{} : record.frames.front();
    std::uint64_t repaired = 0, wrong = 0;
    json because = json::object();
    for (const FrameReport& frame : record.frames) {
        repaired += frame.pixelsRepaired;
        for (const auto& [reason, count] : frame.repairedBecause)
            because[reason] = because.value(reason, std::uint64_t{0}) + count;
        wrong += frame.pixelsWrong;
    }
    const int perAxis = projection::samplesPerAxis(options.settings.samples);
    json report = {
        {"tetralux", TETRALUX_VERSION},
        {"mesh", options.source},
        {"scalar", {{"name", record.fieldName}, {"min", record.scalarMin}, {"max", record.scalarMax}}},
        {"mode", modeName(options.settings.mode)},
        {"size", {record.camera.width, record.camera.height}},
        {"samples", perAxis * perAxis},
        {"camera", cameraJson(record.camera)},
        {"engine", engine.name()},
        {"renderer", engine.renderer()},
        {"cells",
         {{"read", record.mesh.cellsRead},
          {"types", record.mesh.cellTypes},
          {"tetrahedra", record.tetrahedra},
          {"drawn", first.cellsDrawn},
          {"skipped", skippedCells(record, first)}}},
        {"points_merged", record.mesh.pointsMerged},
        {"notes", record.mesh.notes},
        {"defects", defectsJson(record.mesh)},
        {"interfaces_checked", record.interfacesChecked},
        {"order",
         {{"method", first.orderMethod},
          {"sorted", first.cellsSorted},
          {"cyclic", first.orderCycles},
          {"failing_faces", first.failingFaces},
          {"frames", incrementalSortJson(record)}}},
        {"fragments", first.fragments},
        {"tiles",
         {{"retired", first.tilesRetired}, {"entries", first.tileEntries}, {"entries_saved", first.tileEntriesSaved}}},
        {"ms", timesJson(record, engine)},
        {"pixels", {{"repaired", repaired}, {"because", because}, {"wrong", wrong}}},
        {"peak_memory_bytes", peakMemoryBytes()},
    };
    if (record.step)
        report["time"] = {{"drawn", record.step->time}, {"step", record.step->number}, {"steps", renderer.times()}};
    if (record.mostContributions) report["contributions"] = {{"most", *record.mostContributions}};
    if (!first.dataPath.empty()) report["gl"] = glJson(record);
    if (record.verification) report["verification"] = verificationJson(*record.verification);
    if (options.maxError) {
        report["verification"]["max_error"] = *options.maxError;
        report["verification"]["within"] = withinMaxError(options, record);
        const projection::Verification& found = *record.verification;
        report["verification"]["pixels_needed"] =
            projection::pixelsToVouchFor(*options.maxError, found.allPixels, found.largest);
    }
    if (record.preview) report["preview"] = previewJson(*record.preview, options.previewMilliseconds);
    if (const auto* table = engine.table()) report["table"] = tableJson(*table, engine);
    return report;
}

}  // namespace tetralux::apps
