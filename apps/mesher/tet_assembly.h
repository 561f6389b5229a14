// SPDX-License-Identifier: Apache-2.0
/// \file
/// From what TetGen or CGAL returned to a mesh of positive cells over used points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mesh/tet/tet_mesh.h>

#include "surface_defects.h"

namespace tetralux::mesher {

struct Assembly {
    mesh::TetMesh mesh;                 ///< without fields
    std::vector<std::uint32_t> source;  ///< for each point, its number among the raw points
    std::uint64_t flatCells = 0;        ///< left out: their volume is zero in doubles
    double volume = 0.0;                ///< mesh units cubed
};

/// Keeps the cells for which `keep` holds (all, if it is empty), turns inverted ones, leaves out flat ones and unused
/// points.
Assembly assemble(const RawTetrahedra& raw, const std::vector<bool>& keep = {});

/// The cells that lie inside of `surface` by its winding number, asked once per region at the region's largest cell.
std::vector<bool> insideOf(const TriangleSurface& surface, const RawTetrahedra& raw);

/// Largest circumradius to shortest edge ratio (TetGen's measure of quality) over the cells: a pure number.
double worstRadiusEdgeRatio(const mesh::TetMesh& mesh);

/// The faces that one cell only has, outward, over the mesh's points.
TriangleSurface boundaryOf(const mesh::TetMesh& mesh);

}  // namespace tetralux::mesher
