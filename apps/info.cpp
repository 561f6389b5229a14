// SPDX-License-Identifier: Apache-2.0
//
// tetralux info: what a mesh holds, for people or (--json) for machines.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <apps/commands.h>
#include <apps/histogram_plot.h>
#include <apps/plot.h>
#include <apps/read_options.h>
#include <apps/report_text.h>
#include <mesh/io/read_mesh.h>
#include <mesh/soup/mesh_shaping.h>
#include <mesh/tet/mesh_statistics.h>

namespace tetralux::apps {

namespace {

struct InfoOptions {
    std::string source;
    mesh::ReadOptions read;
    bool json = false;
    std::string histogram;  ///< file; empty: none
    std::string scalar;     ///< of the histogram; empty: the first
    bool logarithmic = false;
};

struct Findings {
    mesh::MeshReport report;  ///< of reading, with the defects that the statistics found
    mesh::MeshStatistics statistics;
    mesh::TetMesh mesh;
    std::vector<double> times;        ///< of all steps of a series
    std::vector<std::string> blocks;  ///< names and numbers of its parts
};

Findings findingsOf(const InfoOptions& options) {
    mesh::ReadResult source = mesh::readMesh(options.source, options.read);
    std::vector<std::string> blocks = mesh::blockList(source);
    Findings findings{source.report, mesh::meshStatistics(source.mesh), std::move(source.mesh), source.times,
                      std::move(blocks)};
    // What reading has counted already is kept: it speaks of the cells of the file.
    findings.report.defects.insert(findings.statistics.defects.begin(), findings.statistics.defects.end());
    return findings;
}

const char* placeName(mesh::Association association) {
    return association == mesh::Association::Point ? "points" : "cells";
}

nlohmann::json vectorJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

nlohmann::json fieldJson(const mesh::FieldStatistics& field) {
    return {{"name", field.name},
            {"on", placeName(field.association)},
            {"components", field.components},
            {"component_names", field.componentNames},
            {"bookkeeping", field.bookkeeping},
            {"min", field.low},
            {"max", field.high},
            {"mean", field.mean},
            {"values", field.values},
            {"non_finite", field.nonFinite},
            {"histogram", field.histogram}};
}

nlohmann::json infoJson(const InfoOptions& options, const Findings& found) {
    const mesh::MeshStatistics& all = found.statistics;
    nlohmann::json fields = nlohmann::json::array();
    for (const mesh::FieldStatistics& field : all.fields) fields.push_back(fieldJson(field));
    return {{"mesh", options.source},
            {"points", all.points},
            {"points_merged", found.report.pointsMerged},
            {"faces_fitted", found.report.facesFitted},
            {"cells",
             {{"read", found.report.cellsRead}, {"types", found.report.cellTypes}, {"skipped", found.report.skipped}}},
            {"tetrahedra", all.cells},
            {"bounds", {{"low", vectorJson(all.bounds.low)}, {"high", vectorJson(all.bounds.high)}}},
            {"volume", {{"total", all.volume}, {"smallest", all.smallestVolume}, {"largest", all.largestVolume}}},
            {"faces",
             {{"inner", all.innerFaces}, {"boundary", all.boundaryFaces}, {"delaunay_share", all.delaunayShare()}}},
            {"components", {{"count", all.components}, {"largest", all.largestComponent}}},
            {"notes", found.report.notes},
            {"times", found.times},
            {"blocks", found.blocks},
            {"memory_bytes", all.memoryBytes},
            {"fields", fields},
            {"defects", defectsJson(found.report)}};
}

/// A histogram in one line of 16 characters, empty for a constant field.
std::string sketch(const std::vector<std::uint64_t>& histogram) {
    constexpr std::size_t columns = 16;
    constexpr const char* heights[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    if (histogram.size() % columns != 0 || histogram.empty()) return "";
    std::uint64_t sums[columns] = {};
    for (std::size_t i = 0; i < histogram.size(); ++i) sums[i * columns / histogram.size()] += histogram[i];
    const std::uint64_t largest = std::max<std::uint64_t>(1, *std::max_element(std::begin(sums), std::end(sums)));
    std::string line;
    // Rounded up: what is there at all shows.
    for (const std::uint64_t sum : sums) line += heights[(sum * 8 + largest - 1) / largest];
    return fmt::format("  |{}|", line);
}

std::string componentsText(const mesh::FieldStatistics& field) {
    if (field.components == 1) return "";
    const std::string names =
        field.componentNames.empty() ? "" : fmt::format(" ({})", fmt::join(field.componentNames, ", "));
    return fmt::format(", {} components{}, magnitude", field.components, names);
}

void printField(const mesh::FieldStatistics& field) {
    fmt::print("  {} on {}{}: {:.6g} to {:.6g}, mean {:.6g}{}", field.name, placeName(field.association),
               componentsText(field), field.low, field.high, field.mean, sketch(field.histogram));
    if (field.nonFinite > 0) fmt::print(" ({} values are NaN or infinite)", field.nonFinite);
    if (field.bookkeeping) fmt::print(" (bookkeeping)");
    fmt::print("\n");
}

/// How many, and their times by number: "21, times 0: 0, 1: 0.05, …".
std::string stepsText(const std::vector<double>& times) {
    constexpr std::size_t shown = 24;
    std::string text = fmt::format("{}, by number and time", times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times.size() > shown && i == shown / 2) text += " ...";
        if (times.size() > shown && i >= shown / 2 && i + shown / 2 < times.size()) continue;
        text += fmt::format("{} {}: {:.6g}", i == 0 ? "" : ",", i, times[i]);
    }
    return text;
}

void printInfo(const InfoOptions& options, const Findings& found) {
    const mesh::MeshStatistics& all = found.statistics;
    const mesh::BoundingBox& box = all.bounds;
    fmt::print("{}\n", options.source);
    for (const auto& [type, count] : found.report.cellTypes) fmt::print("cells: {} {}\n", count, type);
    for (const auto& [reason, count] : found.report.skipped) fmt::print("left out: {} ({})\n", count, reason);
    for (const std::string& note : found.report.notes) fmt::print("note: {}\n", note);
    fmt::print("tetrahedra: {} in {} connected component{}\n", all.cells, all.components,
               all.components == 1 ? "" : fmt::format("s, the largest of {}", all.largestComponent));
    fmt::print("points: {}\n", all.points);
    fmt::print("bounds: {:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}\n", box.low.x, box.low.y, box.low.z, box.high.x,
               box.high.y, box.high.z);
    fmt::print("volume: {:.6g}, cells from {:.3g} to {:.3g}\n", all.volume, all.smallestVolume, all.largestVolume);
    fmt::print("faces: {} inner ({:.1f} % Delaunay), {} on the boundary\n", all.innerFaces, 100.0 * all.delaunayShare(),
               all.boundaryFaces);
    if (found.report.facesFitted > 0)
        fmt::print("fitted: {} quadrilaterals cut as the two triangles on their other side\n",
                   found.report.facesFitted);
    if (found.report.pointsMerged > 0) fmt::print("merged: {} points with an equal one\n", found.report.pointsMerged);
    fmt::print("memory: {:.1f} MiB\n", static_cast<double>(all.memoryBytes) / (1024.0 * 1024.0));
    if (!found.times.empty()) fmt::print("steps: {}\n", stepsText(found.times));
    if (!found.blocks.empty()) fmt::print("blocks: {}\n", fmt::join(found.blocks, ", "));
    fmt::print("fields:{}\n", all.fields.empty() ? " none" : "");
    for (const mesh::FieldStatistics& field : all.fields) printField(field);
    const auto defects = defectLines(found.report);
    fmt::print("defects:{}\n", defects.empty() ? " none" : "");
    for (const std::string& line : defects) fmt::print("  {}\n", line);
}

/// Of the scalar as `render` takes it.
void drawHistogram(const InfoOptions& options, mesh::TetMesh mesh) {
    mesh::ScalarSelection selected;
    try {
        mesh::MeshReport ignored;
        selected = mesh::selectScalar(std::move(mesh), options.scalar, ignored);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options.source, error.what()));
    }
    writeHistogram(
        {fmt::format("{} of {}", selected.fieldName, std::filesystem::path(options.source).filename().string()),
         selected.fieldName, selected.mesh.association, mesh::histogramOf(selected.mesh.scalars), options.logarithmic},
        options.histogram);
}

