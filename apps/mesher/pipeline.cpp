// SPDX-License-Identifier: Apache-2.0
#include "pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include <mesh/io/write_vtu.h>

#include "generated_field.h"
#include "mesh_points.h"
#include "mesh_surface.h"
#include "polydata_vtk.h"
#include "read_input.h"
#include "simplify.h"
#include "tet_assembly.h"

namespace tetralux::mesher {
namespace {

/// A cloud or a surface becomes tetrahedra; errors get the input's name.
mesh::TetMesh meshSoup(PolygonSoup&& soup, const Options& options, const Deadline& deadline, const Listener& listener,
                       nlohmann::json& report) {
    try {
        if (soup.points.empty()) throw std::runtime_error("no points are in it");
        if (soup.polygons.empty() || options.points)
            return meshPoints(std::move(soup), options, deadline, listener, report);
        return meshSurface(triangulatePolygons(soup), options, deadline, listener, report);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options.input, error.what()));
    }
}

/// A mesh that was read as cells, with what reading found said aloud.
mesh::TetMesh cellsOf(mesh::ReadResult&& read, const Listener& listener, nlohmann::json& report) {
    std::string types;
    for (const auto& [type, count] : read.report.cellTypes)
        types += fmt::format("{}{} {}", types.empty() ? "" : ", ", count, type);
    if (!types.empty()) listener.note("cells read: " + types);
    for (const auto& [defect, found] : read.report.defects) {
        listener.note(fmt::format("found: {} {}", found.count, mesh::defectName(defect)));
        report["defects"].push_back(fmt::format("{} {}", found.count, mesh::defectName(defect)));
    }
    return std::move(read.mesh);
}

void addFields(mesh::TetMesh& mesh, const Options& options, const Listener& listener) {
    for (const std::string& field : options.fields) {
        listener.stage("computing " + field);
        addGeneratedField(mesh, field);
    }
    if (!mesh.fields.empty()) return;
    listener.stage("computing distance");
    addGeneratedField(mesh, "distance");
    listener.note("field distance: to the surface, as the input has no values (--field gives others)");
}

void coarsen(mesh::TetMesh& mesh, const Options& options, const Deadline& deadline, const Listener& listener,
             nlohmann::json& report) {
    if (options.targetCells == 0 && !options.maxFieldError) return;
    listener.stage("coarsening");
    SimplifyOptions bounds;
    bounds.targetCells = options.targetCells;
    bounds.maxFieldError = options.maxFieldError.value_or(std::numeric_limits<double>::infinity());
    bounds.surfaceTolerance = options.surfaceTolerance;
    bounds.deadline = deadline;
    SimplifyReport done;
    try {
        done = simplify(mesh, bounds);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options.input, error.what()));
    }
    listener.note(fmt::format(
        "coarsened from {} to {} tetrahedra; largest error {:.3g} of the field's range (rms {:.3g}) at the points "
        "of the fine mesh; surface moved by {:.3g}",
        done.cellsBefore, mesh.cells.size(), done.maxError, done.rmsError, done.surfaceDeviation));
    if (options.targetCells > 0 && mesh.cells.size() > options.targetCells)
        listener.note(fmt::format("{} tetrahedra were asked for: {}", options.targetCells, done.stopReason));
    report["coarsening"] = {{"cells_before", done.cellsBefore},           {"cells", mesh.cells.size()},
                            {"max_field_error", done.maxError},           {"rms_field_error", done.rmsError},
                            {"surface_deviation", done.surfaceDeviation}, {"stopped_by", done.stopReason}};
}

void accountFor(const mesh::TetMesh& mesh, const Listener& listener, nlohmann::json& report) {
    double volume = 0.0, smallest = std::numeric_limits<double>::max();
    for (const auto& c : mesh.cells) {
        const double v =
            mesh::sixVolumes(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]], mesh.positions[c[3]]) /
            6.0;
        volume += v;
        smallest = std::min(smallest, v);
    }
    listener.note(
        fmt::format("{} tetrahedra, {} points, volume {:.9g}, smallest cell {:.3g}, worst radius-edge ratio {:.3g}",
                    mesh.cells.size(), mesh.positions.size(), volume, smallest, worstRadiusEdgeRatio(mesh)));
    report["cells"] = mesh.cells.size();
    report["points"] = mesh.positions.size();
    report["volume"] = volume;
    report["smallest_cell"] = smallest;
    report["worst_radius_edge_ratio"] = worstRadiusEdgeRatio(mesh);
    for (const mesh::Field& field : mesh.fields) {
        if (field.components == 1 && !field.values.empty()) {
            const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
            listener.note(fmt::format("field {}: {:.6g} to {:.6g}", field.name, *low, *high));
        }
        report["fields"].push_back(field.name);
    }
}

}  // namespace

nlohmann::json makeMesh(const Options& options, const std::string& temporary, const Deadline& deadline,
                        const Listener& listener) {
    nlohmann::json report;
    report["input"] = options.input;
    listener.stage("reading");
    std::vector<std::string> leftOut;
    Input input = readInput(options.input, leftOut);
    for (const std::string& name : leftOut)
        listener.note(fmt::format(
            "left out: field {}, as its values are on polygons; only those on points are carried inward", name));
    report["fields_left_out"] = leftOut;
    mesh::TetMesh mesh = std::holds_alternative<mesh::ReadResult>(input)
                             ? cellsOf(std::get<mesh::ReadResult>(std::move(input)), listener, report)
                             : meshSoup(std::get<PolygonSoup>(std::move(input)), options, deadline, listener, report);
    addFields(mesh, options, listener);
    coarsen(mesh, options, deadline, listener, report);
    accountFor(mesh, listener, report);
    listener.stage("writing");
    try {
        mesh::writeVtu(temporary, mesh);
    } catch (const std::runtime_error&) {
        throw std::runtime_error(
            fmt::format("{}: the mesh cannot be written there: is there room on the disk?", options.output));
    }
    return report;
}

}  // namespace tetralux::mesher
