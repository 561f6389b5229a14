// SPDX-License-Identifier: Apache-2.0
#include <apps/command_reference.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <apps/bash_completion.h>
#include <apps/page_writer.h>

namespace tetralux::apps {

namespace {

constexpr const char* examples = R"(
tetralux info engine.vtu                          # cells by type, fields with ranges and histograms, defects
tetralux info engine.vtu --histogram t.png --scalar Temperature  # with axes; --histogram-log: logarithmic counts
tetralux mesh part.stl -o part.vtu                # points, surfaces or other cells to tetrahedra
tetralux render engine.vtu -o engine.png          # the first field, default colours, a view that holds the mesh
tetralux render engine.vtu -o engine.png --scalar Temperature --tf viridis --size 1024x768
tetralux render engine.vtu -o orbit.png --frames 120             # orbit_0000.png to orbit_0119.png
tetralux render engine.vtu -o engine.exr --report engine.json    # linear float RGBA, times and counts
tetralux render engine.vtu -o engine.png --surface part.stl --slice 0,0,0,1,0,0 --color-bar --axes --title Engine
tetralux extract engine.vtu --isosurface 550 -o hot.vtp
tetralux compare engine.exr other.exr             # rmse, max, psnr
)";

constexpr const char* transferFunction = R"(
{"normalized": true,
 "color": [[0, 0.1, 0.2, 0.6], [0.6, 1, 0.8, 0.4], [1, 0.9, 0.2, 0.05]],
 "extinction": [[0, 0], [0.3, 1], [1, 40]],
 "isosurfaces": [{"value": 0.63, "opacity": 0.95, "color": [1, 0.5, 0.1]}]}
)";

constexpr const char* lighting = R"(
{"ambient": 0.1, "exponent": 32, "transmission": true,
 "lights": [{"type": "directional", "towards": [1, 2, 2], "color": [1, 1, 1], "intensity": 1},
            {"type": "point", "position": [0, 0, 3], "attenuation": [1, 0, 0.1]},
            {"type": "head"}],
 "material": {"diffuse": 1, "specular": 1, "diffuse_transmission": 1, "specular_transmission": 1,
              "front": {"specular": [1, 1, 1], "exponent": 32}, "back": {"specular": [1, 0.9, 0.6]},
              "phase_asymmetry": 0.3, "specular_by_gradient": "absolute"},
 "reflectance": "ward", "normals": "smooth",
 "anisotropy": {"radius": 4, "interval": 0.05, "samples": 4, "smoothing": 0, "kappa": 0.2, "gamma": 10},
 "shadows": {"softness": 0.1}}
)";

std::string_view withoutFirstLine(const char* text) {
    return std::string_view(text).substr(1);
}

/// What stands for a value: CLI11 calls those without a name of their own by their type, and adds what it checks.
std::string valueOf(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    if (type.starts_with("INT")) return "N";
    if (type.starts_with("FLOAT")) return "X";
    const bool flag = option.get_items_expected_max() == 0;
    if (type.starts_with('[') || type.empty() || flag) return type.starts_with('[') ? type : "";
    return option.get_items_expected_min() == 0 ? fmt::format("[{}]", type) : type;
}

/// "-o, --output FILE", "MESH", "--verify [N]".
std::string termOf(const CLI::Option& option, bool shortest = false) {
    if (option.get_positional()) return option.get_name(true);
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    const std::string term = shortest ? names.front() : fmt::format("{}", fmt::join(names, ", "));
    const std::string value = valueOf(option);
    return value.empty() ? term : term + " " + value;
}

bool isHelp(const CLI::Option& option) {
    return option.get_lnames() == std::vector<std::string>{"help"};
}

/// The options of a command by their groups, in the order in which they were added.
void describeOptions(const CLI::App& command, PageWriter& page) {
    const std::string positionals = "Positionals", ungrouped = "Options";
    std::vector<std::string> groups = command.get_groups();
    for (const std::string& group : groups) {
        std::vector<const CLI::Option*> options = command.get_options([&](const CLI::Option* option) {
            return option->get_group() == group && !group.empty() && !isHelp(*option);
        });
        if (options.empty()) continue;
        if (group != ungrouped) page.subheading(fmt::format("{}: {}", command.get_name(), group));
        for (const CLI::Option* option : options) page.entry(termOf(*option), option->get_description());
    }
}

std::string usageOf(const CLI::App& command) {
    std::string usage = "tetralux " + command.get_name();
    if (command.get_prefix_command()) return usage + " INPUT -o OUTPUT.vtu [OPTION...]\n";
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional())
            usage += " " + option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
        else if (option->get_required())
            usage += " " + termOf(*option, true);
    return usage + " [OPTION...]\n";
}

