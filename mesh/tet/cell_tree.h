// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/box_tree.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Tetrahedra in a tree of bounding boxes.
class CellTree : public BoxTree {
public:
    CellTree(const std::vector<glm::dvec3>& positions, const std::vector<Tetrahedron>& cells);
};

}  // namespace tetralux::mesh
