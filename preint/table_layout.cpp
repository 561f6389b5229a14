// SPDX-License-Identifier: Apache-2.0
#include <preint/table_layout.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::preint {
namespace {

/// Scalars at which two nodes with different values stand.
template <class Node, class Value>
void addJumps(const std::vector<Node>& nodes, Value Node::*value, std::vector<double>& jumps) {
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (nodes[i].scalar == nodes[i - 1].scalar && nodes[i].*value != nodes[i - 1].*value) jumps.push_back(nodes[i].scalar);
    }
}

std::vector<double> jumpsWithin(const TransferFunction& function, double low, double high) {
    std::vector<double> jumps;
    addJumps(function.color, &ColorNode::color, jumps);
    addJumps(function.extinction, &ExtinctionNode::extinction, jumps);
    std::sort(jumps.begin(), jumps.end());
    jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
    std::erase_if(jumps, [&](double scalar) { return !(scalar > low && scalar < high); });
    return jumps;
}

}  // namespace

void layOutTable(const ExactIntegral& exact, double scalarMin, double scalarMax, PreintegrationTable& table) {
    if (!std::isfinite(scalarMin) || !std::isfinite(scalarMax) || scalarMax < scalarMin) {
        throw std::runtime_error(fmt::format("scalar range [{}, {}] of a pre-integration table is not a range; give finite, ascending ends",
                                             scalarMin, scalarMax));
    }
    const std::vector<double> jumps = jumpsWithin(exact.function(), scalarMin, scalarMax);
    std::vector<Interface> interfaces;
    for (const Isosurface& surface : exact.function().isosurfaces) {
        if (surface.value > scalarMin && surface.value <= scalarMax && surface.opacity > 0.0) {
            interfaces.push_back({surface.value, surface.opacity, surface.color, 0, 0});
        }
    }
    for (const double jump : jumps) {
        const bool shared = std::any_of(interfaces.begin(), interfaces.end(), [&](const Interface& one) { return one.value == jump; });
        if (!shared) interfaces.push_back({jump, 0.0, glm::dvec3{0.0}, 0, 0});
    }
    std::stable_sort(interfaces.begin(), interfaces.end(), [](const Interface& a, const Interface& b) { return a.value < b.value; });

    auto zoneOf = [&](auto count) { return static_cast<int>(count - jumps.begin()); };
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        Interface& one = interfaces[i];
        one.zoneAbove = zoneOf(std::upper_bound(jumps.begin(), jumps.end(), one.value));
        one.zoneBelow = i > 0 ? interfaces[i - 1].zoneAbove : 0;  // of several at one value the first changes the zone
    }
    table.interfaces = std::move(interfaces);

    table.zones.clear();
    double low = scalarMin;
    for (const double jump : jumps) {
        table.zones.emplace_back(low, jump);
        low = jump;
    }
    table.zones.emplace_back(low, scalarMax);
}

}  // namespace tetralux::preint
