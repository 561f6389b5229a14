// SPDX-License-Identifier: Apache-2.0
/// \file
/// Heights of a grid by construction (see power_order.h for what heights are).
///
/// A grid with the lines x_i, y_j, z_k, each box of which is cut into the six tetrahedra about one of its diagonals
/// (Freudenthal 1942; Kuhn 1960), all diagonals in one direction, is regular with the heights
///
///     F(x) + G(y) + H(z) − e·(x·y + y·z + z·x)
///
/// with axes turned so that diagonals ascend along all three. Within a box the four points of two neighbours off their
/// common edge are a parallelogram, over which F, G and H are even and the product term is convex by e·Δx·Δy. At the
/// wall x = x_i between two boxes it is the slope along x that must grow: by F's change of slope there, less
/// e·(Δy + Δz). So F is given that change at each line, with the largest Δy and Δz, and a margin: the change that x²
/// has, x_{i+1} − x_{i−1}, and more where neighbouring lines are at very different distances.
#pragma once

#include <optional>
#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::projection {

/// One height per point, in the square of the unit of `points`; nothing unless the points are all crossings of
/// axis-parallel lines and the first cell follows three edges of a box. Other meshes cost next to nothing. The other
/// cells are not looked at: whether the heights are convex is for PowerOrder to check.
std::optional<std::vector<double>> gridHeights(const std::vector<glm::dvec3>& points, const mesh::Tetrahedron& first);

}  // namespace tetralux::projection
