// SPDX-License-Identifier: Apache-2.0
//
// tetralux info: what a mesh holds, for people or (--json) for machines.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <apps/commands.h>
#include <apps/read_options.h>
#include <apps/report_text.h>
#include <mesh/read_mesh.h>

namespace tetralux::apps {

namespace {

struct InfoOptions {
    std::string source;
    mesh::ReadOptions read;
    bool json = false;
};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    std::uint64_t nonFinite = 0;
};

/// Of one component over all values; what is not finite is counted instead.
Range componentRange(const mesh::Field& field, int component) {
    Range range;
    for (std::size_t i = static_cast<std::size_t>(component); i < field.values.size();
         i += static_cast<std::size_t>(field.components)) {
        if (!std::isfinite(field.values[i])) {
            ++range.nonFinite;
            continue;
        }
        range.low = std::min(range.low, field.values[i]);
        range.high = std::max(range.high, field.values[i]);
    }
    return range;
}

const char* placeName(mesh::Association association) {
    return association == mesh::Association::Point ? "points" : "cells";
}

nlohmann::json infoJson(const InfoOptions& options, const mesh::ReadResult& found) {
    const mesh::BoundingBox bounds = mesh::usedBounds(found.mesh.positions, found.mesh.cells);
    nlohmann::json result = {
        {"mesh", options.source},
        {"points", found.mesh.positions.size()},
        {"cells",
         {{"read", found.report.cellsRead}, {"types", found.report.cellTypes}, {"skipped", found.report.skipped}}},
        {"tetrahedra", found.mesh.cells.size()},
        {"bounds",
         {{"low", {bounds.low.x, bounds.low.y, bounds.low.z}},
          {"high", {bounds.high.x, bounds.high.y, bounds.high.z}}}},
        {"fields", nlohmann::json::array()},
        {"defects", defectsJson(found.report)}};
    for (const mesh::Field& field : found.mesh.fields) {
        nlohmann::json ranges = nlohmann::json::array();
        std::uint64_t nonFinite = 0;
        for (int component = 0; component < field.components; ++component) {
            const Range range = componentRange(field, component);
            ranges.push_back({range.low, range.high});
            nonFinite += range.nonFinite;
        }
        result["fields"].push_back({{"name", field.name},
                                    {"on", placeName(field.association)},
                                    {"components", field.components},
                                    {"range", ranges},
                                    {"non_finite", nonFinite}});
    }
    return result;
}

void printField(const mesh::Field& field) {
    fmt::print("  {} on {}", field.name, placeName(field.association));
    std::uint64_t nonFinite = 0;
    for (int component = 0; component < field.components; ++component) {
        const Range range = componentRange(field, component);
        nonFinite += range.nonFinite;
        fmt::print("{} {:.6g} to {:.6g}", component == 0 ? ":" : ",", range.low, range.high);
    }
    if (nonFinite > 0) fmt::print(" ({} values are NaN or infinite)", nonFinite);
    fmt::print("\n");
}

void printInfo(const InfoOptions& options, const mesh::ReadResult& found) {
    const mesh::BoundingBox bounds = mesh::usedBounds(found.mesh.positions, found.mesh.cells);
    fmt::print("{}\n", options.source);
    for (const auto& [type, count] : found.report.cellTypes) fmt::print("cells: {} {}\n", count, type);
    fmt::print("tetrahedra: {}\npoints: {}\n", found.mesh.cells.size(), found.mesh.positions.size());
    fmt::print("bounds: {:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}\n", bounds.low.x, bounds.low.y, bounds.low.z,
               bounds.high.x, bounds.high.y, bounds.high.z);
    fmt::print("fields:{}\n", found.mesh.fields.empty() ? " none" : "");
    for (const mesh::Field& field : found.mesh.fields) printField(field);
    for (const auto& [reason, count] : found.report.skipped) fmt::print("left out: {} ({})\n", count, reason);
    const auto defects = defectLines(found.report);
    fmt::print("defects:{}\n", defects.empty() ? " none" : "");
    for (const std::string& line : defects) fmt::print("  {}\n", line);
}

int info(const InfoOptions& options) {
    const mesh::ReadResult found = mesh::readMesh(options.source, options.read);
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
    command->callback([options, &chosen] { chosen = [options] { return info(*options); }; });
}

}  // namespace tetralux::apps
