// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a hand does to a camera. Every function gives another camera of the same size.
#pragma once

#include <glm/vec2.hpp>

#include <apps/view/option_words.h>
#include <projection/core/camera.h>

namespace tetralux::apps::view {

/// About the target: `degrees`.x about up, anticlockwise from above; .y raises the eye, which stays 1° off the poles.
projection::Camera turntable(const projection::Camera& camera, glm::dvec2 degrees);
/// About the target and the picture's own axes, through the poles; up turns too.
projection::Camera trackball(const projection::Camera& camera, glm::dvec2 degrees);
/// Up turns about the direction of view; the picture turns clockwise.
projection::Camera rolled(const projection::Camera& camera, double degrees);
/// Eye and target move so that what is at the target's distance follows the pointer by `pixels` (right, down).
projection::Camera panned(const projection::Camera& camera, glm::dvec2 pixels);
/// Nearer by `factor` (> 0; below 1: farther), and what is at the target's distance under `pixel` stays there.
projection::Camera zoomedTo(const projection::Camera& camera, double factor, glm::dvec2 pixel);
/// The target becomes `point`, the direction stays.
projection::Camera centred(const projection::Camera& camera, glm::dvec3 point);
/// Orthographic and back, with what is at the target's distance of the same size.
projection::Camera withOtherProjection(const projection::Camera& camera);

/// `words` with this camera in place of any that they had. Numbers are written so that they are read back to the bit.
void setCamera(OptionWords& words, const projection::Camera& camera);
/// `words` with the camera's options taken out, field of view apart.
void removeCamera(OptionWords& words);
/// Whether they say where the eye stands, so that no other option can move it.
bool hasCamera(const OptionWords& words);

}  // namespace tetralux::apps::view
