// SPDX-License-Identifier: Apache-2.0
/// \file
/// Keys by which the tile engine's lists become visibility order.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <projection/cpu/cpu_cull.h>
#include <projection/order/visibility_order.h>

namespace tetralux::projection {

/// What one frame's order is worth, and its keys.
struct CpuFrameOrder {
    std::string method = "none";
    std::string incrementalSort = "sorted";
    std::uint64_t failingFaces = 0, cyclicCells = 0;
    std::vector<std::uint32_t> uncertainPixels;
    // what these point to the CpuOrder keeps, until it is asked again
    KeySource keys;
    const std::uint32_t* places = nullptr;  ///< per cell, counted from the front, instead of keys
};

/// Keys of cells: linear ones (order_keys.h) where the sorter has them, so that only what survived culling is sorted;
/// else places in the order of the whole mesh.
class CpuOrder {
public:
    CpuOrder(const mesh::ScalarMesh& mesh, OrderMethod method, MeshMemo* memo);

    /// Goes on with the order of the last frame of another engine of the same points and cells.
    void takeOver(CpuOrder&& previous) { sorter_.takeOver(std::move(previous.sorter_)); }

    /// Whether an order takes no time: keys are told with what survives culling. Else it may be made meanwhile.
    bool keyed() const { return !sorter_.keys().empty(); }

    CpuFrameOrder orderOf(const CellProjector& projector);

private:
    VisibilitySorter sorter_;
};

}  // namespace tetralux::projection
