// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_output.h>

#include <algorithm>
#include <functional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tetralux::apps {

namespace {

using nlohmann::json;

/// Subjects in the order of their first row.
std::vector<BenchSubject> subjectsOf(const std::vector<BenchRow>& rows) {
    std::vector<BenchSubject> subjects;
    for (const BenchRow& row : rows)
        if (std::find(subjects.begin(), subjects.end(), row.subject) == subjects.end()) subjects.push_back(row.subject);
    return subjects;
}

std::string placeTitle(const BenchSubject& subject) {
    return fmt::format("{}  {}x{}", subject.scene, subject.width, subject.height);
}
std::string whatTitle(const BenchSubject& subject) {
    return fmt::format("{}  {}", subject.transferFunction, subject.mode);
}
std::string subjectTitle(const BenchSubject& subject) {
    return placeTitle(subject) + "  " + whatTitle(subject);
}

/// One row of panels for each scene and size, one column for each transfer function and mode, if a page is wide enough
/// for them; else as many as it takes, in full rows if that can be.
int plotColumns(std::size_t functions, std::size_t panels) {
    constexpr std::size_t most = 4;
    const std::size_t wanted = functions > 1 ? functions : std::min<std::size_t>(3, panels);
    if (wanted <= most) return static_cast<int>(std::max<std::size_t>(wanted, 1));
    for (std::size_t columns = most; columns > 1; --columns)
        if (wanted % columns == 0) return static_cast<int>(columns);
    return static_cast<int>(most);
}

/// "1.9M", "150k"
std::string shortCount(double value) {
    if (value >= 1e9) return fmt::format("{:.3g}G", value / 1e9);
    if (value >= 1e6) return fmt::format("{:.3g}M", value / 1e6);
    if (value >= 1e3) return fmt::format("{:.3g}k", value / 1e3);
    return fmt::format("{:.3g}", value);
}

/// Four digits at most before and three after the point.
std::string shortTime(double milliseconds) {
    return milliseconds >= 100.0 ? fmt::format("{:.0f}", milliseconds) : fmt::format("{:.3g}", milliseconds);
}

template <class Value>
std::string listed(const std::map<std::string, Value>& values, const char* format) {
    std::string text;
    for (const auto& [name, value] : values)
        text += fmt::format("{}{}={}", text.empty() ? "" : ";", name, fmt::format(fmt::runtime(format), value));
    return text;
}

std::string stagesText(const BenchRow& row) {
    std::string text;
    for (const auto& [stage, milliseconds] : row.stageMilliseconds)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", stage, shortTime(milliseconds));
    return text;
}

std::string tableText(const BenchRow& row) {
    if (row.tableSize == 0) return "";
    const std::string slices = row.tableSlices > 1 ? fmt::format("x{}", row.tableSlices) : "";
    return fmt::format("; table {0}x{0}{1}, error {2:.1e}", row.tableSize, slices, row.tableError);
}

/// What was left out and which share of its stage that saved.
std::string savedText(const BenchRow& row) {
    std::string text;
    auto add = [&](const std::string& what, std::uint64_t saved, std::uint64_t whole) {
        if (saved > 0)
            text += fmt::format("{}{} {:.0f} %", text.empty() ? "; left out: " : ", ", what,
                                100.0 * static_cast<double>(saved) / static_cast<double>(whole));
    };
    for (const auto& [reason, cells] : row.cellsSkipped) add("cells " + reason, cells, row.subject.tetrahedra);
    add("behind opaque tiles", row.tileEntriesSaved, row.tileEntries);
    if (row.orderMethod == "none") text += text.empty() ? "; left out: sort" : ", sort";
    return text;
}

std::string nameAndSetting(const BenchRow& row) {
    return row.setting.empty() ? row.engine : fmt::format("{}, {}", row.engine, row.setting);
}

std::string tableLine(const BenchRow& row) {
    const std::string name = fmt::format("{} {:<26}", row.onFront ? '*' : ' ', nameAndSetting(row));
    if (!row.failure.empty()) return fmt::format("{} not measured: {}\n", name, row.failure);
    const std::string error =
        row.judged ? fmt::format("{:>9.2e} {:>9.2e} {:>9.2e}", row.error.rmse, row.error.max, row.error.percentile999)
                   : fmt::format("{:>9} {:>9} {:>9}", "-", "-", "-");
    return fmt::format("{} {:>8} {:>8} {:>8} {} {:>7} {:>7} {:>6.0f} {:>6.0f} {:>8}  {}\n", name,
                       shortTime(row.medianMilliseconds()), shortTime(row.leastMilliseconds()),
                       shortTime(row.medianProcessorMilliseconds()), error, shortCount(row.tetrahedraPerSecond()),
                       shortCount(row.fragmentsPerSecond()), row.bytesPerTetrahedron(),
                       static_cast<double>(row.peakMemoryBytes) / 1048576.0, shortTime(row.prepareTotalMilliseconds),
                       stagesText(row) + tableText(row) + savedText(row));
}

bool isVtk(const BenchRow& row) {
    return row.engine.starts_with("vtk:");
}

/// "cpu is 12.3 times as fast as vtk:projected, at 0.0001 times its rmse"; empty unless both sides have figures.
std::string comparisonLine(const std::vector<BenchRow>& rows, const BenchSubject& subject) {
    const BenchRow* ours = nullptr;
    const BenchRow* theirs = nullptr;
    for (const BenchRow& row : rows) {
        if (row.subject != subject || !row.failure.empty() || !row.judged || row.engine == "reference") continue;
        const BenchRow*& fastest = isVtk(row) ? theirs : ours;
        if (fastest == nullptr || row.medianMilliseconds() < fastest->medianMilliseconds()) fastest = &row;
    }
    if (ours == nullptr || theirs == nullptr) return "";
    return fmt::format("  {} is {:.1f} times as fast as {}, at {:.2g} times its rmse\n", nameAndSetting(*ours),
                       theirs->medianMilliseconds() / ours->medianMilliseconds(), theirs->engine,
                       ours->error.rmse / theirs->error.rmse);
}

struct Column {
    const char* name;
    std::function<std::string(const BenchRow&)> text;
};

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

/// Every value as CSV holds it; the first line of the file names them.
const std::vector<Column>& columns() {
    static const std::vector<Column> all{
        {"scene", [](const BenchRow& r) { return r.subject.scene; }},
        {"tetrahedra", [](const BenchRow& r) { return fmt::to_string(r.subject.tetrahedra); }},
        {"width", [](const BenchRow& r) { return fmt::to_string(r.subject.width); }},
        {"height", [](const BenchRow& r) { return fmt::to_string(r.subject.height); }},
        {"tf", [](const BenchRow& r) { return r.subject.transferFunction; }},
        {"mode", [](const BenchRow& r) { return r.subject.mode; }},
        {"engine", [](const BenchRow& r) { return r.engine; }},
        {"setting", [](const BenchRow& r) { return r.setting; }},
        {"renderer", [](const BenchRow& r) { return r.renderer; }},
        {"frames", [](const BenchRow& r) { return fmt::to_string(r.frameMilliseconds.size()); }},
        {"ms_median", [](const BenchRow& r) { return number(r.medianMilliseconds()); }},
        {"ms_least", [](const BenchRow& r) { return number(r.leastMilliseconds()); }},
        {"ms_processor", [](const BenchRow& r) { return number(r.medianProcessorMilliseconds()); }},
        {"ms_stages", [](const BenchRow& r) { return listed(r.stageMilliseconds, "{:.4g}"); }},
        {"ms_prepare", [](const BenchRow& r) { return number(r.prepareTotalMilliseconds); }},
        {"ms_prepare_parts", [](const BenchRow& r) { return listed(r.prepareMilliseconds, "{:.4g}"); }},
        {"rmse", [](const BenchRow& r) { return r.judged ? number(r.error.rmse) : ""; }},
        {"max", [](const BenchRow& r) { return r.judged ? number(r.error.max) : ""; }},
        {"p99.9", [](const BenchRow& r) { return r.judged ? number(r.error.percentile999) : ""; }},
        {"pareto", [](const BenchRow& r) { return fmt::to_string(r.onFront ? 1 : 0); }},
        {"tetrahedra_per_s", [](const BenchRow& r) { return number(r.tetrahedraPerSecond()); }},
        {"fragments", [](const BenchRow& r) { return fmt::to_string(r.fragments); }},
        {"fragments_per_s", [](const BenchRow& r) { return number(r.fragmentsPerSecond()); }},
        {"cells_drawn", [](const BenchRow& r) { return fmt::to_string(r.cellsDrawn); }},
        {"cells_skipped", [](const BenchRow& r) { return listed(r.cellsSkipped, "{}"); }},
        {"tile_entries", [](const BenchRow& r) { return fmt::to_string(r.tileEntries); }},
        {"tile_entries_saved", [](const BenchRow& r) { return fmt::to_string(r.tileEntriesSaved); }},
        {"cells_sorted", [](const BenchRow& r) { return fmt::to_string(r.cellsSorted); }},
        {"order", [](const BenchRow& r) { return r.orderMethod; }},
        {"gl_path", [](const BenchRow& r) { return r.dataPath; }},
        {"bytes_uploaded", [](const BenchRow& r) { return fmt::to_string(r.bytesUploaded); }},
        {"pixels_repaired", [](const BenchRow& r) { return fmt::to_string(r.pixelsRepaired); }},
        {"table_size", [](const BenchRow& r) { return fmt::to_string(r.tableSize); }},
        {"table_slices", [](const BenchRow& r) { return fmt::to_string(r.tableSlices); }},
        {"table_error", [](const BenchRow& r) { return number(r.tableError); }},
        {"table_ms", [](const BenchRow& r) { return number(r.tableMilliseconds); }},
        {"peak_memory_bytes", [](const BenchRow& r) { return fmt::to_string(r.peakMemoryBytes); }},
        {"memory_over_mesh_bytes", [](const BenchRow& r) { return fmt::to_string(r.memoryOverMeshBytes); }},
        {"failure", [](const BenchRow& r) { return r.failure; }},
    };
    return all;
}

/// As RFC 4180 has it.
std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return quoted + '"';
}

