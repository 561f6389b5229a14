// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where rays leave a nonconvex mesh and come back: the order across gaps, sampled at pixel centres (Cook, Max, Silva &
/// Williams, "Image-Space Visibility Ordering for Cell Projection Volume Rendering of Unstructured Data", 2004). An
/// image shows the mesh at pixel centres only, so relations sampled there order everything that can be seen.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/tet_mesh.h>
#include <projection/cells/camera_points.h>

namespace tetralux::projection {

/// A face of a cell without neighbour, its corners counter-clockwise from outside.
struct BoundaryFace {
    mesh::CellIndex cell;
    std::array<mesh::PointIndex, 3> corners;
};

std::vector<BoundaryFace> boundaryFaces(const mesh::ScalarMesh& mesh, const mesh::Adjacency& adjacency);

/// True when the boundary is one closed surface that is nowhere concave: then every ray meets the mesh in one interval.
/// Tolerance 1e-9 of the edge lengths.
bool boundaryIsConvex(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary);

struct Reentry {
    /// (nearer, farther): a ray leaves the mesh from the first cell and comes back into the second. Unique, sorted.
    std::vector<std::pair<mesh::CellIndex, mesh::CellIndex>> edges;
    /// Pixels in which intervals of the mesh overlap or do not pair up, as y·width + x, ascending.
    std::vector<std::uint32_t> uncertainPixels;
};

/// `points`: the mesh's, before this frame's camera.
Reentry findReentry(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary, const CameraFrame& frame,
                    std::span<const CameraPoint> points);

}  // namespace tetralux::projection
