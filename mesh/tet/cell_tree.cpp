// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/cell_tree.h>

#include <limits>
#include <numeric>

#include <glm/common.hpp>

namespace tetralux::mesh {

namespace {
constexpr std::uint32_t leafCells = 4;
}

CellTree::CellTree(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells) {
    if (cells.empty()) return;
    order_.resize(cells.size());
    std::iota(order_.begin(), order_.end(), CellIndex{0});
    std::vector<glm::dvec3> centres(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (const PointIndex point : cells[i]) centres[i] += 0.25 * positions[point];

    nodes_.push_back({glm::dvec3(0), glm::dvec3(0), 0, static_cast<std::uint32_t>(cells.size())});
    for (std::size_t n = 0; n < nodes_.size(); ++n) {  // nodes are appended while they are split
        const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low), least(low), most(high);
        for (std::uint32_t i = first; i < first + count; ++i) {
            for (const PointIndex point : cells[order_[i]]) {
                low = glm::min(low, positions[point]);
                high = glm::max(high, positions[point]);
            }
            least = glm::min(least, centres[order_[i]]);
            most = glm::max(most, centres[order_[i]]);
        }
        nodes_[n].low = low;
        nodes_[n].high = high;
        if (count <= leafCells) continue;
        const glm::dvec3 size = most - least;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t half = count / 2;
        const auto begin = order_.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [&](CellIndex a, CellIndex b) {
            return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
        });
        nodes_[n].first = static_cast<std::uint32_t>(nodes_.size());
        nodes_[n].count = 0;
        nodes_.push_back({low, high, first, half});
        nodes_.push_back({low, high, first + half, count - half});
    }
}

}  // namespace tetralux::mesh
