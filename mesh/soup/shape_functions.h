// SPDX-License-Identifier: Apache-2.0
/// \file
/// Shape functions of curved cells, whose points are numbered as in VTK's file formats.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace tetralux::mesh {

/// The order of a curved cell with that many points: 2 for the quadratic types, found from the number for Lagrange and
/// Bézier types of one order in all directions (1 to 10); nothing where there is none.
std::optional<int> curvedCellOrder(std::uint8_t type, std::size_t pointCount);

/// Where the points of such a cell lie: r, s and t in [0, 1], in a pyramid r and s over each layer. Needs an order.
std::vector<std::array<double, 3>> curvedCellPoints(std::uint8_t type, std::size_t pointCount);

/// Weights of the cell's points at each parametric place: one row per place. Needs an order.
std::vector<std::vector<double>> shapeFunctions(std::uint8_t type, std::size_t pointCount,
                                                const std::vector<std::array<double, 3>>& places);

}  // namespace tetralux::mesh
