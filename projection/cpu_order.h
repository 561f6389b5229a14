// SPDX-License-Identifier: Apache-2.0
/// \file
/// Keys by which the tile engine's lists become visibility order.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include <projection/cpu_cull.h>
#include <projection/visibility_order.h>

namespace tetralux::projection {

/// What one frame's order is worth, and its keys.
struct CpuFrameOrder {
    std::string method = "none";
    std::uint64_t cyclicCells = 0;
    std::vector<std::uint32_t> doubtfulPixels;
    KeySource keys;
    std::vector<std::uint32_t> places;  ///< what `keys` points to, where there is no certificate
};

/// Keys of cells: by power (power_order.h) where a certificate holds, so that only what survived culling is sorted;
/// else places in the order of the whole mesh.
class CpuOrder {
public:
    explicit CpuOrder(const mesh::ScalarMesh& mesh);

    CpuFrameOrder orderOf(const CameraFrame& frame) const;

private:
    void buildPowerPlanes(const std::vector<double>& heights);

    const mesh::ScalarMesh& mesh_;
    /// The cell's linear function of position (mesh diagonals from the centre of the bounds): gradient and constant.
    /// Its value at the eye is the key. 32 bytes per cell; to make it anew each frame would take four times the time of
    /// reading it.
    std::vector<glm::dvec4> powerPlanes_;
    std::unique_ptr<VisibilitySorter> sorter_;  ///< where there is no certificate
};

}  // namespace tetralux::projection
