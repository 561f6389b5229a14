// SPDX-License-Identifier: Apache-2.0
/// \file
/// Linear solids of any type to tetrahedra that conform across shared faces.
///
/// Every face is cut into triangles (`face_triangulation.h`); the cell is then a cone: one of its points, joined to all
/// triangles that do not touch it. With faces cut by the smallest-number rule the smallest number of the cell always
/// serves for planar faces: 6 tetrahedra for a hexahedron, 3 for a wedge, 2 for a pyramid (Dompierre et al. 1999).
/// Where warped faces or neighbours' diagonals leave no such point, the apex is a new point inside the cell, on which a
/// field that is linear over the cell keeps its value.
#pragma once

#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/soup/soup_checks.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

struct Decomposition {
    std::vector<Tetrahedron> cells;      ///< every one certainly of positive volume
    std::vector<std::uint32_t> parents;  ///< source cell of each; empty when tetrahedron i is cell i of the source
    std::uint64_t facesFitted = 0;       ///< quadrilaterals that lie against two triangles and were cut as these are
};

/// Checks tetrahedra, turns the inverted ones round and leaves out the faulty ones and duplicates, in parallel and in
/// place. `verdicts` gets one verdict per cell, or none at all if every one is Good; `used` a 1 for each point that a
/// cell names, else 0.
Decomposition takeTetrahedra(std::span<const glm::dvec3> points, std::vector<Tetrahedron>&& cells,
                             std::vector<CellVerdict>& verdicts, std::vector<std::uint8_t>& used);

/// Takes the kept cells of `soup` apart, in parallel, and away. Adds points to `soup` where it needs them and sets
/// verdicts to Inverted, Folded, Flat or Unsupported (an open polyhedron) as it finds them. Cells must have passed
/// `classifyCells`, and curved ones have become linear.
Decomposition decomposeCells(CellSoup& soup, std::vector<CellVerdict>& verdicts);

}  // namespace tetralux::mesh
