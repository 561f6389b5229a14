// SPDX-License-Identifier: Apache-2.0
#include <projection/opaque/boundary_surface.h>

#include <utility>

#include <mesh/tet/mesh_cut.h>
#include <mesh/tet/plane_cut.h>

namespace tetralux::projection {

namespace {

mesh::SurfaceMesh outerFaces(const mesh::ScalarMesh& mesh) {
    return mesh::surfaceOfCut(mesh, mesh::boundaryFaces(mesh.cells, mesh.positions.size()));
}

OpaqueSurface surfaceOf(mesh::SurfaceMesh triangles, const BoundaryLook& look) {
    OpaqueSurface surface;
    surface.mesh = std::make_shared<const mesh::SurfaceMesh>(std::move(triangles));
    surface.byField = !look.color;
    surface.color = look.color.value_or(surface.color);
    surface.flat = look.flat;
    surface.opacity = look.opacity;
    surface.featureAngle = look.featureAngle;
    surface.edges = look.edges;
    surface.clipped = true;
    return surface;
}

}  // namespace

std::vector<OpaqueSurface> boundarySurfaces(const mesh::ScalarMesh& mesh, const std::vector<HalfSpace>& clips,
                                            const BoundaryLook& look) {
    std::vector<OpaqueSurface> surfaces{surfaceOf(outerFaces(mesh), look)};
    for (const HalfSpace& half : clips) {
        mesh::SurfaceMesh cut = mesh::cutByPlane(mesh, half.point, half.normal);
        if (!cut.triangles.empty()) surfaces.push_back(surfaceOf(std::move(cut), look));
    }
    return surfaces;
}

}  // namespace tetralux::projection
