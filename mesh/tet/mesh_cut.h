// SPDX-License-Identifier: Apache-2.0
/// \file
/// Surfaces within a mesh, by whole cells and exact: marching tetrahedra and the mesh's boundary. What is cut is only
/// said by points on edges of the mesh, so that any of its fields can be carried on to the surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// The point a + fraction·(b − a) on an edge of the mesh; a = b and fraction 0 for a point of the mesh itself.
struct EdgePoint {
    PointIndex a, b;
    double fraction;
};

struct MeshCut {
    std::vector<EdgePoint> points;
    std::vector<std::array<PointIndex, 3>> triangles;  ///< of `points`, no two corners of one the same
    std::vector<CellIndex> cells;                      ///< that each triangle comes from
};

/// Where `heights`, one per point and linear within cells, cross `level`: one or two triangles for each cell with
/// corners on either side, seen counter-clockwise from the lower side. A height equal to `level` counts as above it,
/// everywhere alike: f to b crosses exactly when (f < level) ≠ (b < level). Corners on one edge are one point, and
/// what falls on a point of the mesh, in double precision, is that point, so that no triangle is open but at faces with
/// a cell on one side only. Cells with a height that is not finite are left out.
MeshCut cutAtLevel(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells,
                   std::span<const double> heights, double level);

/// The part of the plane through `point` that lies inside the mesh, its triangles seen counter-clockwise from where
/// `normal` (any length but 0) points. A plane that runs along faces takes each of them once, also those of the
/// boundary. Empty where the plane misses the mesh.
MeshCut cutAtPlane(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells, const glm::dvec3& point,
                   const glm::dvec3& normal);

/// All faces without a cell behind them, seen counter-clockwise from outside.
MeshCut boundaryFaces(std::span<const Tetrahedron> cells, std::size_t pointCount);

/// Where the points of a cut are.
std::vector<glm::dvec3> cutPositions(const MeshCut& cut, std::span<const glm::dvec3> positions);

/// One value per point of the cut, from `components` values per point of the mesh.
std::vector<double> cutValues(const MeshCut& cut, std::span<const double> values, int components = 1);

}  // namespace tetralux::mesh
