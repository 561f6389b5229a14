// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where from and how large: --size, --eye, --view, --direction, --zoom and so on.
#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <projection/core/fitted_view.h>
#include <projection/frame/shown_points.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct CameraOptions {
    glm::ivec2 size{512, 512};                  ///< pixels
    std::optional<glm::dvec3> eye, target, up;  ///< mesh units; what is not given is found from the mesh
    std::string view;                           ///< a name; empty: none
    std::optional<glm::dvec3> direction;        ///< from the eye into the picture
    projection::ViewTurn turn;
    double zoom = 1.0;
    double fovDegrees = 30.0;
    double orthographicHeight = 0.0;  ///< mesh units; 0: perspective
    bool orthographic = false;        ///< with a height that holds what shows
    bool orbits = false;              ///< the eye goes round: a fitted view holds what shows from every side
};

void addCameraOptions(CLI::App& command, CameraOptions& options);

/// The camera that they ask for: as it is said, or fitted to what shows, with the margins free.
/// `boxToo`: also the mesh's whole box. \throws
/// std::runtime_error naming the option that no camera can have.
projection::Camera cameraFor(const CameraOptions& options, const projection::Scene& scene,
                             const projection::SceneParts& parts, const projection::Margins& margins, bool boxToo);

}  // namespace tetralux::apps
