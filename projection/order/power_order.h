// SPDX-License-Identifier: Apache-2.0
/// \file
/// Visibility order by one number per cell, with a proof.
///
/// Give every mesh point a height. If the function that interpolates the heights linearly in each cell is convex, then
/// at any eye the cell's own linear function, continued to the eye, is larger the nearer the cell: between two
/// neighbours the functions agree on the shared face and the farther one's is larger beyond it (Edelsbrunner 1990; Max,
/// Hanrahan & Crawfis 1990 for the case of Delaunay meshes, where the height is |x|² and the number is minus the eye's
/// power to the circumsphere). So sorting any subset of the cells by it is exactly their visibility order, from every
/// eye.
///
/// A grid of boxes has such heights by construction (grid_heights.h). Elsewhere they start at |x|² and are moved by
/// relaxation (Agmon; Motzkin & Schoenberg 1954) until every inner face is convex, which settles other cospherical
/// points and mildly non-Delaunay meshes. What is left over is counted.
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::projection {

class PowerOrder {
public:
    PowerOrder(const mesh::ScalarMesh& mesh, const mesh::Adjacency& adjacency);

    /// Inner faces at which the heights are not convex by more than rounding. 0 makes the order right
    /// across every face, and with a convex boundary (boundaryIsConvex) right altogether.
    std::uint64_t failingFaces() const { return failingFaces_; }

    /// Heights of the mesh points, in squared mesh diagonals. The key of a cell is Σ λ_k(eye)·height[k] over its
    /// vertices (orthographic: with the rates of λ_k towards the eye, see CellProjector::eyeCoordinates): the larger,
    /// the nearer.
    const std::vector<double>& heights() const { return heights_; }

private:
    std::vector<double> heights_;
    std::uint64_t failingFaces_ = 0;
};

/// A cell and its place in the order; ascending keys.
struct KeyedCell {
    std::uint32_t key;
    mesh::CellIndex cell;
};

/// Maps keys (larger = nearer) to whole numbers that ascend from near to far, spread over [nearest, farthest].
std::uint32_t orderedKey(double key, double nearest, double farthest);

/// Sorts by key, stable, in O(n) by parallel radix passes; `scratch` keeps its memory from call to call.
void radixSort(std::vector<KeyedCell>& cells, std::vector<KeyedCell>& scratch);

}  // namespace tetralux::projection
