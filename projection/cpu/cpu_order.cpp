// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_order.h>

#include <utility>

namespace tetralux::projection {

CpuOrder::CpuOrder(const mesh::ScalarMesh& mesh, OrderMethod method, MeshMemo* memo)
    : sorter_(mesh, method, VisibilitySorter::Use::Keys, memo) {}

CpuFrameOrder CpuOrder::orderOf(const CellProjector& projector) {
    CpuFrameOrder order;
    order.method = sorter_.method();
    order.failingFaces = sorter_.failingFaces();
    if (keyed()) {
        order.keys.planes = sorter_.keys().planes().data();
        order.keys.eye = sorter_.keys().eye(projector.frame());
        return order;
    }
    const VisibilityOrder& sorted = sorter_.sort(projector);
    order.incrementalSort = sorted.incrementalSort;
    order.cyclicCells = sorted.cyclicCells;
    order.uncertainPixels = sorted.uncertainPixels;
    order.places = sorted.places.data();
    return order;
}

}  // namespace tetralux::projection
