// SPDX-License-Identifier: Apache-2.0
#include <apps/view/transfer_nodes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::apps::view {

namespace {

template <class Node>
Node& nodeAt(std::vector<Node>& nodes, std::size_t number, const char* kind) {
    if (number >= nodes.size())
        throw std::runtime_error(
            fmt::format("there is no {} {}; there are {}, counted from 0", kind, number, nodes.size()));
    return nodes[number];
}

template <class Node>
void eraseNode(std::vector<Node>& nodes, std::size_t number, const char* kind) {
    nodeAt(nodes, number, kind);
    nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(number));
}

void checkNode(double scalar, double extinction) {
    if (!std::isfinite(scalar) || !std::isfinite(extinction) || extinction < 0.0)
        throw std::runtime_error(
            fmt::format("node {}, {}: give a finite scalar and an extinction from 0", scalar, extinction));
}

std::string colorText(const glm::dvec3& c) {
    return fmt::format("{},{},{}", c.x, c.y, c.z);
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ",") + part;
    return text;
}

}  // namespace

std::string functionText(const preint::TransferFunction& function) {
    std::vector<std::string> colors, extinctions, surfaces;
    for (const preint::ColorNode& node : function.color)
        colors.push_back(fmt::format("[{},{}]", node.scalar, colorText(node.color)));
    for (const preint::ExtinctionNode& node : function.extinction)
        extinctions.push_back(fmt::format("[{},{}]", node.scalar, node.extinction));
    for (const preint::Isosurface& surface : function.isosurfaces)
        surfaces.push_back(fmt::format(R"({{"value":{},"opacity":{},"color":[{}]}})", surface.value, surface.opacity,
                                       colorText(surface.color)));
    std::string text = fmt::format(R"({{"color":[{}])", joined(colors));
    if (!extinctions.empty()) text += fmt::format(R"(,"extinction":[{}])", joined(extinctions));
    if (!surfaces.empty()) text += fmt::format(R"(,"isosurfaces":[{}])", joined(surfaces));
    return text + "}";
}

void setFunction(OptionWords& words, const preint::TransferFunction& function) {
    for (const char* name : {"--opacity", "--opacity-distance", "--range", "--window", "--log", "--isosurfaces"})
        words.remove(name);
    words.set("--tf", functionText(function));
}

std::size_t addNode(preint::TransferFunction& function, double scalar, double extinction) {
    checkNode(scalar, extinction);
    auto& nodes = function.extinction;
    const auto at = std::upper_bound(nodes.begin(), nodes.end(), scalar,
                                     [](double s, const preint::ExtinctionNode& node) { return s < node.scalar; });
    const auto number = static_cast<std::size_t>(at - nodes.begin());
    nodes.insert(at, {scalar, extinction});
    return number;
}

void moveNode(preint::TransferFunction& function, std::size_t node, double scalar, double extinction) {
    checkNode(scalar, extinction);
    auto& nodes = function.extinction;
    preint::ExtinctionNode& moved = nodeAt(nodes, node, "node");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double low = node > 0 ? nodes[node - 1].scalar : -infinity;
    const double high = node + 1 < nodes.size() ? nodes[node + 1].scalar : infinity;
    moved = {std::clamp(scalar, low, high), extinction};
}

void removeNode(preint::TransferFunction& function, std::size_t node) {
    nodeAt(function.extinction, node, "node");
    if (function.extinction.size() > 1) eraseNode(function.extinction, node, "node");
}

void setColor(preint::TransferFunction& function, double scalar, const glm::dvec3& color) {
    checkNode(scalar, 0.0);
    for (int channel = 0; channel < 3; ++channel)
        if (!(color[channel] >= 0.0 && color[channel] <= 1.0))
            throw std::runtime_error(fmt::format("colour {}: give r,g,b from 0 to 1", colorText(color)));
    auto& nodes = function.color;
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), scalar,
                                     [](const preint::ColorNode& node, double s) { return node.scalar < s; });
    if (at != nodes.end() && at->scalar == scalar)
        at->color = color;
    else
        nodes.insert(at, {scalar, color});
}

void removeColor(preint::TransferFunction& function, std::size_t node) {
    nodeAt(function.color, node, "colour");
    if (function.color.size() > 1) eraseNode(function.color, node, "colour");
}

void addIsosurface(preint::TransferFunction& function, const preint::Isosurface& surface) {
    checkNode(surface.value, surface.opacity);
    if (surface.opacity > 1.0)
        throw std::runtime_error(fmt::format("isosurface: an opacity of {}; give one from 0 to 1", surface.opacity));
    auto& surfaces = function.isosurfaces;
    const auto at = std::upper_bound(surfaces.begin(), surfaces.end(), surface.value,
                                     [](double v, const preint::Isosurface& other) { return v < other.value; });
    surfaces.insert(at, surface);
}

void removeIsosurface(preint::TransferFunction& function, std::size_t number) {
    eraseNode(function.isosurfaces, number, "isosurface");
}

void scaleExtinction(preint::TransferFunction& function, double factor) {
    if (!(factor > 0.0) || !std::isfinite(factor))
        throw std::runtime_error(fmt::format("density {}: give a factor above 0", factor));
    for (preint::ExtinctionNode& node : function.extinction) node.extinction *= factor;
}

}  // namespace tetralux::apps::view
