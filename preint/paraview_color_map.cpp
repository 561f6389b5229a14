// SPDX-License-Identifier: Apache-2.0
/// \file
/// Colour maps exported by ParaView: a list of one object with `RGBPoints` (s, r, g, b, …), `ColorSpace` and, when
/// opacity was exported too, `Points` (s, opacity, midpoint, sharpness, …), interpolated as VTK's vtkPiecewiseFunction
/// does. `UseLogScale` makes all of that linear in the logarithm of s (log_scale.h). A categorical one has
/// `IndexedColors`.
///
/// Opacity becomes extinction as VTK's unstructured volume mappers take it: attenuation per unit distance. ParaView's
/// unit distance is about one cell (diagonal / cells^⅓), which a colour map does not know, so it is 1/50 of the extent
/// here, a mesh of some 100,000 cells. It stays linear between points, and an opacity of 1 stays finite.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <preint/color_space.h>
#include <preint/json_reading.h>
#include <preint/log_scale.h>

namespace tetralux::preint {
namespace {

constexpr double unitDistancesPerExtent = 50.0;

struct OpacityPoint {
    double scalar, opacity, midpoint, sharpness;  ///< midpoint and sharpness shape the way to the next point
};

ColorSpace colorSpaceOf(const JsonPlace& map) {
    if (!map.value().contains("ColorSpace")) return ColorSpace::Rgb;
    static const std::map<std::string, ColorSpace> spaces{
        {"CIELAB", ColorSpace::Lab}, {"Diverging", ColorSpace::Diverging},
        {"HSV", ColorSpace::Hsv},    {"Lab", ColorSpace::Lab},
        {"RGB", ColorSpace::Rgb},    {"Step", ColorSpace::Step}};
    const JsonPlace place = map.member("ColorSpace");
    const auto found = spaces.find(place.text());
    if (found == spaces.end()) {
        place.fail(fmt::format(
            "\"{}\" is not a color space that is read here; choose CIELAB, Diverging, HSV, Lab, RGB or Step",
            place.text()));
    }
    const bool wraps = map.value().contains("HSVWrap") && map.value().at("HSVWrap") == 1;
    return found->second == ColorSpace::Hsv && wraps ? ColorSpace::HsvWrapped : found->second;
}

/// Exported numbers stray beyond [0, 1] by rounding; more is an error.
double nearUnit(const JsonPlace& place, const char* what) {
    constexpr double slack = 1e-4;
    const double value = place.number();
    if (!(value >= -slack && value <= 1.0 + slack)) return place.fraction(what);
    return std::clamp(value, 0.0, 1.0);
}

void requireAscending(const JsonPlace& place, double previous, double scalar) {
    if (scalar < previous)
        place.fail(fmt::format("is {}, below the {} before it; sort the points by scalar", scalar, previous));
}

std::vector<ColorNode> colorPoints(const JsonPlace& points) {
    points.array("[s, r, g, b, …]");
    if (points.size() == 0 || points.size() % 4 != 0) {
        points.fail(fmt::format("has {} numbers, must have four for each point: s, r, g, b", points.size()));
    }
    std::vector<ColorNode> nodes;
    for (std::size_t i = 0; i < points.size(); i += 4) {
        const double scalar = points.element(i).number();
        if (!nodes.empty()) requireAscending(points.element(i), nodes.back().scalar, scalar);
        nodes.push_back(
            {scalar,
             {nearUnit(points.element(i + 1), "a color channel"), nearUnit(points.element(i + 2), "a color channel"),
              nearUnit(points.element(i + 3), "a color channel")}});
    }
    return nodes;
}

std::vector<OpacityPoint> opacityPoints(const JsonPlace& points) {
    points.array("[s, opacity, midpoint, sharpness, …]");
    if (points.size() == 0 || points.size() % 4 != 0) {
        points.fail(fmt::format("has {} numbers, must have four for each point: s, opacity, midpoint, sharpness",
                                points.size()));
    }
    std::vector<OpacityPoint> read;
    for (std::size_t i = 0; i < points.size(); i += 4) {
        const double scalar = points.element(i).number();
        if (!read.empty()) requireAscending(points.element(i), read.back().scalar, scalar);
        read.push_back({scalar, nearUnit(points.element(i + 1), "an opacity"),
                        nearUnit(points.element(i + 2), "a midpoint"), nearUnit(points.element(i + 3), "a sharpness")});
    }
    return read;
}

/// vtkPiecewiseFunction between two points: the midpoint is where the mean opacity lies, sharpness bends linear to
/// step.
double opacityBetween(const OpacityPoint& low, const OpacityPoint& high, double fraction) {
    const double midpoint = std::clamp(low.midpoint, 1e-5, 1.0 - 1e-5);
    double s = fraction < midpoint ? 0.5 * fraction / midpoint : 0.5 + 0.5 * (fraction - midpoint) / (1.0 - midpoint);
    if (low.sharpness < 0.01) return std::lerp(low.opacity, high.opacity, s);
    const double power = 1.0 + 10.0 * low.sharpness;
    s = s < 0.5 ? 0.5 * std::pow(2.0 * s, power) : 1.0 - 0.5 * std::pow(2.0 * (1.0 - s), power);
    const double square = s * s, cube = square * s;
    const double tangent = (1.0 - low.sharpness) * (high.opacity - low.opacity);
    const double opacity = (2.0 * cube - 3.0 * square + 1.0) * low.opacity +
                           (3.0 * square - 2.0 * cube) * high.opacity + (2.0 * cube - 3.0 * square + s) * tangent;
    return std::clamp(opacity, std::min(low.opacity, high.opacity), std::max(low.opacity, high.opacity));
}

std::vector<ExtinctionNode> extinctionFrom(const std::vector<OpacityPoint>& points) {
    constexpr int samples = 64;
    std::vector<ExtinctionNode> nodes;
    auto add = [&](double scalar, double opacity) { nodes.push_back({scalar, opacity * unitDistancesPerExtent}); };
    add(points.front().scalar, points.front().opacity);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const OpacityPoint &low = points[i - 1], &high = points[i];
        const double middle = std::lerp(low.scalar, high.scalar, std::clamp(low.midpoint, 1e-5, 1.0 - 1e-5));
        if (low.opacity != high.opacity && low.sharpness > 0.99) {  // a step at the midpoint
            add(middle, low.opacity);
            add(middle, high.opacity);
        } else if (low.opacity != high.opacity && low.sharpness >= 0.01) {
            for (int k = 1; k < samples; ++k) {
                const double fraction = static_cast<double>(k) / samples;
                add(std::lerp(low.scalar, high.scalar, fraction), opacityBetween(low, high, fraction));
            }
        } else if (low.opacity != high.opacity && low.midpoint != 0.5) {
            add(middle, 0.5 * (low.opacity + high.opacity));
        }
        add(high.scalar, high.opacity);
    }
    return nodes;
}

const nlohmann::json& onlyMap(const nlohmann::json& document, const std::string& origin) {
    if (!document.is_array()) return document;
    if (document.size() != 1) {
        JsonPlace(document, origin).fail(fmt::format("holds {} color maps; export one alone", document.size()));
    }
    return document.front();
}

bool usesLogScale(const JsonPlace& map) {
    if (!map.value().contains("UseLogScale")) return false;
    const nlohmann::json& flag = map.value().at("UseLogScale");
    return flag == 1 || flag == true;
}

/// The scalars that a map gives, by their logarithms.
using Given = std::map<double, double>;

/// Puts nodes on a logarithmic axis. \throws std::runtime_error if they have no place there.
template <class Node>
void takeLogarithms(const JsonPlace& map, std::vector<Node>& nodes, Given& given) {
    for (Node& node : nodes) {
        if (!(node.scalar > 0.0)) {
            map.member("UseLogScale")
                .fail(fmt::format("needs points above 0, and one is at {}; rescale the map to the data in ParaView and "
                                  "export it again, or leave the scale linear",
                                  node.scalar));
        }
        const double logarithm = std::log(node.scalar);
        node.scalar = given.try_emplace(logarithm, node.scalar).first->first;
    }
}

/// A categorical map: the i-th colour is that of the i-th value that the field has.
TransferFunction categoricalMap(const JsonPlace& map) {
    const JsonPlace colors = map.member("IndexedColors").array("[r, g, b, …]");
    if (colors.size() == 0 || colors.size() % 3 != 0)
        colors.fail(fmt::format("has {} numbers, must have three for each color: r, g, b", colors.size()));
    TransferFunction function;
    for (std::size_t i = 0; i < colors.size(); i += 3)
        function.categories.emplace_back(nearUnit(colors.element(i), "a color channel"),
                                         nearUnit(colors.element(i + 1), "a color channel"),
                                         nearUnit(colors.element(i + 2), "a color channel"));
    function.extinction = suggestedExtinction();
    function.normalized = function.extinctionPerExtent = function.extinctionSuggested = true;
    return function;
}

}  // namespace

