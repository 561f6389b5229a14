// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Triangles over shared points. Every index is in range and every position finite; nothing is said of closedness or
/// orientation.
struct SurfaceMesh {
    std::vector<glm::dvec3> positions;  ///< mesh units
    std::vector<std::array<PointIndex, 3>> triangles;
    Association association = Association::Point;
    std::vector<double> scalars;  ///< one per point or per triangle, or empty
};

}  // namespace tetralux::mesh
