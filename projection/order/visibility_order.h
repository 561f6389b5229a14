// SPDX-License-Identifier: Apache-2.0
/// \file
/// Visibility order of the cells of a tetrahedral mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/tet_mesh.h>
#include <projection/cells/cell_setup.h>
#include <projection/core/scene.h>
#include <projection/order/order_keys.h>

namespace tetralux::projection {

struct VisibilityOrder {
    std::vector<mesh::CellIndex> frontToBack;
    std::vector<std::uint32_t> places;       ///< per cell: where it stands in frontToBack
    std::string method;                      ///< "power", "mpvo", "mpvo+reentry", "centroid"
    std::string incrementalSort = "sorted";  ///< or "kept", "repaired": what became of the last frame's order
    std::uint64_t cyclicCells = 0;           ///< cells taken out of turn because no order exists
    /// Pixels in which the order cannot be trusted (cycles, overlapping cells), as y·width + x, ascending. An engine
    /// that composites in this order has those pixels composed exactly by other means.
    std::vector<std::uint32_t> uncertainPixels;
};

/// Keeps what does not depend on the camera: the certificate of power order with its keys or, where there is none,
/// adjacency and boundary.
class VisibilitySorter {
public:
    /// What the owner does with keys: sort by itself what survives culling, or have whole meshes sorted here.
    enum class Use { Keys, Whole };

    /// `memo`: where what depends on points and cells alone is kept, for other sorters too.
    explicit VisibilitySorter(const mesh::ScalarMesh& mesh, OrderMethod method = OrderMethod::Auto,
                              Use use = Use::Whole, MeshMemo* memo = nullptr);
    ~VisibilitySorter();
    VisibilitySorter(VisibilitySorter&&) noexcept;
    VisibilitySorter& operator=(VisibilitySorter&&) noexcept;

    /// "power", "mpvo", "mpvo+reentry", "centroid".
    const std::string& method() const;

    /// Keys that put any of the cells in order, larger first; empty where there are none and sort() must be asked.
    const OrderKeys& keys() const;

    /// Empty with Use::Keys where there are keys, and for an order by centroids.
    const mesh::Adjacency& adjacency() const;

    /// Inner faces that fail the certificate of power order; none were asked for in meshes with a nonconvex boundary.
    std::uint64_t failingFaces() const;

    /// Order of all cells. The last frame's is checked first, face by face and gap by gap, and where few pairs of cells
    /// have changed sides it is repaired rather than made anew. What is returned keeps every relation between cells but
    /// for cycles, and holds until the next call. With Use::Keys only where keys() is empty. One thread at a time.
    const VisibilityOrder& sort(const CellProjector& projector);
    const VisibilityOrder& sort(const CameraFrame& frame);

    /// Of an order by centroids, to tell what it spoils: the pixels in which two cells that follow one another along a
    /// ray may stand the wrong way round, a superset of those that do; ascending.
    std::vector<std::uint32_t> pixelsOutOfOrder(const CellProjector& projector);

    /// Goes on with the last order of a sorter of the same points and cells.
    void takeOver(VisibilitySorter&& previous);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tetralux::projection
