// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/box_tree.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Tetrahedra in a tree of bounding boxes.
class CellTree : public BoxTree {
public:
    CellTree(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells);
};

}  // namespace tetralux::mesh
