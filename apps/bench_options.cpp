// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_options.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <apps/bench_scene.h>
#include <apps/bench_vtk_rows.h>
#include <apps/option_values.h>
#include <projection/frame/engine_registry.h>
#include <projection/gl/gl_context.h>
#include <projection/gl/gl_path.h>

namespace tetralux::apps {

namespace {

using Unit = projection::AdaptiveSettings::Unit;

/// An option that takes a list with commas, each item by `parse(option, text)`.
template <class Item>
CLI::Option* addList(CLI::App& command, const std::string& name, std::vector<Item>& items,
                     std::function<Item(const std::string&, const std::string&)> parse, const std::string& help,
                     const std::string& form) {
    const auto store = [&items, name, parse](const std::vector<std::string>& texts) {
        items.clear();
        for (const std::string& text : texts) items.push_back(parse(name, text));
    };
    return command.add_option_function<std::vector<std::string>>(name, store, help)->delimiter(',')->type_name(form);
}

std::string sameText(const std::string&, const std::string& text) {
    return text;
}

std::string parseGlPathName(const std::string& option, const std::string& text) {
    const std::vector<std::string> names = projection::glPathNames();
    if (std::find(names.begin(), names.end(), text) != names.end()) return text;
    throw std::runtime_error(
        fmt::format("{}: there is no path '{}'; take some of {}", option, text, fmt::join(names, ", ")));
}

int parseCount(const std::string& option, const std::string& text) {
    if (text == "auto" || text == "all") return 0;
    const bool digits = !text.empty() && text.size() <= 5 &&
                        std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!digits || std::stoi(text) < 1)
        throw std::runtime_error(fmt::format("{}: '{}' is no whole number above 0; give such, or auto", option, text));
    return std::stoi(text);
}

/// 0 for "auto".
double parseTableError(const std::string& option, const std::string& text) {
    if (text == "auto") return 0.0;
    char* end = nullptr;
    const double error = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(error > 0.0 && error < 1.0))
        throw std::runtime_error(
            fmt::format("{}: '{}' is no error between 0 and 1; give such as 1e-3, or auto", option, text));
    return error;
}

bool parseSwitch(const std::string& option, const std::string& text) {
    if (text != "on" && text != "off")
        throw std::runtime_error(fmt::format("{}: '{}' is neither on nor off; give one of them or both", option, text));
    return text == "on";
}

std::optional<Unit> parseAdaptive(const std::string& option, const std::string& text) {
    if (text == "off") return std::nullopt;
    if (text == "cells") return Unit::Cells;
    if (text == "length") return Unit::Length;
    throw std::runtime_error(fmt::format("{}: there is no '{}'; take some of off, cells, length", option, text));
}

int parseSamples(const std::string& option, const std::string& text) {
    const int samples = parseCount(option, text);
    if (samples < 1 || samples > 64)
        throw std::runtime_error(fmt::format("{}: {} rays per pixel will not do; give 1 to 64", option, text));
    return samples;
}

NamedMode namedMode(projection::Mode mode, bool silhouette, const std::optional<Unit>& unit, int samples) {
    NamedMode named{modeName(mode), mode, silhouette};
    if (silhouette) named.name += " silhouettes";
    if (unit) {
        named.adaptive.emplace().unit = *unit;
        named.name += *unit == Unit::Cells ? " adaptive cells" : " adaptive length";
    }
    named.samples = samples;
    if (samples > 1) named.name += fmt::format(" {} samples", samples);
    return named;
}

bool given(const CLI::App& command, const std::string& option) {
    return command.get_option(option)->count() > 0;
}

/// Engines of OpenGL run in each kind of context; the others need none.
std::vector<projection::EngineOptions> variantsOf(const std::string& engine) {
    if (!engine.starts_with("gl")) return {{.engine = engine}};
    std::vector<projection::EngineOptions> variants;
    for (const std::string& context : projection::glContextNames())
        if (context != "auto") variants.push_back({.engine = engine, .context = context});
    return variants;
}

std::vector<projection::EngineOptions> allVariants() {
    std::vector<projection::EngineOptions> variants;
    for (const std::string& name : projection::engineNames())
        for (const projection::EngineOptions& variant : variantsOf(name)) variants.push_back(variant);
    return variants;
}

