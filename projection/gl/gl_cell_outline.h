// SPDX-License-Identifier: Apache-2.0
/// \file
/// The polygon that a projected cell is drawn as.
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include <projection/cells/cell_setup.h>

namespace tetralux::projection {

/// A convex polygon of four corners in order, in pixel coordinates (whole numbers are pixel centres). Of a triangle,
/// corner 3 repeats corner 2.
using CellOutline = std::array<glm::vec2, 4>;

/// The convex hull of a tetrahedron's projected corners, grown by `margin` pixels on every side. Rasterizers move
/// vertices to a grid of 1/256 pixel; with a margin above that they produce every pixel whose centre is in the hull,
/// and the fragment shader, which knows the planes exactly, rejects the few that are not.
CellOutline cellOutline(const std::array<glm::dvec2, 4>& corners, double margin);

/// What a cell is drawn as: that hull, or the rectangle of its pixels where it reaches behind the eye or farther beyond
/// the image than rasterizers compute. `corners` before the camera (CameraPoint).
CellOutline cellOutline(const std::array<glm::dvec3, 4>& corners, const CameraFrame& frame, double margin);

}  // namespace tetralux::projection
