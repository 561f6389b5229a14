// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/box_tree.h>

namespace tetralux::mesh {

/// Triangles in a tree of bounding boxes.
class TriangleTree : public BoxTree {
public:
    using Corners = std::array<glm::dvec3, 3>;

    explicit TriangleTree(const std::vector<Corners>& triangles);

private:
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, const std::vector<Corners>& triangles);
};

}  // namespace tetralux::mesh
