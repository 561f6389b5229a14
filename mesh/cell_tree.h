// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/box_tree.h>
#include <mesh/tet_mesh.h>

namespace tetralux::mesh {

/// Tetrahedra in a tree of bounding boxes.
class CellTree : public BoxTree {
public:
    CellTree(const std::vector<glm::dvec3>& positions, const std::vector<Tetrahedron>& cells);
};

}  // namespace tetralux::mesh
