// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which cells the rays of a few pixels may meet: found in one pass over the cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

class PixelCandidates {
public:
    /// Whether corners tell what a cell covers: the mesh lies before the eye, or the view is orthographic.
    static bool possible(const mesh::BoundingBox& bounds, const CameraFrame& frame);

    /// Where that is possible. For pixels y·width + x, ascending. Memory: 8 bytes per pixel and cell over it, meant for
    /// thousands of pixels.
    PixelCandidates(const mesh::ScalarMesh& mesh, const CameraFrame& frame, std::span<const std::uint32_t> pixels);

    /// Every cell that the ray of the i-th pixel meets, and some beside it, ascending.
    std::span<const mesh::CellIndex> of(std::size_t i) const {
        return {cells_.data() + start_[i], cells_.data() + start_[i + 1]};
    }

private:
    std::vector<std::size_t> start_;  ///< per pixel, and the end
    std::vector<mesh::CellIndex> cells_;
};

}  // namespace tetralux::projection
