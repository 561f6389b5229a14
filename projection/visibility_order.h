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
#include <projection/order_keys.h>
#include <projection/scene.h>

namespace tetralux::projection {

struct VisibilityOrder {
    std::vector<mesh::CellIndex> frontToBack;
    std::string method;             ///< "power", "mpvo", "mpvo+reentry", "centroid"
    std::uint64_t cyclicCells = 0;  ///< cells for which no order exists; they come last
    /// Pixels in which the order cannot be trusted (cycles, overlapping cells), as y·width + x, ascending. An engine
    /// that composites in this order has those pixels composed exactly by other means.
    std::vector<std::uint32_t> doubtfulPixels;
};

/// Keeps what does not depend on the camera: the certificate of power order with its keys or, where there is none,
/// adjacency and boundary.
class VisibilitySorter {
public:
    /// What the owner does with keys: sort by itself what survives culling, or have whole meshes sorted here.
    enum class Use { Keys, Whole };

    explicit VisibilitySorter(const mesh::ScalarMesh& mesh, OrderMethod method = OrderMethod::Auto,
                              Use use = Use::Whole);
    ~VisibilitySorter();

    /// "power", "mpvo", "mpvo+reentry", "centroid".
    const std::string& method() const;

    /// Keys that put any of the cells in order, larger first; empty where there are none and sort() must be asked.
    const OrderKeys& keys() const;

    /// Inner faces that fail the certificate of power order; none were asked for in meshes with a nonconvex boundary.
    std::uint64_t failingFaces() const;

    /// Order of the cells that lie at least partly in front of the eye. With Use::Keys only where keys() is empty.
    VisibilityOrder sort(const CameraFrame& frame) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tetralux::projection
