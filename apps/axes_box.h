// SPDX-License-Identifier: Apache-2.0
/// \file
/// The mesh's bounding box with a scale along each axis, as drawn on the picture.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>

namespace tetralux::apps {

struct BoxLine {
    glm::dvec2 from, to;  ///< pixels, centres at halves
    /// The volume lies in front of it: no side of the box that meets here shows its outside. Any other edge lies in
    /// front of the whole volume.
    bool behind;
};

struct BoxLabel {
    glm::dvec2 at;       ///< pixels
    glm::dvec2 outward;  ///< unit vector away from the box
    std::string text;
    bool axisName;  ///< "x", not a number
};

struct AxesBox {
    std::vector<BoxLine> lines;
    std::vector<BoxLabel> labels;
};

/// The box's edges that are in view; numbers along one edge for each axis, chosen from the box's outline so that they
/// stand beside it (none from within the box).
AxesBox axesBox(const mesh::BoundingBox& bounds, const projection::Camera& camera);

}  // namespace tetralux::apps
