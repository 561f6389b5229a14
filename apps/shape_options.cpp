// SPDX-License-Identifier: Apache-2.0
#include <apps/shape_options.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <apps/add_option.h>

namespace tetralux::apps {

namespace {

using projection::AdaptiveSettings;
using projection::Classification;
using projection::HalfSpace;
using projection::Mode;

/// Finite numbers with commas between them, as many as `Count`.
template <std::size_t Count>
std::array<double, Count> parseNumbers(const std::string& option, const std::string& text, const char* form) {
    std::array<double, Count> numbers{};
    const char *at = text.data(), *const end = text.data() + text.size();
    bool good = true;
    for (std::size_t i = 0; i < Count && good; ++i) {
        const auto [stop, error] = std::from_chars(at, end, numbers[i]);
        good = error == std::errc() && std::isfinite(numbers[i]) &&
               (i + 1 < Count ? stop != end && *stop == ',' : stop == end);
        at = stop + 1;
    }
    if (!good)
        throw std::runtime_error(
            fmt::format("{}: '{}' is not {} numbers; give {} without spaces", option, text, Count, form));
    return numbers;
}

void checkNormal(const std::string& option, const glm::dvec3& normal) {
    if (normal == glm::dvec3(0))
        throw std::runtime_error(
            fmt::format("{}: the normal 0,0,0 has no direction; give the side that stays", option));
}

std::vector<HalfSpace> parseClipPlane(const std::string& text) {
    const auto n = parseNumbers<6>("--clip-plane", text, "px,py,pz,nx,ny,nz");
    checkNormal("--clip-plane", {n[3], n[4], n[5]});
    return {{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}}};
}

std::vector<HalfSpace> parseClipBox(const std::string& text) {
    const auto n = parseNumbers<6>("--clip-box", text, "x0,x1,y0,y1,z0,z1");
    for (std::size_t axis = 0; axis < 6; axis += 2)
        if (!(n[axis] < n[axis + 1]))
            throw std::runtime_error(
                fmt::format("--clip-box: {} is not below {}; give x0,x1,y0,y1,z0,z1 with each first "
                            "number below the second",
                            n[axis], n[axis + 1]));
    return projection::boxHalfSpaces({n[0], n[2], n[4]}, {n[1], n[3], n[5]});
}

std::vector<HalfSpace> parseSlab(const std::string& text) {
    const auto n = parseNumbers<7>("--slab", text, "px,py,pz,nx,ny,nz,thickness");
    checkNormal("--slab", {n[3], n[4], n[5]});
    if (!(n[6] > 0))
        throw std::runtime_error(fmt::format("--slab: a thickness of {} shows nothing; give a length above 0", n[6]));
    return projection::slabHalfSpaces({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]);
}

shading::DepthColor parseDepthColor(const std::string& text) {
    const bool strong = std::count(text.begin(), text.end(), ',') == 3;
    shading::DepthColor result;
    if (strong) {
        const auto n = parseNumbers<4>("--depth-color", text, "r,g,b[,STRENGTH]");
        result = {{n[0], n[1], n[2]}, n[3]};
    } else {
        const auto n = parseNumbers<3>("--depth-color", text, "r,g,b[,STRENGTH]");
        result.color = {n[0], n[1], n[2]};
    }
    if (!(std::min({result.color.x, result.color.y, result.color.z, result.strength}) >= 0 && result.strength <= 1))
        throw std::runtime_error(
            fmt::format("--depth-color: {} will not do; give a colour from 0 and a strength from 0 to 1", text));
    return result;
}

template <class Value>
using Named = std::pair<const char*, Value>;

template <class Value, std::size_t Count>
Value chosen(const std::string& option, const std::string& text, const std::array<Named<Value>, Count>& choices) {
    std::string names;
    for (const auto& [name, value] : choices) {
        if (text == name) return value;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    }
    throw std::runtime_error(fmt::format("{}: there is no '{}'; take one of {}", option, text, names));
}

constexpr std::array classifications{Named<Classification>{"preintegrated", Classification::Preintegrated},
                                     Named<Classification>{"post", Classification::Post},
                                     Named<Classification>{"post-linear", Classification::PostLinear},
                                     Named<Classification>{"pre", Classification::Pre}};
constexpr std::array units{Named<AdaptiveSettings::Unit>{"cells", AdaptiveSettings::Unit::Cells},
                           Named<AdaptiveSettings::Unit>{"length", AdaptiveSettings::Unit::Length}};
constexpr std::array filters{Named<AdaptiveSettings::Filter>{"none", AdaptiveSettings::Filter::None},
                             Named<AdaptiveSettings::Filter>{"gaussian", AdaptiveSettings::Filter::Gaussian},
                             Named<AdaptiveSettings::Filter>{"2x", AdaptiveSettings::Filter::Bilinear2},
                             Named<AdaptiveSettings::Filter>{"4x", AdaptiveSettings::Filter::Bilinear4}};

using ParseClip = std::vector<HalfSpace> (*)(const std::string&);

void addClip(CLI::App& command, const char* name, const char* form, ParseClip parse, ShapeOptions& options,
             const char* help) {
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [&options, parse](const std::vector<std::string>& texts) {
                for (const std::string& text : texts)
                    for (const HalfSpace& half : parse(text)) options.clips.push_back(half);
            },
            help)
        ->type_name(form)
        ->allow_extra_args(false);
}

