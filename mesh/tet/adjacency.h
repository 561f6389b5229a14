// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Which cell lies behind each face. neighbours[cell][k] is the cell across face k (opposite vertex k),
/// or `noNeighbour` on the boundary. A face that more than two cells share, or that two cells on the same side of it
/// share (they overlap), has no neighbour on any side and is counted.
struct Adjacency {
    static constexpr CellIndex noNeighbour = 0xffffffffu;
    std::vector<std::array<CellIndex, 4>> neighbours;
    std::uint64_t boundaryFaces = 0;
    std::uint64_t nonManifoldFaces = 0;  ///< shared by more than two cells
    std::uint64_t foldedFaces = 0;       ///< shared by two cells on the same side
};

/// Built by face keys in O(cells), in parallel. Every index in `cells` must be below `pointCount`.
Adjacency buildAdjacency(std::span<const Tetrahedron> cells, std::size_t pointCount);

}  // namespace tetralux::mesh
