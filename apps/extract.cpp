// SPDX-License-Identifier: Apache-2.0
//
// tetralux extract: an isosurface, a slice or the boundary of a mesh as a file of triangles.
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/add_option.h>
#include <apps/commands.h>
#include <apps/opaque_options.h>
#include <apps/option_values.h>
#include <apps/read_options.h>
#include <mesh/io/read_mesh.h>
#include <mesh/tet/field_surface.h>
#include <mesh/tet/mesh_cut.h>
#include <projection/image/whole_file.h>

namespace tetralux::apps {

namespace {

struct ExtractOptions {
    std::string source, output;
    std::string scalar;
    mesh::ReadOptions read;
    std::optional<double> isosurface;
    std::optional<projection::Slice> slice;
    bool boundary = false;
    bool quiet = false;
};

mesh::MeshCut cutIsosurface(const mesh::TetMesh& mesh, const ExtractOptions& options) {
    mesh::MeshReport ignored;
    mesh::TetMesh copy = mesh;
    const mesh::ScalarSelection selected = mesh::selectScalar(std::move(copy), options.scalar, ignored);
    if (selected.mesh.association == mesh::Association::Cell)
        throw std::runtime_error(
            fmt::format("field '{}' is constant in every cell, so that no isosurface runs through any; give "
                        "--smooth-cells, which makes it linear, or a field on points with --scalar",
                        selected.fieldName));
    mesh::MeshCut cut = mesh::cutAtLevel(mesh.positions, mesh.cells, selected.mesh.scalars, *options.isosurface);
    if (cut.triangles.empty())
        throw std::runtime_error(
            fmt::format("--isosurface {}: field '{}' does not cross it, it goes from {} to {}; give a value between",
                        *options.isosurface, selected.fieldName, selected.mesh.scalarMin, selected.mesh.scalarMax));
    return cut;
}

mesh::MeshCut cutSlice(const mesh::TetMesh& mesh, const projection::Slice& slice) {
    mesh::MeshCut cut = mesh::cutAtPlane(mesh.positions, mesh.cells, slice.point, slice.normal);
    if (cut.triangles.empty()) {
        const mesh::BoundingBox box = mesh::usedBounds(mesh.positions, mesh.cells);
        throw std::runtime_error(fmt::format(
            "--slice: the plane through {},{},{} misses the mesh; give a point within {},{},{} and {},{},{}",
            slice.point.x, slice.point.y, slice.point.z, box.low.x, box.low.y, box.low.z, box.high.x, box.high.y,
            box.high.z));
    }
    return cut;
}

mesh::MeshCut cutFor(const mesh::TetMesh& mesh, const ExtractOptions& options) {
    if (mesh.cells.empty())
        throw std::runtime_error("the mesh has no cell to cut; give a mesh with at least one solid cell");
    if (options.isosurface) return cutIsosurface(mesh, options);
    if (options.slice) return cutSlice(mesh, *options.slice);
    return mesh::boundaryFaces(mesh.cells, mesh.positions.size());
}

void checkChoice(const ExtractOptions& options) {
    const int asked = (options.isosurface ? 1 : 0) + (options.slice ? 1 : 0) + (options.boundary ? 1 : 0);
    if (asked != 1)
        throw std::runtime_error(
            fmt::format("extract: {} surfaces asked for; give one of --isosurface, --slice and --boundary", asked));
    if (!options.scalar.empty() && !options.isosurface)
        throw std::runtime_error(
            "--scalar: only an isosurface depends on it, all fields are carried on; leave it out, or give "
            "--isosurface");
}

void tell(const ExtractOptions& options, const mesh::FieldSurface& surface) {
    const mesh::SurfaceMeasure measured = mesh::measure(surface);
    fmt::print("{}: {} triangles, {} points, area {:.10g}, ", options.output, surface.triangles.size(),
               surface.positions.size(), measured.area);
    if (measured.openEdges == 0)
        fmt::print("closed, encloses {:.10g}\n", measured.volume);
    else
        fmt::print("{} open edges\n", measured.openEdges);
}

int extract(const ExtractOptions& options) {
    checkChoice(options);
    const mesh::SurfaceFormat format = mesh::surfaceFormat(options.output);
    projection::checkWritable(options.output);
    const mesh::ReadResult source = mesh::readMesh(options.source, options.read);
    mesh::FieldSurface surface;
    try {
        surface = mesh::surfaceOf(source.mesh, cutFor(source.mesh, options));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options.source, error.what()));
    }
    std::string file;
    try {
        file = mesh::surfaceFile(surface, format);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options.output, error.what()));
    }
    projection::writeWholeFile(options.output, file);
    if (!options.quiet) tell(options, surface);
    return 0;
}

double parseValue(const std::string& option, const std::string& text) {
    return parseNumbers(option, text, 1, "a number").front();
}

}  // namespace

void addExtractCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<ExtractOptions>();
    CLI::App* command =
        program.add_subcommand("extract", "an isosurface, a slice or the boundary of a mesh as triangles");
    command->add_option("MESH", options->source, "mesh file or generated field")->required();
    command
        ->add_option("-o,--output", options->output,
                     ".vtp or .ply, with the fields, or .stl (the shape alone, single precision)")
        ->type_name("FILE")
        ->required();
    addParsed(*command, "--isosurface", options->isosurface, parseValue,
              "where the scalar has this value; what lies inside has at least this value", "V");
    addParsed(*command, "--slice", options->slice, parseSlice, "the mesh on a plane through a point with a normal",
              "px,py,pz,nx,ny,nz");
    command->add_flag("--boundary", options->boundary, "the faces that bound the mesh");
    command->add_option("--scalar", options->scalar, "field of the isosurface: NAME (vectors by magnitude) or NAME:x")
        ->type_name("NAME");
    addReadOptions(*command, options->read);
    command->add_flag("--quiet", options->quiet, "nothing on standard output");
    command->callback([options, &chosen] { chosen = [options] { return extract(*options); }; });
}

}  // namespace tetralux::apps
