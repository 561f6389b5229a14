// SPDX-License-Identifier: Apache-2.0
/// \file
/// On which side of a ray an edge passes: the predicate that ray–triangle crossings are made of (Platis & Theoharis
/// 2003). Points are seen along the ray, as offsets across it.
#pragma once

#include <glm/vec2.hpp>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::projection {

/// Twice the signed area between the ray's foot (0, 0) and the edge a → b. Swapping a and b flips the sign exactly, so
/// that all cells around an edge agree.
inline double edgeSide(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// A side of exactly zero (the ray runs through the edge or a vertex; the eye is a vertex) is settled as if each point
/// were moved across the ray by a step of its own along one direction, the smaller the point's number the longer the
/// step (Edelsbrunner & Mücke 1990): one answer for all cells around, as of points in general position.
inline bool zeroSideIsPositive(const glm::dvec2& a, const glm::dvec2& b, mesh::PointIndex indexA,
                               mesh::PointIndex indexB) {
    const glm::dvec2 step{1.0, 0.7548776662466927};
    const bool ascending = indexA < indexB;
    const glm::dvec2 &first = ascending ? a : b, &second = ascending ? b : a;
    double side = edgeSide(step, second);
    if (side == 0) side = edgeSide(first, step);
    return (side >= 0) == ascending;
}

/// Whether the edge a → b passes on the positive side.
inline bool passesPositive(const glm::dvec2& a, const glm::dvec2& b, mesh::PointIndex indexA, mesh::PointIndex indexB) {
    const double side = edgeSide(a, b);
    return side != 0 ? side > 0 : zeroSideIsPositive(a, b, indexA, indexB);
}

}  // namespace tetralux::projection
