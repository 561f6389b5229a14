// SPDX-License-Identifier: Apache-2.0
#include <preint/log_scale.h>

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tetralux::preint {
namespace {

/// Puts further nodes between: over a ratio q of scalars a chord of the logarithm is off by at most (ln q)² / 8, and
/// `change(a, b)` is how much there is between two nodes, in units of the error allowed.
template <class Node, class Change, class Between>
std::vector<Node> taken(const std::vector<Node>& nodes, const std::function<double(double)>& scalarOf,
                        const Change& change, const Between& between) {
    constexpr double mostPieces = 1000;
    std::vector<Node> result;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i > 0 && nodes[i].scalar > nodes[i - 1].scalar) {
            const Node &low = nodes[i - 1], &high = nodes[i];
            const double pieces = std::ceil(std::sqrt((high.scalar - low.scalar) * change(low, high) / 8.0));
            const int count = static_cast<int>(std::min(pieces, mostPieces));
            for (int k = 1; k < count; ++k) {
                const double fraction = static_cast<double>(k) / count;
                Node node = between(low, high, fraction);
                node.scalar = scalarOf(std::lerp(low.scalar, high.scalar, fraction));
                result.push_back(node);
            }
        }
        result.push_back(nodes[i]);
        result.back().scalar = scalarOf(nodes[i].scalar);
    }
    return result;
}

}  // namespace

std::vector<ColorNode> fromLogarithms(const std::vector<ColorNode>& nodes,
                                      const std::function<double(double)>& scalarOf) {
    const auto change = [](const ColorNode& a, const ColorNode& b) {
        const glm::dvec3 difference = glm::abs(b.color - a.color);
        return 1024.0 * std::max({difference.x, difference.y, difference.z});
    };
    return taken(nodes, scalarOf, change, [](const ColorNode& a, const ColorNode& b, double fraction) {
        return ColorNode{0.0, glm::mix(a.color, b.color, fraction)};
    });
}

std::vector<OpacityNode> fromLogarithms(const std::vector<OpacityNode>& nodes,
                                        const std::function<double(double)>& scalarOf) {
    const auto change = [](const OpacityNode& a, const OpacityNode& b) {
        return 1024.0 * std::abs(b.opacity - a.opacity);
    };
    return taken(nodes, scalarOf, change, [](const OpacityNode& a, const OpacityNode& b, double fraction) {
        return OpacityNode{0.0, std::lerp(a.opacity, b.opacity, fraction)};
    });
}

std::vector<ExtinctionNode> fromLogarithms(const std::vector<ExtinctionNode>& nodes,
                                           const std::function<double(double)>& scalarOf) {
    double largest = 0.0;
    for (const ExtinctionNode& node : nodes) largest = std::max(largest, node.extinction);
    const auto change = [&](const ExtinctionNode& a, const ExtinctionNode& b) {
        return largest > 0.0 ? 1024.0 * std::abs(b.extinction - a.extinction) / largest : 0.0;
    };
    return taken(nodes, scalarOf, change, [](const ExtinctionNode& a, const ExtinctionNode& b, double fraction) {
        return ExtinctionNode{0.0, std::lerp(a.extinction, b.extinction, fraction)};
    });
}

}  // namespace tetralux::preint
