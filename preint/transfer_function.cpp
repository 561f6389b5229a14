// SPDX-License-Identifier: Apache-2.0
#include <preint/transfer_function.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <preint/color_maps/color_maps.h>
#include <preint/json_reading.h>
#include <preint/opacity_words.h>

namespace tetralux::preint {
namespace {

double interpolated(double low, double high, double fraction) {
    return std::lerp(low, high, fraction);
}
glm::dvec3 interpolated(const glm::dvec3& low, const glm::dvec3& high, double fraction) {
    return glm::mix(low, high, fraction);
}

/// Piecewise linear look-up; at a jump the value from above.
template <class Node, class Value>
Value valueAt(const std::vector<Node>& nodes, Value Node::*value, double scalar, const Value& ifEmpty) {
    if (nodes.empty()) return ifEmpty;
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), scalar,
                                        [](double s, const Node& node) { return s < node.scalar; });
    if (above == nodes.begin()) return nodes.front().*value;
    if (above == nodes.end()) return nodes.back().*value;
    const Node& below = *std::prev(above);
    const double fraction = (scalar - below.scalar) / (above->scalar - below.scalar);
    return interpolated(below.*value, (*above).*value, fraction);
}

/// Nodes ascend; a scalar may stand twice (a jump), not more often.
void requireNodeOrder(const JsonPlace& list, std::size_t index, double beforeLast, double last, double scalar) {
    const JsonPlace place = list.element(index);
    if (scalar < last)
        place.fail(fmt::format("has scalar {}, below the {} before it; sort the nodes by scalar", scalar, last));
    if (index >= 2 && scalar == last && last == beforeLast) {
        place.fail(fmt::format("is the third node at scalar {}; two make a jump, leave one out", scalar));
    }
}

std::vector<ColorNode> colorNodes(const JsonPlace& list) {
    list.array("[[s, r, g, b], …]");
    if (list.size() == 0) list.fail("is empty, must have at least one node [s, r, g, b]");
    std::vector<ColorNode> nodes;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const JsonPlace node = list.element(i).array("[s, r, g, b]");
        if (node.size() != 4)
            node.fail(fmt::format("has {} numbers, a color node has four: [s, r, g, b]", node.size()));
        const char* what = "a color channel (divide channels of 0 to 255 by 255)";
        nodes.push_back(
            {node.element(0).number(),
             {node.element(1).fraction(what), node.element(2).fraction(what), node.element(3).fraction(what)}});
        if (i > 0) requireNodeOrder(list, i, nodes[i > 1 ? i - 2 : 0].scalar, nodes[i - 1].scalar, nodes[i].scalar);
    }
    return nodes;
}

std::vector<ExtinctionNode> extinctionNodes(const JsonPlace& list) {
    list.array("[[s, tau], …]");
    if (list.size() == 0) list.fail("is empty, must have at least one node [s, tau]");
    std::vector<ExtinctionNode> nodes;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const JsonPlace node = list.element(i).array("[s, tau]");
        if (node.size() != 2)
            node.fail(fmt::format("has {} numbers, an extinction node has two: [s, tau]", node.size()));
        const double extinction = node.element(1).number();
        if (extinction < 0.0)
            node.element(1).fail(fmt::format("is {}, but extinction must not be negative", extinction));
        nodes.push_back({node.element(0).number(), extinction});
        if (i > 0) requireNodeOrder(list, i, nodes[i > 1 ? i - 2 : 0].scalar, nodes[i - 1].scalar, nodes[i].scalar);
    }
    return nodes;
}

/// In the order of their values; those at one value keep the order of the file.
std::vector<Isosurface> isosurfaces(const JsonPlace& list) {
    list.array("[{\"value\": v, \"opacity\": a, \"color\": [r, g, b]}, …]");
    std::vector<Isosurface> surfaces;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const JsonPlace one = list.element(i);
        if (!one.value().is_object())
            one.fail("must be an object: {\"value\": v, \"opacity\": a, \"color\": [r, g, b]}");
        requireKnownKeys(one, {"value", "opacity", "color"});
        for (const char* key : {"value", "opacity", "color"}) {
            if (!one.value().contains(key)) one.fail(fmt::format("has no \"{}\"; add it", key));
        }
        surfaces.push_back(
            {one.member("value").number(), one.member("opacity").fraction("an opacity"), one.member("color").color()});
    }
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const Isosurface& a, const Isosurface& b) { return a.value < b.value; });
    return surfaces;
}

