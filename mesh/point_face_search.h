// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace tetralux::mesh {

/// Triangles in a tree of bounding boxes, to find those near a point.
class PointFaceSearch {
public:
    using Corners = std::array<glm::dvec3, 3>;

    explicit PointFaceSearch(const std::vector<Corners>& triangles);

    /// Calls `visit(triangle)` for every triangle whose bounding box, widened by `reach`, holds `x`.
    template <class Visit>
    void forEachNear(const glm::dvec3& x, double reach, const Visit& visit) const {
        std::array<std::uint32_t, 128> open;
        std::size_t count = 0;
        if (!nodes_.empty()) {
            open[count++] = 0;
        }
        while (count > 0) {
            const Node& node = nodes_[open[--count]];
            if (!isNear(node, x, reach)) {
                continue;
            }
            if (node.count > 0) {
                for (std::uint32_t i = 0; i < node.count; ++i) {
                    visit(order_[node.first + i]);
                }
            } else {
                open[count++] = node.first;
                open[count++] = node.first + 1;
            }
        }
    }

private:
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t first;  ///< child (and the next one), or place in order_ for a leaf
        std::uint32_t count;  ///< triangles of a leaf, 0 for others
    };

    static bool isNear(const Node& node, const glm::dvec3& x, double reach) {
        return x.x >= node.low.x - reach && x.x <= node.high.x + reach && x.y >= node.low.y - reach &&
               x.y <= node.high.y + reach && x.z >= node.low.z - reach && x.z <= node.high.z + reach;
    }
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, const std::vector<Corners>& triangles);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

}  // namespace tetralux::mesh