/// "vtk" or "vtk:projected" and so on; nothing when the name is none of VTK's.
std::vector<std::string> vtkMappersNamed(const std::string& name) {
    std::vector<std::string> mappers;
    for (const std::string& mapper : vtkMapperNames())
        if (name == "vtk" || name == "vtk:" + mapper) mappers.push_back(mapper);
    return mappers;
}

std::vector<std::string> knownNames() {
    std::vector<std::string> names;
    for (const projection::EngineOptions& variant : allVariants())
        names.push_back(EngineChoice{.options = variant}.name());
    for (const std::string& mapper : vtkMapperNames()) names.push_back("vtk:" + mapper);
    return names;
}

void addOnPath(const projection::EngineOptions& variant, const BenchOptions& options,
               std::vector<EngineChoice>& choices) {
    for (const int tableSize : options.tableSizes)
        for (const double tableError : options.tableErrors)
            for (const projection::OrderMethod order : options.orders)
                for (const bool everyNode : options.everyNode)
                    for (const bool skipInvisible : options.skipInvisible)
                        for (const bool earlyTermination : options.earlyTermination)
                            for (const int threads : options.threads)
                                choices.push_back({.options = variant,
                                                   .tableSize = tableSize,
                                                   .threads = threads,
                                                   .tableError = tableError,
                                                   .order = order,
                                                   .everyNode = everyNode,
                                                   .skipInvisible = skipInvisible,
                                                   .earlyTermination = earlyTermination});
}

void addWithSettings(projection::EngineOptions variant, const BenchOptions& options,
                     std::vector<EngineChoice>& choices) {
    if (!variant.engine.starts_with("gl")) return addOnPath(variant, options, choices);
    for (const std::string& path : options.glPaths) {
        variant.glPath = path;
        addOnPath(variant, options, choices);
    }
}

/// True when `name` means at least one engine, which is then added.
bool addNamed(const std::string& name, const BenchOptions& options, BenchEngines& engines) {
    const std::vector<std::string> mappers = vtkMappersNamed(name);
    engines.vtkMappers.insert(engines.vtkMappers.end(), mappers.begin(), mappers.end());
    bool found = !mappers.empty();
    for (const projection::EngineOptions& variant : allVariants()) {
        if (name != variant.engine && name != EngineChoice{.options = variant}.name()) continue;
        found = true;
        if (variant.engine == "reference")
            engines.reference = true;
        else
            addWithSettings(variant, options, engines.choices);
    }
    return found;
}

BenchEngines chooseEngines(const BenchOptions& options) {
    BenchEngines engines;
    engines.vtkProgram = findVtkProgram().value_or("");
    if (options.engines.empty()) {
        for (const projection::EngineOptions& variant : allVariants())
            if (variant.engine != "reference") addWithSettings(variant, options, engines.choices);
        if (!options.quick && !engines.vtkProgram.empty()) engines.vtkMappers = vtkMapperNames();
        return engines;
    }
    for (const std::string& name : options.engines)
        if (!addNamed(name, options, engines))
            throw std::runtime_error(
                fmt::format("--engines: there is no '{}'; take some of {}", name, fmt::join(knownNames(), ", ")));
    if (!engines.vtkMappers.empty() && engines.vtkProgram.empty())
        throw std::runtime_error(
            "--engines: vtk needs the program tetralux-bench-vtk beside this one; build it with TETRALUX_BENCH_VTK=ON");
    return engines;
}

void checkTransferFunctions(const std::vector<std::string>& names) {
    const std::vector<std::string> known = benchTransferFunctionNames();
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw std::runtime_error(fmt::format("--tf: there is no benchmark function '{}'; take some of {}", name,
                                                 fmt::join(known, ", ")));
}

}  // namespace

