// SPDX-License-Identifier: Apache-2.0
/// \file
/// The engine for processors: cells in visibility order into tiles of pixels, many threads, SIMD lanes.
///
///   project ─► cull ─► (sort: order of the cells) ─► bin ─► sort each tile's list ─► draw tiles: setup, intervals,
///   integrals points     cells                                 tiles
///
/// Nothing is stored per cell but its order and the tile lists: a cell is set up in SIMD lanes in each tile that meets
/// it.
#pragma once

#include <memory>

#include <projection/core/engine.h>

namespace tetralux::projection {

std::unique_ptr<Engine> makeCpuEngine(const Scene& scene, const EngineOptions& options);

/// What can be switched off to show that it does not change the picture.
struct CpuSkips {
    bool invisibleCells = true;    ///< cells that the transfer function hides are not looked at
    bool earlyTermination = true;  ///< opaque pixels and tiles are left alone
    bool orderFree = true;         ///< no sort where order does not matter
    bool quickVariants = true;     ///< silhouettes and plain light by kernels made for just these
    bool keepFrame = true;         ///< lists are kept while the camera stays
    bool sort = true;              ///< off: cells in the mesh's order, which must show as uncertain pixels
};
std::unique_ptr<Engine> makeCpuEngineWith(const Scene& scene, const CpuSkips& skips);

}  // namespace tetralux::projection
