// SPDX-License-Identifier: Apache-2.0
/// \file
/// Cameras that look from a given side and hold what they are given as tightly as the picture allows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <projection/core/camera.h>

namespace tetralux::projection {

/// Along which direction, and what is up.
struct ViewDirection {
    glm::dvec3 forward{-1.0, -0.7, -1.5};  ///< from the eye into the picture, any length
    glm::dvec3 up{0, 1, 0};
};

/// x, -x, y, -y, z, -z: the eye stands on that side ("x": at large x, looking along −x); up is z, of z and -z y. iso:
/// from (1, 1, 1), up is z. xy, yz, zx and yx, zy, xz: as PyVista has them, from z, x, y and -z, -x, -y. \throws
/// std::runtime_error for other names.
ViewDirection namedView(const std::string& name);
std::vector<std::string> viewNames();

/// The view turned as vtkCamera turns, degrees. Azimuth: the eye about `up` through the target, anticlockwise as seen
/// from above. Elevation: the eye upwards. Roll: `up` about the direction of view, clockwise as the eye sees it, so
/// that the picture turns the other way. In this order.
struct ViewTurn {
    double azimuth = 0.0, elevation = 0.0, roll = 0.0;
    bool none() const { return azimuth == 0.0 && elevation == 0.0 && roll == 0.0; }
};
ViewDirection turned(const ViewDirection& view, const ViewTurn& turn);
/// The same of a camera, whose eye goes round its target.
Camera turned(const Camera& camera, const ViewTurn& turn);

inline constexpr double defaultMargin = 0.02;  ///< of views that are fitted

/// Shares of the picture's width and height that stay free at its edges.
struct Margins {
    double left = defaultMargin, right = defaultMargin, top = defaultMargin, bottom = defaultMargin;
};

/// This share at every edge, but a pixel at least, and so for a tiny picture half of it for what shows.
Margins evenMargins(double share, int width, int height);

/// `camera` (its size, field of view, whether it is orthographic, and window centre are kept) in that direction, as
/// near as it can be with all `points` within its picture but for the margins; an orthographic one gets the height.
/// Points of no extent are seen from a distance of 1. \throws std::runtime_error when there are no points, or `up` is
/// along the direction.
Camera fitted(const Camera& camera, const ViewDirection& view, std::span<const glm::dvec3> points,
              const Margins& margins);

/// vtkCamera's zoom: the angle of view (the height of an orthographic one) divided by `factor`, > 0.
Camera zoomed(const Camera& camera, double factor);

}  // namespace tetralux::projection