bool isParaViewColorMap(const nlohmann::json& document) {
    const nlohmann::json& first = document.is_array() && !document.empty() ? document.front() : document;
    return first.is_object() &&
           (first.contains("RGBPoints") || first.contains("ColorSpace") || first.contains("IndexedColors"));
}

TransferFunction paraViewColorMap(const nlohmann::json& document, const std::string& origin) {
    const JsonPlace map(onlyMap(document, origin), origin);
    if (!map.value().contains("RGBPoints")) {
        if (map.value().contains("IndexedColors")) return categoricalMap(map);
        map.fail("is a ParaView color map without RGBPoints or IndexedColors; export one with either");
    }
    TransferFunction function;
    std::vector<ColorNode> nodes = colorPoints(map.member("RGBPoints"));
    // ParaView's own presets span [0, 1] and stand for the field's range.
    function.normalized = nodes.front().scalar == 0.0 && nodes.back().scalar == 1.0;
    function.logarithmic = function.normalized && usesLogScale(map);
    const bool logarithmic = !function.normalized && usesLogScale(map);
    function.extinctionPerExtent = true;
    // Colours alone: opacity as ParaView starts with, a ramp over the same range.
    std::vector<OpacityPoint> opacities{{nodes.front().scalar, 0.0, 0.5, 0.0}, {nodes.back().scalar, 1.0, 0.5, 0.0}};
    if (map.value().contains("Points")) opacities = opacityPoints(map.member("Points"));
    Given given;
    if (logarithmic) {
        takeLogarithms(map, nodes, given);
        takeLogarithms(map, opacities, given);
    }
    function.color = sampledInRgb(colorSpaceOf(map), nodes);
    function.extinction = extinctionFrom(opacities);
    if (logarithmic) {
        const auto scalarOf = [&](double logarithm) {  // what was given is not rounded twice
            const auto original = given.find(logarithm);
            return original != given.end() ? original->second : std::exp(logarithm);
        };
        function.color = fromLogarithms(function.color, scalarOf);
        function.extinction = fromLogarithms(function.extinction, scalarOf);
    }
    return function;
}

}  // namespace tetralux::preint