json rowJson(const BenchRow& row) {
    json result = {{"scene", row.subject.scene},
                   {"tetrahedra", row.subject.tetrahedra},
                   {"size", {row.subject.width, row.subject.height}},
                   {"tf", row.subject.transferFunction},
                   {"mode", row.subject.mode},
                   {"engine", row.engine},
                   {"setting", row.setting}};
    if (!row.failure.empty()) {
        result["failure"] = row.failure;
        return result;
    }
    result["renderer"] = row.renderer;
    result["ms"] = {{"median", row.medianMilliseconds()},      {"frame", row.frameMilliseconds},
                    {"processor", row.processorMilliseconds},  {"stages", row.stageMilliseconds},
                    {"prepare", row.prepareTotalMilliseconds}, {"prepare_parts", row.prepareMilliseconds}};
    if (row.judged)
        result["error"] = {{"rmse", row.error.rmse}, {"max", row.error.max}, {"p99.9", row.error.percentile999}};
    result["pareto"] = row.onFront;
    result["tetrahedra_per_s"] = row.tetrahedraPerSecond();
    result["fragments"] = row.fragments;
    result["fragments_per_s"] = row.fragmentsPerSecond();
    result["cells"] = {{"drawn", row.cellsDrawn}, {"skipped", row.cellsSkipped}, {"sorted", row.cellsSorted}};
    result["tiles"] = {{"entries", row.tileEntries}, {"entries_saved", row.tileEntriesSaved}};
    result["order"] = row.orderMethod;
    if (!row.dataPath.empty()) result["gl"] = {{"path", row.dataPath}, {"bytes_uploaded", row.bytesUploaded}};
    result["pixels_repaired"] = row.pixelsRepaired;
    if (row.tableSize > 0)
        result["table"] = {{"size", row.tableSize},
                           {"slices", row.tableSlices},
                           {"error", row.tableError},
                           {"ms", row.tableMilliseconds}};
    result["memory"] = {{"peak_bytes", row.peakMemoryBytes}, {"over_mesh_bytes", row.memoryOverMeshBytes}};
    return result;
}

