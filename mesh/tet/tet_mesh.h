// SPDX-License-Identifier: Apache-2.0
/// \file
/// The checked mesh that every later stage stands on.
///
/// Numbering within a tetrahedron (a, b, c, d) = cells[i]:
///
///             d
///            /|\            positive: det(b − a, c − a, d − a) > 0
///           / | \           face k is opposite vertex k
///          /  |  \            face 0: b c d     face 1: a d c
///         a---|---c           face 2: a b d     face 3: a c b
///          \  |  /          vertices of a face run counter-clockwise
///           \ | /           when it is seen from outside the cell
///             b
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/field.h>
#include <mesh/tet/shared_array.h>

namespace tetralux::mesh {

using PointIndex = std::uint32_t;
using CellIndex = std::uint32_t;

/// Four point indices, positively oriented (see the drawing above).
using Tetrahedron = std::array<PointIndex, 4>;

/// faceVertices[k] lists the three local vertices of face k, outward counter-clockwise.
inline constexpr std::array<std::array<int, 3>, 4> faceVertices{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct BoundingBox {
    glm::dvec3 low{0}, high{0};  ///< mesh units
    glm::dvec3 centre() const { return 0.5 * low + 0.5 * high; }
    double diagonal() const;
};

/// Tetrahedra with all the fields of their source. Every index is in range, every point is used and finite, and every
/// volume is positive: `validation.h` makes it so and says what it left out.
struct TetMesh {
    std::vector<glm::dvec3> positions;  ///< mesh units
    std::vector<Tetrahedron> cells;
    std::vector<Field> fields;
};

/// What an engine draws: tetrahedra with one finite scalar on points (linear within a cell) or on cells
/// (constant within a cell).
struct ScalarMesh {
    SharedArray<glm::dvec3> positions;  ///< mesh units
    SharedArray<Tetrahedron> cells;
    Association association = Association::Point;
    SharedArray<double> scalars;              ///< one per point or per cell
    double scalarMin = 0.0, scalarMax = 0.0;  ///< over the points of cells, or over cells
    BoundingBox bounds;                       ///< of the points that cells use

    /// Scalar at local vertex `k` of `cell`; for cell data the cell's own value.
    double scalarAt(CellIndex cell, int k) const {
        return association == Association::Point ? scalars[cells[cell][static_cast<std::size_t>(k)]] : scalars[cell];
    }
};

/// Six times the signed volume of the tetrahedron (a, b, c, d): det(b − a, c − a, d − a), mesh units cubed.
double sixVolumes(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// 1 for each of `pointCount` points that a cell uses, else 0.
std::vector<std::uint8_t> usedPoints(std::span<const Tetrahedron> cells, std::size_t pointCount);

/// Bounds of the points that cells use; a box of zeros when there are no cells.
BoundingBox usedBounds(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells);
/// The same for points marked by `usedPoints`.
BoundingBox usedBounds(std::span<const glm::dvec3> positions, const std::vector<std::uint8_t>& used);

/// Gradient of the scalar that is linear in the cell, scalar units per mesh unit; zero for cell data.
glm::dvec3 cellGradient(const ScalarMesh& mesh, CellIndex cell);

}  // namespace tetralux::mesh
