// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/plane_cut.h>

namespace tetralux::mesh {

SurfaceMesh cutByPlane(const ScalarMesh& mesh, const glm::dvec3& point, const glm::dvec3& normal) {
    return surfaceOfCut(mesh, cutAtPlane(mesh.positions, mesh.cells, point, normal));
}

SurfaceMesh surfaceOfCut(const ScalarMesh& mesh, const MeshCut& cut) {
    SurfaceMesh surface;
    surface.association = mesh.association;
    surface.positions = cutPositions(cut, mesh.positions);
    if (mesh.association == Association::Point)
        surface.scalars = cutValues(cut, mesh.scalars);
    else
        for (const CellIndex cell : cut.cells) surface.scalars.push_back(mesh.scalars[cell]);
    surface.triangles = cut.triangles;
    return surface;
}

}  // namespace tetralux::mesh
