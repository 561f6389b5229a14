// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <mesh/tet/surface_mesh.h>

namespace tetralux::mesh {

/// Reads the polygons of `.stl`, `.obj`, `.ply`, `.off`, `.vtp` or a legacy `.vtk` file, as triangles. Lines and loose
/// points are left out. `isolated`: as in `ReadOptions`. `field`: taken as the scalars, by the names that
/// `selectScalar` knows; none if that is empty. Triangles without a finite value of it are left out. \throws
/// std::runtime_error naming the file, what is wrong and what would mend it.
SurfaceMesh readSurface(const std::string& path, bool isolated = false, const std::string& field = "");

}  // namespace tetralux::mesh
