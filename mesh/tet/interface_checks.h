// SPDX-License-Identifier: Apache-2.0
/// \file
/// Whether cells fit together: what no cell shows on its own.
#pragma once

#include <map>
#include <span>
#include <vector>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/mesh_report.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Counts and first cells of
/// - non-manifold faces: more than two cells share one;
/// - overlapping cells: two on the same side of their shared face, some whose boundary faces cross, and one of each
///   part of the mesh that lies inside another part (of the first 10,000 parts);
/// - non-conforming interfaces: boundary faces that lie against another from the other side without having the same
///   points (hanging nodes, quadrilaterals cut along different diagonals).
/// Crossings and gaps below a thousandth of an edge are no defects. O(boundary faces · log), in parallel.
std::map<Defect, DefectCount> interfaceDefects(std::span<const glm::dvec3> positions,
                                               std::span<const Tetrahedron> cells, const Adjacency& adjacency);

}  // namespace tetralux::mesh
