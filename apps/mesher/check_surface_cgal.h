// SPDX-License-Identifier: Apache-2.0
/// \file
/// The one door to CGAL's polygon mesh processing: is this the surface of a body, and if not, can it be made one?
#pragma once

#include <string>
#include <vector>

#include "surface_defects.h"

namespace tetralux::mesher {

/// Everything that keeps the surface from enclosing a volume; nothing if it does so and every shell faces the right
/// side. Self-intersections are found with exact predicates. A surface that is right but for facing inward as a whole
/// is turned, and `turned` says so.
SurfaceFindings checkSurface(TriangleSurface& surface, bool& turned);

/// Mends what can be: drops broken and double triangles, merges points, orients, stitches borders, fills holes, removes
/// self-intersections. Points may be new: `fields` of the result is empty. `done` gets one line for each thing done.
/// The result must be checked anew.
TriangleSurface repairSurface(const TriangleSurface& surface, std::vector<std::string>& done);

}  // namespace tetralux::mesher