void describeMeshes(PageWriter& page) {
    page.heading("Meshes");
    page.paragraph(
        "A mesh is a file (`.vtu .pvtu .pvd .vtk .vti .vtkhdf`, Exodus, CGNS, EnSight, OpenFOAM, AVS UCD, ANSYS "
        "Fluent, Gmsh, MEDIT, TetGen, image volumes such as NRRD and MetaImage; any of them packed as `.gz`; where "
        "Python has meshio all that it knows, such as XDMF, Nastran, Abaqus, SU2, FLAC3D, Kratos and MED), `-` for "
        "standard input, or a generated field: `bucky:N`, `coulomb:N`, `marschner-lobb:N`, `hydrogen:N`, with N points "
        "along each edge. Every solid cell type is made tetrahedra; what is wrong with a mesh is counted by name and "
        "left out or mended, and the rest is drawn.");
}

void describeFiles(PageWriter& page) {
    page.heading("Transfer functions");
    page.code(withoutFirstLine(transferFunction));
    page.paragraph(
        "Colour `[s, r, g, b]` and extinction `[s, τ]` are linear between nodes and constant beyond them; a node given "
        "twice is a jump. τ counts per unit of length (mode `scale-invariant`: per unit of the scalar). `normalized` "
        "makes every s a fraction of the field's range, `extinctionPerExtent` divides τ by the mesh's extent, so that "
        "a "
        "function suits meshes of any size. Colour maps that ParaView exports load as they are, log scale, categories "
        "and XML too, and VisIt's `.ct`.");
    page.paragraph(
        "In words: `{\"colorMap\": \"viridis\", \"opacity\": \"sigmoid_5\", \"range\": [300, 900], \"logScale\": "
        "true}`; "
        "`opacity` may be nodes `[s, α]` too, over `unitDistance` d: τ = −ln(1 − α)/d.");
    page.heading("Lighting files");
    page.code(withoutFirstLine(lighting));
    page.paragraph(
        "Every key may be left out. `ambient` may be a colour. `specular` of a side is C_spec, `specular` of the "
        "material k_s; the three numbers of `attenuation` are constant, linear and quadratic. `phase_asymmetry` makes "
        "Henyey and Greenstein's phase function the diffuse part; without it that is Equation 19's. "
        "`specular_by_gradient` is true, false or \"absolute\"; `shadows` true or as above. Options on the command "
        "line have the last word over the file.");
}

void describeOutcome(PageWriter& page) {
    page.heading("Exit status");
    page.entry("0", "the picture is whole and on disk");
    page.entry("1",
               "`compare`: a difference is above `--max-rmse` or `--max-error`; `bench --quick`: a picture is wrong");
    page.entry("2", "a wrong command or bad input, with one line on standard error that says what would mend it");
    page.entry("3", "the picture is on disk but not vouched for within `--max-error`");
    page.paragraph("No half-written file is ever left behind.");
}

}  // namespace

std::string commandReference(const CLI::App& program, const std::string& format) {
    if (format == "bash") return bashCompletion(program);
    std::unique_ptr<PageWriter> page;
    if (format == "markdown")
        page = std::make_unique<MarkdownWriter>();
    else if (format == "man")
        page = std::make_unique<ManWriter>();
    else
        throw std::runtime_error(fmt::format("--reference: there is no '{}'; take markdown, man or bash", format));
    const auto commands = program.get_subcommands([](const CLI::App*) { return true; });

    page->title("tetralux", "pictures of scalar fields on unstructured meshes, exact and fast", TETRALUX_VERSION);
    page->heading("Synopsis");
    std::string usage;
    for (const CLI::App* command : commands) usage += usageOf(*command);
    page->code(usage);
    page->heading("Examples");
    page->code(withoutFirstLine(examples));
    describeMeshes(*page);
    page->heading("Commands");
    page->paragraph(
        "`tetralux COMMAND --help` prints a command's part of this page. What the modes, silhouettes, light, cuts and "
        "adaptive opacity compute is defined in the page on modes (`projection/modes.md`); what the options do to time "
        "and error is measured in the page on benchmarks (`apps/BENCHMARK.md`).");
    for (const CLI::App* command : commands) {
        page->heading(command->get_name());
        page->paragraph(sentence(command->get_description()));
        if (command->get_prefix_command())
            page->paragraph(
                "All that follows is for the program `tetralux-mesher`, which is looked for beside this one and then "
                "in "
                "`PATH`; its page (`apps/mesher/README.md`) has the options.");
        describeOptions(*command, *page);
    }
    describeFiles(*page);
    describeOutcome(*page);
    return page->text();
}

}  // namespace tetralux::apps