int info(const InfoOptions& options) {
    if (options.histogram.empty() && (options.logarithmic || !options.scalar.empty()))
        throw std::runtime_error(
            fmt::format("{}: only the histogram depends on it; leave it out, or give --histogram FILE.png",
                        options.logarithmic ? "--histogram-log" : "--scalar"));
    if (!options.histogram.empty()) checkPlotPath(options.histogram);
    Findings found = findingsOf(options);
    if (!options.histogram.empty()) drawHistogram(options, std::move(found.mesh));
    if (options.json)
        fmt::print("{}", jsonText(infoJson(options, found)));
    else
        printInfo(options, found);
    return 0;
}

}  // namespace

void addInfoCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command = program.add_subcommand("info", "cells, fields, ranges and faults of a mesh");
    command->add_option("MESH", options->source, "mesh file or generated field")->required();
    addReadOptions(*command, options->read);
    command->add_flag("--json", options->json, "for machines");
    command->add_option("--histogram", options->histogram, "draw how often which value occurs: FILE.png or FILE.svg")
        ->type_name("FILE");
    command
        ->add_option("--scalar", options->scalar,
                     "field of the histogram: NAME (vectors by magnitude) or NAME:x; default: the first")
        ->type_name("NAME");
    command->add_flag("--histogram-log", options->logarithmic, "counts on a logarithmic axis");
    command->callback([options, &chosen] { chosen = [options] { return info(*options); }; });
}

}  // namespace tetralux::apps
