// SPDX-License-Identifier: Apache-2.0
#include <apps/opaque_options.h>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/common.hpp>

#include <apps/add_option.h>
#include <apps/option_values.h>
#include <mesh/io/read_surface.h>

namespace tetralux::apps {

namespace {

double parseOpacity(const std::string& text) {
    const double opacity = parseNumbers("--slice-opacity", text, 1, "a number from 0 to 1").front();
    if (!(opacity >= 0.0 && opacity <= 1.0))
        throw std::runtime_error(fmt::format("--slice-opacity: {} will not do; give a number from 0 to 1", text));
    return opacity;
}

}  // namespace

projection::Slice parseSlice(const std::string& option, const std::string& text) {
    const std::vector<double> v = parseNumbers(option, text, 6, "px,py,pz,nx,ny,nz (a point and the normal)");
    const glm::dvec3 normal(v[3], v[4], v[5]);
    const double largest = std::max({std::abs(v[3]), std::abs(v[4]), std::abs(v[5])});
    if (largest == 0.0)
        throw std::runtime_error(fmt::format("{}: '{}' has the normal 0,0,0; give one with a direction", option, text));
    return {{v[0], v[1], v[2]}, normal / largest};
}

namespace {

/// The part as a surface.
void addBoundaryOptions(CLI::App& command, OpaqueOptions& options) {
    projection::BoundaryLook& look = options.boundaryLook;
    command.add_flag(
        "--boundary", options.boundary,
        "the mesh's outer faces and what clipping planes cut, as a surface in the colours of the scalar, lit "
        "(by a head light if no other is given)");
    addNumber<double>(
        command, "--boundary-opacity", look.opacity, [](double value) { return value > 0.0 && value <= 1.0; },
        "a number above 0, up to 1", "below 1 the volume within shows through the boundary");
    addParsed(command, "--boundary-color", look.color, parseColor,
              "one colour for the boundary instead of the scalar's", "r,g,b");
    addNumber<double>(
        command, "--feature-angle", look.featureAngle, [](double value) { return value >= 0.0 && value <= 180.0; },
        "degrees from 0 to 180", "edges of the boundary that are bent by less look round, degrees, 30");
    command.add_flag_callback(
        "--edges", [&look] { look.edges.emplace(look.edges.value_or(projection::SurfaceEdges{})); },
        "lines along the edges of the boundary's triangles");
    command
        .add_option_function<std::string>(
            "--edge-color",
            [&look](const std::string& text) {
                if (!look.edges) look.edges.emplace();
                look.edges->color = parseColor("--edge-color", text);
            },
            "of these lines, 0.1,0.1,0.1")
        ->type_name("r,g,b");
}

void checkBoundary(const OpaqueOptions& options) {
    if (!options.boundary &&
        (options.boundaryLook.edges || options.boundaryLook.color || options.boundaryLook.opacity < 1.0))
        throw std::runtime_error(
            "--edges, --edge-color, --boundary-opacity and --boundary-color: of the boundary, which is not drawn; give "
            "--boundary, or leave them out");
}

}  // namespace

void addOpaqueOptions(CLI::App& command, OpaqueOptions& options) {
    addRepeated(
        command, "--slice", "px,py,pz,nx,ny,nz",
        "slice through a point with a normal, in the colours of the scalar, opaque if nothing is said; may be given "
        "several times",
        [&options](const std::string& text) { options.slices.push_back(parseSlice("--slice", text)); });
    addRepeated(command, "--slice-opacity", "A", "how much a slice hides, from 0 to 1; one for all or one for each",
                [&options](const std::string& text) { options.sliceOpacities.push_back(parseOpacity(text)); });
    addNumber<int>(
        command, "--isolines", options.isolines, [](double value) { return value >= 1.0 && value <= 1024.0; },
        "a whole number from 1 to 1024", "lines on every slice at the middles of so many equal steps of the scalar");
    addNumber<double>(
        command, "--isoline-width", options.lines.width, [](double value) { return value > 0.0 && value <= 100.0; },
        "pixels, above 0 and up to 100", "width of isolines in pixels, 1.5");
    addParsed(command, "--isoline-color", options.lines.color, parseColor,
              "colour of isolines; default: black where the slice is bright, white where it is dark", "r,g,b");
    addRepeated(
        command, "--surface", "FILE",
        "opaque surface in the volume (.stl .obj .ply .off .vtp .vtk), lit unless flat; may be given several times",
        [&options](const std::string& text) { options.surfaces.push_back(text); });
    addRepeated(
        command, "--surface-color", "r,g,b", "colour of the surfaces, 0.8,0.8,0.8; one for all or one for each",
        [&options](const std::string& text) { options.surfaceColors.push_back(parseColor("--surface-color", text)); });
    addRepeated(
        command, "--surface-scalar", "NAME",
        "surfaces in the colours of this field of their own file; one for all or one for each (none: not that one)",
        [&options](const std::string& text) { options.surfaceFields.push_back(text); });
    command.add_flag("--surface-flat", options.flat, "surfaces and the boundary in their colour, without light");
    addBoundaryOptions(command, options);
}

projection::OpaqueObjects readOpaqueObjects(const OpaqueOptions& options) {
    const std::size_t colors = options.surfaceColors.size(), surfaces = options.surfaces.size();
    if (colors > 1 && colors != surfaces)
        throw std::runtime_error(
            fmt::format("--surface-color: {} colours for {} surfaces; give one, or one for each", colors, surfaces));
    const std::size_t fields = options.surfaceFields.size();
    if (fields > 0 && fields != surfaces && (fields > 1 || surfaces == 0))
        throw std::runtime_error(
            fmt::format("--surface-scalar: {} for {} surfaces; give one, or one for each --surface", fields, surfaces));
    const std::size_t opacities = options.sliceOpacities.size(), slices = options.slices.size();
    if (opacities > 0 && opacities != slices && (opacities > 1 || slices == 0))
        throw std::runtime_error(
            fmt::format("--slice-opacity: {} for {} slices; give one, or one for each --slice", opacities, slices));
    if (options.isolines && slices == 0)
        throw std::runtime_error("--isolines: there is nothing to draw them on; give --slice");
    checkBoundary(options);
    projection::OpaqueObjects objects;
    objects.isolines = options.lines;
    objects.slices = options.slices;
    for (std::size_t i = 0; i < slices && opacities > 0; ++i)
        objects.slices[i].opacity = options.sliceOpacities[opacities > 1 ? i : 0];
    for (std::size_t i = 0; i < surfaces; ++i) {
        projection::OpaqueSurface surface;
        const std::string field = fields > 0 ? options.surfaceFields[fields > 1 ? i : 0] : "none";
        surface.byField = field != "none";
        surface.mesh = std::make_shared<const mesh::SurfaceMesh>(
            mesh::readSurface(options.surfaces[i], true, surface.byField ? field : ""));
        if (colors > 0) surface.color = options.surfaceColors[colors > 1 ? i : 0];
        surface.flat = options.flat;
        objects.surfaces.push_back(std::move(surface));
    }
    return objects;
}

}  // namespace tetralux::apps