void addAdaptiveOptions(CLI::App& command, ShapeOptions& options) {
    addParsed(
        command, "--adaptive", options.adaptive.unit,
        [&options](const std::string& option, const std::string& text) {
            options.adaptiveOn = true;
            return chosen(option, text, units);
        },
        "opacity of each pixel by how many relevant cells, or pieces of relevant length, lie along its ray",
        "cells|length");
    addNumber<double>(
        command, "--adaptive-max", options.adaptive.most, [](double value) { return value > 0.0 && value <= 1.0; },
        "an opacity above 0, up to 1", "the most opacity of one cell or piece, 0.12");
    addNumber<double>(command, "--adaptive-step", options.adaptive.pieceLength, positive, "a length above 0",
                      "length of a piece (over |ds|: of the scalar); the mean of the mesh's edges");
    addParsed(
        command, "--adaptive-filter", options.adaptive.filter,
        [](const std::string& option, const std::string& text) { return chosen(option, text, filters); },
        "how the map of contributions is smoothed: not (none), gaussian, or measured at a half or a quarter of the "
        "size (2x, 4x)",
        "none|gaussian|2x|4x");
    addNumber<double>(command, "--adaptive-sigma", options.adaptive.sigma, positive, "pixels, above 0",
                      "width of the gaussian in pixels, 4");
    addNumber<double>(
        command, "--adaptive-threshold", options.adaptive.threshold,
        [](double value) { return value >= 0.0 && value < 1.0; }, "a share from 0 to below 1",
        "share of the largest extinction above which something is relevant, 0");
}

}  // namespace

void addShapeOptions(CLI::App& command, ShapeOptions& options, projection::RenderSettings& settings) {
    addClip(command, "--clip-plane", "px,py,pz,nx,ny,nz", parseClipPlane, options,
            "show the side of a plane that the normal points to; may be given several times");
    addClip(command, "--clip-box", "x0,x1,y0,y1,z0,z1", parseClipBox, options, "show only what lies within a box");
    addClip(command, "--slab", "px,py,pz,nx,ny,nz,thickness", parseSlab, options,
            "show only a slab about the point, across the normal");
    addNumber<double>(
        command, "--cut-layer", options.cutLayer, notNegative, "a length from 0",
        "a layer behind the cut, so thick, is lit by the cut's normal; 1/200 of the diagonal of the mesh's box");
    addParsed(
        command, "--classification", settings.classification,
        [](const std::string& option, const std::string& text) { return chosen(option, text, classifications); },
        "what a cell's segment shows: the integral, one sample in its middle (post, post-linear), or what the vertices "
        "show (pre); for comparison",
        "preintegrated|post|post-linear|pre");
    command
        .add_flag("--silhouette{exact}", options.silhouette,
                  "thin layers seen edge-on become denser: exact (if nothing is said) or approximate")
        ->type_name("[exact|approximate]");
    addNumber<double>(command, "--gradient-opacity", settings.shading.gradientOpacity, positive, "a number above 0",
                      "extinction times so many times the gradient's magnitude (ranges per diagonal)");
    addNumber<int>(
        command, "--isosurfaces", options.isosurfaces, [](double value) { return value >= 1.0 && value <= 1024.0; },
        "a whole number from 1 to 1024",
        "so many equidistant isosurfaces instead of extinction, lit by a head light if no other is given");
    command.add_flag("--unlit", options.unlit, "--isosurfaces in their colour alone, without light");
    command
        .add_option_function<std::string>(
            "--depth-color",
            [&settings](const std::string& text) { settings.shading.depthColor = parseDepthColor(text); },
            "colours go over into this one with the distance, by the strength (1) at the far end")
        ->type_name("r,g,b[,STRENGTH]");
    addAdaptiveOptions(command, options);
}

