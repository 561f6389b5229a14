// SPDX-License-Identifier: Apache-2.0
/// \file
/// Planes and scalar gradient of one projected cell, in doubles: projected_cell.inl for a single cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tetralux::projection::single_cell {

// what the formulas call
using std::abs, std::max, std::min;
inline double select(bool condition, double ifTrue, double ifFalse) {
    return condition ? ifTrue : ifFalse;
}
inline double copySign(double magnitude, double sign) {
    return std::copysign(magnitude, sign);
}
#define TETRALUX_CELL_FUNCTION inline
#include <projection/projected_cell.inl>
#undef TETRALUX_CELL_FUNCTION

/// Puts `order`, by which the numbers of `points` then ascend, in place of 0 1 2 …; true when that turns a cell inside
/// out (or a face over).
template <class Point, std::size_t count>
bool sortedCorners(const std::array<Point, count>& points, std::array<std::size_t, count>& order) {
    for (std::size_t i = 0; i < count; ++i) order[i] = i;
    bool odd = false;
    for (std::size_t i = 1; i < count; ++i)
        for (std::size_t j = i; j > 0 && points[order[j]] < points[order[j - 1]]; --j) {
            std::swap(order[j], order[j - 1]);
            odd = !odd;
        }
    return odd;
}

}  // namespace tetralux::projection::single_cell
