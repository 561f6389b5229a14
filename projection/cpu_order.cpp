// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu_order.h>

#include <utility>

namespace tetralux::projection {

CpuOrder::CpuOrder(const mesh::ScalarMesh& mesh, OrderMethod method)
    : cellCount_(mesh.cells.size()), sorter_(mesh, method, VisibilitySorter::Use::Keys) {}

CpuFrameOrder CpuOrder::orderOf(const CameraFrame& frame) const {
    CpuFrameOrder order;
    order.method = sorter_.method();
    if (!sorter_.keys().empty()) {
        order.keys.planes = sorter_.keys().planes().data();
        order.keys.eye = sorter_.keys().eye(frame);
        return order;
    }
    VisibilityOrder sorted = sorter_.sort(frame);
    order.cyclicCells = sorted.cyclicCells;
    order.doubtfulPixels = std::move(sorted.doubtfulPixels);
    // cells that the order leaves out lie behind the eye
    order.places.assign(cellCount_, static_cast<std::uint32_t>(cellCount_));
    for (std::uint32_t i = 0; i < sorted.frontToBack.size(); ++i) order.places[sorted.frontToBack[i]] = i;
    order.keys.places = order.places.data();
    return order;
}

}  // namespace tetralux::projection
