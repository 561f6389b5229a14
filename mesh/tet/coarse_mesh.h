// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// A stand-in with fewer cells: the scalar of `mesh` at n×n×n points (2 ≤ n ≤ 1000) over its bounds, five tetrahedra
/// per box of the grid. Tetrahedra with a corner outside the mesh are left out; cell data become point data. Without
/// cells where the mesh is thinner than the grid. O(cells of `mesh` + n³).
ScalarMesh coarseMesh(const ScalarMesh& mesh, int n);

}  // namespace tetralux::mesh