std::vector<OpacityNode> opacityNodes(const JsonPlace& list) {
    list.array("[[s, alpha], …], or a word such as \"linear\"");
    if (list.size() == 0) list.fail("is empty, must have at least one node [s, alpha]");
    std::vector<OpacityNode> nodes;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const JsonPlace node = list.element(i).array("[s, alpha]");
        if (node.size() != 2)
            node.fail(fmt::format("has {} numbers, an opacity node has two: [s, alpha]", node.size()));
        nodes.push_back({node.element(0).number(), node.element(1).fraction("an opacity")});
        if (i > 0) requireNodeOrder(list, i, nodes[i > 1 ? i - 2 : 0].scalar, nodes[i - 1].scalar, nodes[i].scalar);
    }
    return nodes;
}

/// What complains of a word, with the place where it stands.
template <class Make>
auto madeOf(const JsonPlace& place, const Make& make) {
    try {
        return make(place.text());
    } catch (const std::runtime_error& error) {
        place.fail(fmt::format("is unknown: {}", error.what()));
    }
}

/// Colours and opacity by name, and how a function is fitted to a field. Words count in fractions of the field's range.
void readWords(const JsonPlace& root, TransferFunction& function) {
    auto has = [&](const char* key) { return root.value().contains(key); };
    for (const auto& [word, nodes] : {std::pair{"colorMap", "color"}, std::pair{"opacity", "extinction"}})
        if (has(word) && has(nodes))
            root.fail(fmt::format("has both \"{}\" and \"{}\"; leave one of them out", word, nodes));
    const bool wordOfOpacity = has("opacity") && root.member("opacity").value().is_string();
    if ((has("colorMap") || wordOfOpacity) && has("normalized") && !function.normalized)
        root.fail(
            "has a name in the place of nodes, which counts in fractions of the range; set \"normalized\" to true, or "
            "leave it out");
    if (has("colorMap")) {
        ColorMap map = madeOf(root.member("colorMap"), [](const std::string& name) { return colorMap(name); });
        function.color = std::move(map.nodes);
        function.categories = std::move(map.categories);
        function.normalized = true;
    }
    if (wordOfOpacity) {
        function.opacity = madeOf(root.member("opacity"), [](const std::string& word) { return opacityOfWord(word); });
        function.normalized = true;
    } else if (has("opacity")) {
        function.opacity = opacityNodes(root.member("opacity"));
    }
    const auto positive = [&](const char* key) {
        const double value = root.member(key).number();
        if (!(value > 0.0)) root.member(key).fail(fmt::format("is {}, must be above 0", value));
        return value;
    };
    if (has("unitDistance")) function.unitDistance = positive("unitDistance");
    if (has("opacityScale")) function.opacityScale = positive("opacityScale");
    if (has("logScale")) function.logarithmic = root.member("logScale").boolean();
    if (has("range")) {
        const JsonPlace range = root.member("range").array("[low, high]");
        if (range.size() != 2) range.fail(fmt::format("has {} numbers, must have two: [low, high]", range.size()));
        function.range = glm::dvec2(range.element(0).number(), range.element(1).number());
        if (!(function.range->x <= function.range->y)) range.fail("has its higher end first; write [low, high]");
    }
}

