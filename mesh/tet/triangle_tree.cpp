// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/triangle_tree.h>

#include <algorithm>
#include <numeric>

#include <glm/common.hpp>

namespace tetralux::mesh {
namespace {

constexpr std::uint32_t leafSize = 4;

}  // namespace

TriangleTree::TriangleTree(const std::vector<Corners>& triangles) {
    order_.resize(triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    if (!triangles.empty()) {
        nodes_.reserve(2 * triangles.size() / leafSize + 16);
        nodes_.emplace_back();
        build(0, 0, static_cast<std::uint32_t>(triangles.size()), triangles);
    }
}

/// Halves at the median along the longest side, so the depth stays below the logarithm of the number of triangles.
void TriangleTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count,
                         const std::vector<Corners>& triangles) {
    glm::dvec3 low = triangles[order_[first]][0];
    glm::dvec3 high = low;
    for (std::uint32_t i = first; i < first + count; ++i) {
        for (const glm::dvec3& corner : triangles[order_[i]]) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    if (count <= leafSize) {
        nodes_[node] = {low, high, first, count};
        return;
    }
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto key = [&](std::uint32_t t) {
        return triangles[t][0][axis] + triangles[t][1][axis] + triangles[t][2][axis];
    };
    const auto begin = order_.begin() + first;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count,
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    const std::uint32_t child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node] = {low, high, child, 0};
    nodes_.emplace_back();
    nodes_.emplace_back();
    build(child, first, half, triangles);
    build(child + 1, first + half, count - half, triangles);
}

}  // namespace tetralux::mesh