std::string pointNote(const BenchRow& row) {
    return fmt::format("{}: {} ms, rmse {:.2g}, max {:.2g}", nameAndSetting(row), shortTime(row.medianMilliseconds()),
                       row.error.rmse, row.error.max);
}

}  // namespace

std::string benchTable(const std::vector<BenchRow>& rows) {
    std::string text;
    for (const BenchSubject& subject : subjectsOf(rows)) {
        text += fmt::format("\n{}  {} tetrahedra\n", subjectTitle(subject), subject.tetrahedra);
        text += fmt::format("  {:<26} {:>8} {:>8} {:>8} {:>9} {:>9} {:>9} {:>7} {:>7} {:>6} {:>6} {:>8}  {}\n",
                            "engine", "ms", "least", "cpu ms", "rmse", "max", "p99.9", "tets/s", "frags/s", "B/tet",
                            "MiB", "prepare", "ms by stage");
        for (const BenchRow& row : rows)
            if (row.subject == subject) text += tableLine(row);
        text += comparisonLine(rows, subject);
    }
    return text;
}

std::string benchCsv(const std::vector<BenchRow>& rows) {
    std::string text;
    for (const Column& column : columns()) text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
    text += '\n';
    for (const BenchRow& row : rows) {
        const char* separator = "";
        for (const Column& column : columns()) {
            text += separator;
            text += csvField(column.text(row));
            separator = ",";
        }
        text += '\n';
    }
    return text;
}