namespace {

/// Shapes are seen by their light: what --isosurfaces draws has some unless it is asked not to.
void lightIsosurfaces(const ShapeOptions& options, Mode mode, std::vector<shading::Light>& lights) {
    if (options.unlit && !options.isosurfaces)
        throw std::runtime_error(
            "--unlit: without --isosurfaces there is light only where it is asked for; leave it out");
    if (options.unlit && !lights.empty())
        throw std::runtime_error("--unlit: a light is given too; leave one of them out");
    const bool shades = mode == Mode::Standard || mode == Mode::ScaleInvariant || mode == Mode::FirstHit;
    if (!options.isosurfaces || options.unlit || !lights.empty() || !shades) return;
    shading::Light light;
    light.kind = shading::Light::Kind::Head;
    lights.push_back(light);
}

}  // namespace

void finishShapeOptions(const ShapeOptions& options, projection::RenderSettings& settings) {
    if (!options.silhouette.empty()) {
        settings.shading.silhouette = true;
        settings.shading.approximateSilhouette =
            chosen("--silhouette", options.silhouette,
                   std::array{Named<bool>{"exact", false}, Named<bool>{"approximate", true}});
    }
    const Mode mode = settings.mode;
    lightIsosurfaces(options, mode, settings.shading.lights);
    const bool integrates = mode == Mode::Standard || mode == Mode::ScaleInvariant;
    if (settings.shading.depthColor && !integrates && !projection::addsUp(mode) && mode != Mode::FirstHit)
        throw std::runtime_error(
            "--depth-color: this mode's colours lie at no distance; take standard, scale-invariant, first-hit, "
            "additive, additive-scale-invariant or emission");
    const bool classifies = integrates || projection::addsUp(mode) || mode == Mode::FirstHit;
    const bool counts = options.adaptiveOn || mode == Mode::Contributions;
    if (settings.classification != Classification::Preintegrated && !classifies && !counts)
        throw std::runtime_error(
            "--classification: only standard, scale-invariant, first-hit and the modes that add up classify segments; "
            "leave it out");
    if (settings.classification != Classification::Preintegrated && options.isosurfaces)
        throw std::runtime_error(
            "--classification: a sample does not meet isosurfaces; leave --isosurfaces out, or take preintegrated");
    if (!counts) return;
    if (settings.classification == Classification::Pre)
        throw std::runtime_error(
            "--classification pre: what vertices show is relevant or not, with nothing between; take post with "
            "--adaptive");
    if (!integrates && !projection::addsUp(mode) && mode != Mode::Absorption && mode != Mode::Contributions)
        throw std::runtime_error(
            "--adaptive: this mode has no extinction; take standard, scale-invariant, additive, "
            "additive-scale-invariant, emission, absorption or contributions");
    settings.adaptive = options.adaptive;
}

std::vector<std::string> joinedOptionalValues(int argumentCount, char** arguments) {
    static const std::map<std::string, std::set<std::string>> optionalValues{
        {"--silhouette", {"exact", "approximate"}}, {"--specular-by-gradient", {"relative", "absolute"}}};
    std::vector<std::string> words;
    for (int i = 0; i < argumentCount; ++i) {
        words.emplace_back(arguments[i]);
        const std::string next = i + 1 < argumentCount ? arguments[i + 1] : "";
        const auto values = optionalValues.find(words.back());
        if (values != optionalValues.end() && values->second.contains(next)) {
            words.back() += "=" + next;
            ++i;
        }
    }
    return words;
}

}  // namespace tetralux::apps
