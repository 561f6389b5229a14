// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/point_cells.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::shading {

/// Gradient at every point: that of the linear function which fits the scalars of the point's neighbours best (least
/// squares, weights 1/distance², a neighbour counted once per shared cell). Exact where the field is linear. In units
/// of the field's range per diagonal of the mesh. Where neighbours do not span space the mean of the cells' gradients,
/// by volume. Zero for cell data and for points without cells.
std::vector<glm::dvec3> vertexGradients(const mesh::ScalarMesh& mesh, const mesh::PointCells& around);

}  // namespace tetralux::shading
