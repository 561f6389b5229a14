// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/surface_mesh.h>

namespace tetralux::projection {

/// Per triangle the normals at its corners, so that curved surfaces look curved: the mean, by area, of the normals of
/// those triangles about the corner's point that are bent by less than the feature angle (degrees) from this one; edges
/// stay edges. Unit, to the side of the triangle's own normal, whichever way its neighbours turn; zero for triangles
/// without an area.
std::vector<std::array<glm::dvec3, 3>> cornerNormals(const mesh::SurfaceMesh& surface, double featureAngle = 40.0);

}  // namespace tetralux::projection
