// SPDX-License-Identifier: Apache-2.0
/// \file
/// One cell, given by its triangulated surface, to tetrahedra with a common apex.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/soup/face_triangulation.h>
#include <mesh/soup/point_blend.h>
#include <mesh/soup/soup_checks.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Where the tetrahedra of many cells are gathered. Apices that are new points get the numbers firstCentre,
/// firstCentre + 1, … in the order of `centres`.
struct ConeOutput {
    std::vector<Tetrahedron> cells;
    PointBlends centres;
    std::uint32_t firstCentre = 0;
};

/// Appends the tetrahedra of the solid within `surface`, a closed set of triangles that all turn the same way round
/// (outwards, or all inwards, which is mended). \returns Good; Inverted if they turned inwards and `expectOutward`;
/// Folded if no apex sees all of the surface from inside, so that parts were left out; Flat if nothing was appended.
CellVerdict coneDecomposition(const std::vector<glm::dvec3>& points, std::vector<Triangle>& surface, bool expectOutward,
                              ConeOutput& out);

}  // namespace tetralux::mesh
