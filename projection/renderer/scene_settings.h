// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: public settings in the terms of scenes. \throws std::runtime_error for numbers that no scene can have.
#pragma once

#include <vector>

#include <projection/core/camera.h>
#include <projection/core/clip_region.h>
#include <projection/core/modes.h>
#include <projection/opaque/opaque_objects.h>
#include <shading/lights.h>
#include <tetralux/tetralux.h>

namespace tetralux::renderer {

projection::Mode sceneMode(Mode mode);
shading::ShadingSettings sceneLighting(const Lighting& lighting);
std::vector<projection::HalfSpace> sceneCuts(const std::vector<Cut>& cuts);
projection::OpaqueObjects sceneObjects(const std::vector<Slice>& slices, const std::vector<Surface>& surfaces);
projection::Camera sceneCamera(const Camera& camera, const ImageView& image, const ImageTile& tile);

}  // namespace tetralux::renderer
