// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// The cells around each point, ascending.
class PointCells {
public:
    /// Every index in `cells` must be below `pointCount`.
    PointCells(std::span<const Tetrahedron> cells, std::size_t pointCount);

    std::span<const CellIndex> of(std::size_t point) const {
        return {cells_.data() + starts_[point], cells_.data() + starts_[point + 1]};
    }

private:
    std::vector<std::size_t> starts_;
    std::vector<CellIndex> cells_;
};

}  // namespace tetralux::mesh
