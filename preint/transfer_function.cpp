// SPDX-License-Identifier: Apache-2.0
#include <preint/transfer_function.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <preint/json_reading.h>

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

TransferFunction functionFrom(const JsonPlace& root) {
    if (!root.value().is_object()) {
        root.fail(
            "is not a transfer function; write an object {\"color\": …, \"extinction\": …} or export a color map from "
            "ParaView");
    }
    requireKnownKeys(root, {"color", "extinction", "isosurfaces", "normalized", "extinctionPerExtent"});
    auto has = [&](const char* key) { return root.value().contains(key); };
    TransferFunction function;
    if (has("isosurfaces")) function.isosurfaces = isosurfaces(root.member("isosurfaces"));
    if (has("extinction")) function.extinction = extinctionNodes(root.member("extinction"));
    if (has("color")) function.color = colorNodes(root.member("color"));
    if (has("normalized")) function.normalized = root.member("normalized").boolean();
    if (has("extinctionPerExtent")) function.extinctionPerExtent = root.member("extinctionPerExtent").boolean();

    if (function.extinction.empty() && function.isosurfaces.empty()) {
        root.fail(
            "has neither \"extinction\" nor \"isosurfaces\", so nothing could be seen; add \"extinction\": [[s, tau], "
            "…]");
    }
    if (function.color.empty() && !function.extinction.empty())
        root.fail("has no \"color\"; add \"color\": [[s, r, g, b], …]");
    if (function.color.empty()) {  // isosurfaces only: modes that colour by the scalar alone use their colours
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

TransferFunction resolved(const TransferFunction& function, double scalarMin, double scalarMax, double extent) {
    TransferFunction absolute = function;
    absolute.normalized = false;
    absolute.extinctionPerExtent = false;
    constexpr double largest = 1e300;  // finite, however large the fractions and small the extent
    if (function.normalized) {
        // A constant field has no range: it shows as the middle of one.
        const double half = scalarMax > scalarMin ? 0.0 : 0.5 * std::max(1.0, std::abs(scalarMin));
        const double low = scalarMin - half, high = scalarMax + half;
        const auto scalarOf = [&](double fraction) {
            return std::clamp(std::lerp(low, high, fraction), -largest, largest);
        };
        for (ColorNode& node : absolute.color) node.scalar = scalarOf(node.scalar);
        for (ExtinctionNode& node : absolute.extinction) node.scalar = scalarOf(node.scalar);
        for (Isosurface& surface : absolute.isosurfaces) surface.value = scalarOf(surface.value);
    }
    if (function.extinctionPerExtent && extent > 0.0) {
        for (ExtinctionNode& node : absolute.extinction) node.extinction = std::min(node.extinction / extent, largest);
    }
    return absolute;
}

namespace {

/// The first node's value below `above`, the last one's from there on.
template <class Node>
void makeStep(std::vector<Node>& nodes, double above) {
    if (nodes.empty()) return;
    nodes = {nodes.front(), nodes.back()};
    for (Node& node : nodes) node.scalar = above;
}

TransferFunction stepAt(double scalar, const TransferFunction& function, double extent) {
    TransferFunction step = function;
    const double above = std::nextafter(scalar, std::numeric_limits<double>::infinity());  // a jump holds from above
    makeStep(step.color, above);
    makeStep(step.extinction, above);
    for (Isosurface& surface : step.isosurfaces) surface.value = above;
    step.normalized = false;
    return resolved(step, above, above, extent);
}

}  // namespace

TransferFunction windowed(const TransferFunction& function, double low, double high, double extent) {
    if (low == high) return stepAt(low, function, extent);
    if (function.normalized) return resolved(function, low, high, extent);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    const auto include = [&](double scalar) {
        first = std::min(first, scalar);
        last = std::max(last, scalar);
    };
    for (const ColorNode& node : function.color) include(node.scalar);
    for (const ExtinctionNode& node : function.extinction) include(node.scalar);
    for (const Isosurface& surface : function.isosurfaces) include(surface.value);
    if (!(last > first))
        throw std::runtime_error(
            "transfer function: a window cannot stretch it, all its nodes are at one scalar; give it two or leave the "
            "window out");
    TransferFunction fractions = function;
    fractions.normalized = true;
    const auto fraction = [&](double scalar) { return (scalar - first) / (last - first); };
    for (ColorNode& node : fractions.color) node.scalar = fraction(node.scalar);
    for (ExtinctionNode& node : fractions.extinction) node.scalar = fraction(node.scalar);
    for (Isosurface& surface : fractions.isosurfaces) surface.value = fraction(surface.value);
    return resolved(fractions, low, high, extent);
}

}  // namespace tetralux::preint
