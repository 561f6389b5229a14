// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry.h"

namespace tetralux::mesher {

/// The one door to CGAL's 3D Delaunay triangulation: the convex hull of the points in tetrahedra. Of points that
/// coincide one is used; all must be finite. \throws std::runtime_error when the points lie in a plane.
RawTetrahedra delaunayByCgal(const std::vector<glm::dvec3>& points);

}  // namespace tetralux::mesher
