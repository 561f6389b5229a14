// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/scene.h>

namespace tetralux::projection {

/// What an engine and a picture ask of float.
struct FloatUse {
    enum class Gathers {
        Light,      ///< colour and optical depth, or either
        Crossings,  ///< where something first shows: of errors only those count that miss an isosurface
        Extreme,    ///< the largest or the smallest scalar
        Mean        ///< of the scalar by length
    };
    bool scalarsShow = false;  ///< the scalar is seen wherever a ray enters a cell: colour at the first hit
    bool fromTable = false;    ///< segments are looked up in a table
    bool silhouettes = false;  ///< depth is divided by |n·d|, and so are its errors
    bool addsUp = false;       ///< light of all segments counts, however much lies before it
    Gathers gathers = Gathers::Light;
};

/// Cells in which float planes (cell_setup.h) and float scalars may miss the optical depth of a segment by more than
/// 1e-3. A plane errs by some 1e-7 of the cell's longest edge e, whatever its thickness. So the depth τ·l errs by up to
/// 3e-7·τ·e, which shows in flat cells only, since others of that extinction are opaque; and the scalar of a cell with
/// least altitude h errs by up to 1e-7·e/h of its range. An isosurface within the range of a cell with e/h > 3000 may
/// be met twice or never, since that cell and its neighbour differ about the scalar on their face; with `scalarsShow`
/// such cells count anywhere. So do cells whose scalars differ by so little that they lie, or might, between the places
/// that isosurface_perturbation.h gives an isosurface in float and in double, and flat cells with a face upon which the
/// scalar is, nearly, that of an isosurface everywhere. Ramps of extinction and of colour, and jumps: float_limits.cpp;
/// with `fromTable` also cells in which depth rises by hundreds, unless extinction only rises over the range. Nothing
/// counts where the whole cell is opaque, but where light adds up. Empty for every scene but those of extreme
/// extinction, steepness or flatness: engines have the pixels of these cells composed exactly.
std::vector<mesh::CellIndex> cellsBeyondFloat(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                                              preint::Integral integral, const FloatUse& use = {});

}  // namespace tetralux::projection
