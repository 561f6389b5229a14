// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/mesh_cut.h>
#include <mesh/tet/surface_mesh.h>

namespace tetralux::mesh {

/// The part of the plane through `point` with normal `normal` (any length but 0) that lies inside the mesh: one or two
/// triangles for each cell that it cuts, with the cells' linear scalar at their corners (cell data: one scalar per
/// triangle). Corners on one edge of the mesh are one point, so that the triangles fit without gaps. A plane that runs
/// through faces, also those of the boundary, takes each of them once. Empty where the plane misses the mesh.
SurfaceMesh cutByPlane(const ScalarMesh& mesh, const glm::dvec3& point, const glm::dvec3& normal);

/// A cut with the mesh's scalar: at its points, or of the cells that its triangles come from.
SurfaceMesh surfaceOfCut(const ScalarMesh& mesh, const MeshCut& cut);

}  // namespace tetralux::mesh