void addBenchOptions(CLI::App& command, BenchOptions& options) {
    command
        .add_option("SCENE", options.scenes,
                    "mesh files, generated fields (bucky, marschner-lobb, hydrogen, coulomb; bucky:64 for one size)")
        ->capture_default_str();
    addList<std::uint64_t>(command, "--cells", options.cells, parseCellCount,
                           "tetrahedra of fields without a size (default 0.15M,1.25M)", "N,…");
    addList<glm::ivec2>(command, "--sizes", options.sizes, parseSize, "image sizes (default 512x512)", "WxH,…");
    addList<std::string>(command, "--tf", options.transferFunctions, sameText,
                         fmt::format("transfer functions: {} (default all but sparse and veiled)",
                                     fmt::join(benchTransferFunctionNames(), ", ")),
                         "NAME,…");
    addList<projection::Mode>(command, "--mode", options.modes, parseMode,
                              fmt::format("{} (default standard)", modeNames()), "MODE,…");
    addList<bool>(command, "--silhouette", options.silhouettes, parseSwitch,
                  "on, off: silhouette enhancement (default off)", "on,off");
    addList<std::optional<projection::AdaptiveSettings::Unit>>(
        command, "--adaptive", options.adaptive, parseAdaptive,
        "off, cells, length: locally adaptive opacity (default off)", "off,cells,length");
    addList<int>(command, "--samples", options.samples, parseSamples, "rays per pixel (default 1)", "N,…");
    addList<std::string>(command, "--engines", options.engines, sameText,
                         fmt::format("{}; gl or vtk for all of that kind (default all but the reference)",
                                     fmt::join(knownNames(), ", ")),
                         "NAME,…");
    addList<int>(command, "--table", options.tableSizes, parseCount, "texels per axis of the table (default auto)",
                 "N,…");
    addList<double>(command, "--table-error", options.tableErrors, parseTableError,
                    "error that the table is made for (default auto: 1e-4)", "E,…");
    addList<projection::OrderMethod>(command, "--order", options.orders, parseOrder,
                                     fmt::format("{} (default auto)", orderNames()), "ORDER,…");
    addList<bool>(command, "--integration", options.everyNode, parseIntegration,
                  "auto, exact: merge nodes that a line meets within 1e-5, of functions of many (default auto)",
                  "auto,exact");
    addList<bool>(command, "--skip-invisible", options.skipInvisible, parseSwitch,
                  "on, off: leave out cells that the transfer function hides (default on)", "on,off");
    addList<bool>(command, "--early-termination", options.earlyTermination, parseSwitch,
                  "on, off: leave out what lies behind opaque pixels (default on)", "on,off");
    addList<std::string>(command, "--gl-path", options.glPaths, parseGlPathName,
                         fmt::format("who sets cells up for OpenGL and draws them: {} (default auto)",
                                     fmt::join(projection::glPathNames(), ", ")),
                         "PATH,…");
    addList<int>(command, "--threads", options.threads, parseCount, "threads of our engines (default all)", "N,…");
    command.add_option("--frames", options.plan.frames, "timed frames, camera moved before each")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command.add_option("--judged", options.plan.judged, "so many of them are compared with the reference")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command.add_option("--budget", options.plan.budgetSeconds, "seconds of frames after which a row ends early")
        ->capture_default_str();
    command.add_option("--csv", options.csv, "write the rows there")->type_name("FILE.csv");
    command.add_option("--json", options.json, "write machine and rows there")->type_name("FILE.json");
    command.add_option("--plot", options.plots, "plot error against time: .svg, .png or both")
        ->delimiter(',')
        ->type_name("FILE,…");
    command.add_flag("--quick", options.quick,
                     "a small scene in seconds; exit status 1 when a picture is wrong, whatever the time");
    command.add_flag("--quiet", options.quiet, "no table, no progress");
}

void makeQuick(const CLI::App& command, BenchOptions& options) {
    if (!given(command, "SCENE")) options.scenes = {"bucky:12"};
    if (!given(command, "--sizes")) options.sizes = {{96, 72}};
    if (!given(command, "--mode")) options.modes = {projection::Mode::Standard, projection::Mode::ScaleInvariant};
    if (!given(command, "--frames")) options.plan.frames = 2;
    if (!given(command, "--judged")) options.plan.judged = options.plan.frames;
}

BenchPlan benchPlan(const BenchOptions& options) {
    checkTransferFunctions(options.transferFunctions);
    BenchPlan plan;
    plan.sources = benchSources(options.scenes, options.cells);
    plan.sizes = options.sizes;
    plan.transferFunctions = options.transferFunctions;
    for (const projection::Mode mode : options.modes)
        for (const bool silhouette : options.silhouettes)
            for (const auto& unit : options.adaptive)
                for (const int samples : options.samples)
                    plan.modes.push_back(namedMode(mode, silhouette, unit, samples));
    plan.engines = chooseEngines(options);
    plan.frames = options.plan;
    plan.frames.judged = std::min(plan.frames.judged, plan.frames.frames);
    return plan;
}

}  // namespace tetralux::apps