TransferFunction functionFrom(const JsonPlace& root) {
    if (!root.value().is_object()) {
        root.fail(
            "is not a transfer function; write an object {\"color\": …, \"extinction\": …} or export a color map from "
            "ParaView");
    }
    requireKnownKeys(root, {"color", "colorMap", "extinction", "opacity", "unitDistance", "opacityScale", "isosurfaces",
                            "normalized", "logScale", "range", "extinctionPerExtent"});
    auto has = [&](const char* key) { return root.value().contains(key); };
    TransferFunction function;
    if (has("normalized")) function.normalized = root.member("normalized").boolean();
    readWords(root, function);
    if (has("isosurfaces")) function.isosurfaces = isosurfaces(root.member("isosurfaces"));
    if (has("extinction")) function.extinction = extinctionNodes(root.member("extinction"));
    if (has("color")) function.color = colorNodes(root.member("color"));
    if (has("extinctionPerExtent")) function.extinctionPerExtent = root.member("extinctionPerExtent").boolean();
    if (has("colorMap") && !has("extinction") && !has("opacity") && !has("isosurfaces")) {
        function.extinction = suggestedExtinction();
        function.extinctionPerExtent = function.extinctionSuggested = true;
    }

    if (function.extinction.empty() && function.opacity.empty() && function.isosurfaces.empty()) {
        root.fail(
            "has neither \"extinction\" nor \"isosurfaces\", so nothing could be seen; add \"extinction\": [[s, tau], "
            "…] or \"opacity\": \"linear\"");
    }
    const bool colored = !function.color.empty() || !function.categories.empty();
    if (!colored && (!function.extinction.empty() || !function.opacity.empty()))
        root.fail("has no \"color\"; add \"color\": [[s, r, g, b], …] or \"colorMap\": \"viridis\"");
    if (!colored) {  // isosurfaces only: modes that colour by the scalar alone use their colours
        for (const Isosurface& surface : function.isosurfaces) {
            if (function.color.empty() || surface.value > function.color.back().scalar) {
                function.color.push_back({surface.value, surface.color});
            }
        }
    }
    return function;
}

/// The library's message without its own prefix "[json.exception.…] ".
std::string withoutPrefix(const std::string& message) {
    const auto end = message.find("] ");
    return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

glm::dvec3 TransferFunction::colorAt(double scalar) const {
    return valueAt(color, &ColorNode::color, scalar, glm::dvec3{0.0});
}

double TransferFunction::extinctionAt(double scalar) const {
    return valueAt(extinction, &ExtinctionNode::extinction, scalar, 0.0);
}

TransferFunction parseTransferFunction(const std::string& json, const std::string& origin) {
    if (json.find_first_not_of(" \t\r\n\xef\xbb\xbf") != std::string::npos &&
        json[json.find_first_not_of(" \t\r\n\xef\xbb\xbf")] == '<') {
        return paraViewColorMap(xmlColorMap(json, origin), origin);
    }
    nlohmann::json document;
    try {
        document = nlohmann::json::parse(json);
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(
            fmt::format("{}: is not valid JSON: {}; mend it there", origin, withoutPrefix(error.what())));
    }
    return isParaViewColorMap(document) ? paraViewColorMap(document, origin)
                                        : functionFrom(JsonPlace(document, origin));
}

/// What other programs keep colours in and what to do with it.
void refuseOtherKinds(const std::string& path) {
    static const std::array<std::array<const char*, 2>, 8> kinds{{{".vp", "a volume property of 3D Slicer"},
                                                                  {".ctbl", "a color table of 3D Slicer"},
                                                                  {".cpt", "a palette of GMT"},
                                                                  {".gpl", "a palette of GIMP"},
                                                                  {".lut", "a lookup table"},
                                                                  {".act", "a color table of Photoshop"},
                                                                  {".cmap", "a color map"},
                                                                  {".xmf", "XDMF"}}};
    for (const auto& [extension, kind] : kinds) {
        if (path.ends_with(extension)) {
            throw std::runtime_error(
                fmt::format("{}: is {}, which is not read; write its points as {{\"color\": [[s, r, g, b], ...], "
                            "\"extinction\": [[s, t], ...]}}, or export a color map from ParaView",
                            path, kind));
        }
    }
}

TransferFunction readTransferFunction(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be opened; check the path and its permissions", path));
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad() || text.empty()) {
        throw std::runtime_error(fmt::format("{}: is empty or cannot be read; give a JSON transfer function", path));
    }
    refuseOtherKinds(path);
    return parseTransferFunction(text, path);
}

}  // namespace tetralux::preint
