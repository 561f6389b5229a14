// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <mesh/tet/surface_mesh.h>

namespace tetralux::mesh {

/// Reads the polygons of `.stl`, `.obj`, `.ply`, `.off`, `.vtp` or a legacy `.vtk` file, as triangles. Lines and loose
/// points are left out. `isolated`: as in `ReadOptions`. \throws std::runtime_error naming the file, what is wrong and
/// what would mend it.
SurfaceMesh readSurface(const std::string& path, bool isolated = false);

}  // namespace tetralux::mesh
