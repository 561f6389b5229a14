// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

namespace tetralux::mesh {

/// Items in a tree of bounding boxes: those in a box, along a line. What the items are and how the tree
/// is built is the derived class's matter; no node may be deeper than 64. Visits come in an order that depends on the
/// items alone, and end with one that returns false (if it returns anything).
class BoxTree {
public:
    /// Calls `visit(item)` for every item whose bounding box touches the box from `low` to `high`, and for some others
    /// of the same leaves.
    template <class Visit>
    void forEachInBox(const glm::dvec3& low, const glm::dvec3& high, const Visit& visit) const {
        walk(
            [&](const Node& node) {
                bool apart = false;
                for (int axis = 0; axis < 3; ++axis) {
                    apart = apart || node.low[axis] > high[axis] || node.high[axis] < low[axis];
                }
                return !apart;
            },
            visit);
    }

    /// The same for bounding boxes that the line origin + t·direction meets at 0 ≤ t ≤ `end`. No component of
    /// `direction` may be zero.
    template <class Visit>
    void forEachAlong(const glm::dvec3& origin, const glm::dvec3& direction, double end, const Visit& visit) const {
        const glm::dvec3 inverse = 1.0 / direction;
        walk(
            [&](const Node& node) {
                double in = 0, out = end;
                for (int axis = 0; axis < 3; ++axis) {
                    const double a = (node.low[axis] - origin[axis]) * inverse[axis];
                    const double b = (node.high[axis] - origin[axis]) * inverse[axis];
                    in = std::max(in, std::min(a, b));
                    out = std::min(out, std::max(a, b));
                }
                return in <= out;
            },
            visit);
    }

protected:
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t first;  ///< child (and the next one), or place in order_ for a leaf
        std::uint32_t count;  ///< items of a leaf, 0 for others
    };

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;

private:
    template <class Visit>
    static bool goesOn(const Visit& visit, std::uint32_t item) {
        if constexpr (std::is_void_v<decltype(visit(item))>) {
            visit(item);
            return true;
        } else {
            return visit(item);
        }
    }

    template <class Meets, class Visit>
    void walk(const Meets& meets, const Visit& visit) const {
        std::array<std::uint32_t, 128> open;
        std::size_t count = 0;
        if (!nodes_.empty()) {
            open[count++] = 0;
        }
        while (count > 0) {
            const Node& node = nodes_[open[--count]];
            if (!meets(node)) {
                continue;
            }
            if (node.count > 0) {
                for (std::uint32_t i = 0; i < node.count; ++i) {
                    if (!goesOn(visit, order_[node.first + i])) {
                        return;
                    }
                }
            } else {
                open[count++] = node.first;
                open[count++] = node.first + 1;
            }
        }
    }
};

}  // namespace tetralux::mesh
