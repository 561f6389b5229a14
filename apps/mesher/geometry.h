// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the mesher's stages hand to each other. Coordinates are in mesh units throughout.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/field.h>

namespace tetralux::mesher {

using Triangle = std::array<std::uint32_t, 3>;

/// Points with values, and the polygons over them as the file had them: nothing is checked but that every index is in
/// range.
struct PolygonSoup {
    std::vector<glm::dvec3> points;
    std::vector<std::vector<std::uint32_t>> polygons;  ///< empty: a point cloud
    std::vector<mesh::Field> fields;                   ///< on points
};

/// Triangles over points, each seen counter-clockwise from outside once `checkSurface` has found nothing.
struct TriangleSurface {
    std::vector<glm::dvec3> points;
    std::vector<Triangle> triangles;
    std::vector<mesh::Field> fields;  ///< on points
};

/// Tetrahedra as a library returned them: orientation and positivity not yet checked.
struct RawTetrahedra {
    std::vector<glm::dvec3> points;  ///< the first ones are the input's, in its order
    std::vector<std::array<std::uint32_t, 4>> cells;
    std::vector<std::int32_t> regions;  ///< one per cell: which closed region of the surface it lies in; may be empty
};

}  // namespace tetralux::mesher
