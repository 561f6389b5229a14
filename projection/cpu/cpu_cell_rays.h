// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where the rays of a block of pixels run inside a cell of a batch (cell_interval.glsl). Included once per instruction
/// set.
#include <projection/cpu/cpu_cell_batch.h>
#include <projection/cpu/cpu_segment.h>

#include <projection/cpu/cpu_tile_buffers.h>

#if defined(TETRALUX_CPU_CELL_RAYS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_CELL_RAYS_H
#undef TETRALUX_CPU_CELL_RAYS_H
#else
#define TETRALUX_CPU_CELL_RAYS_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// Entering and leaving inverse depth ratio of the block's rays in cell j.
HWY_INLINE void cellInterval(const CellBatch& batch, std::size_t j, const FaceOrder& order, real dx, real dy, real& in,
                             real& out) {
    auto inverseDepth = [&](int k) HWY_ATTR {
        const auto& plane = batch.plane[order.face[k]];
        return planeInverseDepth(cell_real{plane[0][j]}, cell_real{plane[1][j]}, cell_real{plane[2][j]}, dx, dy);
    };
    in = real(batch.inverseDepthNear[j]);
    out = real(batch.inverseDepthFar[j]);
    const real r0 = inverseDepth(0), r1 = inverseDepth(1), r2 = inverseDepth(2), r3 = inverseDepth(3);
    switch (order.fronts) {
        case 1:
            in = min(in, r0);
            out = max(max(out, r1), max(r2, r3));
            return;
        case 2:
            in = min(min(in, r0), r1);
            out = max(max(out, r2), r3);
            return;
        case 3:
            in = min(min(in, r0), min(r1, r2));
            out = max(out, r3);
            return;
        case 0:
            out = max(max(out, r0), max(r1, max(r2, r3)));
            return;
        default:
            in = real(-1e30f);  // seen from nowhere outside: a flat cell
    }
}

/// The pixels of a cell, the faces that bound its rays, and the pieces of the transfer function that it meets.
struct CellBlocks {
    std::size_t j;
    const FaceOrder* order;
    int x0, y0, x1, y1;
    std::size_t first, last;
};

/// A block of pixels of one cell.
struct Block {
    std::size_t j, at;     ///< cell of the batch, place in the accumulators
    int x, y;              ///< first pixel within the tile
    real dx, dy, in, out;  ///< pixels from the cell's reference point, inverse depth there
    real rayLength;        ///< per unit depth
    bool inCutLayer;       ///< the segments lie in the layer of a cut: its normal is lit
};

/// scalarFall of the block's rays in cell j.
HWY_INLINE real cellFall(const CellBatch& batch, std::size_t j, real dx, real dy, bool orthographic) {
    real across(0.0f);
    if (!orthographic) across = real(batch.scalarPerX[j]) * dx + real(batch.scalarPerY[j]) * dy;
    return scalarFall(across, cell_real{batch.scalarPerInverseDepth[j]});
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
