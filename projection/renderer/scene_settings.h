// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: public settings in the terms of scenes. \throws std::runtime_error for numbers that no scene can have.
#pragma once

#include <span>
#include <vector>

#include <projection/core/camera.h>
#include <projection/core/clip_region.h>
#include <projection/core/fitted_view.h>
#include <projection/core/modes.h>
#include <projection/opaque/boundary_surface.h>
#include <projection/opaque/opaque_objects.h>
#include <shading/lights.h>
#include <tetralux/tetralux.h>

namespace tetralux::renderer {

projection::Mode sceneMode(Mode mode);
shading::ShadingSettings sceneLighting(const Lighting& lighting);
std::vector<projection::HalfSpace> sceneCuts(const std::vector<Cut>& cuts);
projection::OpaqueObjects sceneObjects(const std::vector<Slice>& slices, const std::vector<Surface>& surfaces);
projection::BoundaryLook boundaryLook(const Boundary& boundary);
inline Vector arrayOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
Camera publicCamera(const projection::Camera& camera);  ///< its size and tile are the caller's
projection::Camera sceneCamera(const Camera& camera, const ImageView& image, const ImageTile& tile);

/// A view of that size that holds `points` as `view` says.
projection::Camera fittedSceneCamera(const FittedView& view, std::span<const glm::dvec3> points, int width, int height);

}  // namespace tetralux::renderer
