// SPDX-License-Identifier: Apache-2.0
/// \file
/// Values that were given on a surface, brought to all points of the tetrahedra inside of it.
#pragma once

#include <vector>

#include <mesh/tet/field.h>
#include <mesh/tet/tet_mesh.h>

#include "geometry.h"

namespace tetralux::mesher {

/// Carries `given.fields` over. A point of `mesh` that is point i of `given` (source[point] = i < given.points.size())
/// keeps its value; one on the boundary takes the value of the nearest point of the surface `given`, linear in its
/// triangle; those inside take the solution of Laplace's equation between these values (linear finite elements), which
/// is smooth, stays within the given values and is exact for linear fields. `sameNumbering` says whether source numbers
/// mean points of `given`. \throws std::runtime_error if the solver fails.
std::vector<mesh::Field> carryFields(const TriangleSurface& given, const mesh::TetMesh& mesh,
                                     const std::vector<std::uint32_t>& source, bool sameNumbering);

}  // namespace tetralux::mesher
