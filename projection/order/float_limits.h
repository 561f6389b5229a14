// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <mesh/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/scene.h>

namespace tetralux::projection {

/// Cells in which float planes (cell_setup.h) may miss the optical depth of a segment by more than 1e-3. A plane errs
/// by some 1e-7 of the cell's longest edge e, whatever its thickness. So the depth τ·l errs by up to 3e-7·τ·e, which
/// shows in flat cells only, since others of that extinction are opaque; and the scalar of a cell with least altitude h
/// errs by up to 1e-7·e/h of its range. An
/// isosurface within the range of a cell with e/h > 3000 may be met twice or never, since that cell and its neighbour
/// differ about the scalar on their face; with `scalarsShow`, as in pictures of the colour at the first hit, such cells
/// count anywhere. A ramp of extinction makes depth err by its slope times the rounding of the scalar (6e-8 of the
/// field's range) times e; engines that look segments up in a table (`fromTable`) cannot hold ramps on which depth
/// rises by hundreds within a cell, however fine the texels. Neither counts where the whole cell is opaque. Empty for
/// every scene but those of extreme extinction or flatness: engines have the pixels of these cells composed exactly.
std::vector<mesh::CellIndex> cellsBeyondFloat(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                                              preint::Integral integral, bool scalarsShow = false,
                                              bool fromTable = false);

}  // namespace tetralux::projection
