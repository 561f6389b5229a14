// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where a picture shows anything, before it is drawn: to fit a view to it, and to say why there is nothing.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <projection/core/camera.h>
#include <projection/core/clip_region.h>
#include <projection/core/scene.h>
#include <projection/opaque/opaque_objects.h>

namespace tetralux::projection {

/// What limits the volume and stands in it, as the scene's map sources were made of it.
struct SceneParts {
    std::vector<HalfSpace> clips;
    OpaqueObjects objects;
};

/// Corners of all that shows, mesh units: of cells that the transfer function shows (all, in modes without opacity, and
/// unless `hiddenLeftOut`), as far as they lie within the clipping planes, of slices likewise and of surfaces. Empty
/// when nothing shows.
std::vector<glm::dvec3> shownPoints(const Scene& scene, const SceneParts& parts, bool hiddenLeftOut = true);

/// Whether nothing shows in any pixel.
bool isEmpty(const Image& image);

/// Why a picture by this camera is empty, and what would mend it, in one clause.
std::string whyEmpty(const Scene& scene, const SceneParts& parts, const Camera& camera);

}  // namespace tetralux::projection