json benchJson(const json& machine, const std::vector<BenchRow>& rows) {
    json result = {{"machine", machine}, {"rows", json::array()}};
    for (const BenchRow& row : rows) result["rows"].push_back(rowJson(row));
    return result;
}

Plot benchPlot(const std::vector<BenchRow>& rows) {
    Plot plot;
    plot.xLabel = "ms a frame, camera moved";
    plot.yLabel = "rmse against the reference";
    std::vector<BenchRow> shown;
    for (const BenchRow& row : rows)
        if (row.failure.empty() && row.judged && row.engine != "reference") shown.push_back(row);
    for (const BenchRow& row : shown)
        if (std::find(plot.series.begin(), plot.series.end(), row.engine) == plot.series.end())
            plot.series.push_back(row.engine);
    const std::vector<BenchSubject> subjects = subjectsOf(shown);
    std::set<std::string> places, functions;
    for (const BenchSubject& subject : subjects) {
        places.insert(placeTitle(subject));
        functions.insert(whatTitle(subject));
    }
    // what all panels share stands above them, once
    const bool onePlace = places.size() == 1;
    plot.title = fmt::format("{}Error against time: lower left is better, the stairs are the Pareto front",
                             onePlace ? *places.begin() + ".  " : "");
    for (const BenchSubject& subject : subjects) {
        PlotPanel& panel = plot.panels.emplace_back();
        panel.title = onePlace ? whatTitle(subject) : subjectTitle(subject);
        for (const BenchRow& row : shown) {
            if (row.subject != subject) continue;
            const auto series = std::find(plot.series.begin(), plot.series.end(), row.engine) - plot.series.begin();
            panel.points.push_back(
                {row.medianMilliseconds(), row.error.rmse, static_cast<int>(series), row.onFront, pointNote(row)});
        }
    }
    plot.columns = plotColumns(functions.size(), plot.panels.size());
    return plot;
}

}  // namespace tetralux::apps
