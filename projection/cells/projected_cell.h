// SPDX-License-Identifier: Apache-2.0
/// \file
/// The shared texts of projected cells for one cell, in doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <projection/cells/camera_points.h>
#include <projection/cells/cell_constants.h>

namespace tetralux::projection::single_cell {

// what the formulas call
using glm::dot;
using std::abs, std::ceil, std::floor, std::max, std::min, std::round, std::sqrt;
using wide = double;
using Pair = glm::dvec2;
inline double select(bool condition, double ifTrue, double ifFalse) {
    return condition ? ifTrue : ifFalse;
}
inline double copySign(double magnitude, double sign) {
    return std::copysign(magnitude, sign);
}
#define TETRALUX_CELL_FUNCTION inline
#define TETRALUX_CELL_IN(type) const type&
#define TETRALUX_CELL_INOUT(type) type&
// each stands on those before it
// clang-format off
#include <projection/cells/cell_triple.inl>
#include <projection/cells/projected_cell.glsl>
#include <projection/cells/cell_depth_bounds.inl>
#include <projection/cells/covered_pixels.glsl>
#include <projection/cells/cell_outline.glsl>
// clang-format on
#undef TETRALUX_CELL_FUNCTION
#undef TETRALUX_CELL_IN
#undef TETRALUX_CELL_INOUT

inline CellView viewOf(const CameraFrame& frame) {
    return {sampleCentre(frame), frame.width, frame.height, frame.orthographic, frame.depthOrigin};
}

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
