// SPDX-License-Identifier: Apache-2.0
/// \file
/// Visibility order of the cells of a tetrahedral mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mesh/adjacency.h>
#include <mesh/tet_mesh.h>
#include <projection/camera.h>

namespace tetralux::projection {

struct VisibilityOrder {
    std::vector<mesh::CellIndex> frontToBack;
    std::string method;             ///< "mpvo", "mpvo+reentry", …
    std::uint64_t cyclicCells = 0;  ///< cells for which no order exists; they come last
    /// Pixels in which the order cannot be trusted (cycles, overlapping cells), as y·width + x, ascending. An engine
    /// that composites in this order has those pixels composed exactly by other means.
    std::vector<std::uint32_t> doubtfulPixels;
};

/// Keeps what does not depend on the camera: adjacency and whether the boundary is convex.
class VisibilitySorter {
public:
    explicit VisibilitySorter(const mesh::ScalarMesh& mesh);
    ~VisibilitySorter();

    /// Order of the cells that lie at least partly in front of the eye.
    VisibilityOrder sort(const CameraFrame& frame) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tetralux::projection
