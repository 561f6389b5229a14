// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <projection/order/order_keys.h>
#include <projection/order/power_order.h>

namespace tetralux::projection {

/// Puts cells in the order of their keys (order_keys.h) as doubles have them. Keeps its memory from frame to frame.
class KeySorter {
public:
    /// Nearest first; cells of equal keys stay as they were. Radix passes over 32 bits of the range that these cells'
    /// keys span, then runs of cells that those bits do not tell apart by the doubles: in meshes of millions of cells
    /// some hundred pairs a frame.
    void sort(const OrderKeys& keys, const glm::dvec4& eye, std::vector<mesh::CellIndex>& cells);

private:
    std::vector<double> values_;
    std::vector<KeyedCell> keyed_, scratch_;
    std::vector<mesh::CellIndex> sorted_;
};

}  // namespace tetralux::projection
