// SPDX-License-Identifier: Apache-2.0
/// \file
/// Interpolation between two display colours in the spaces that ParaView's colour maps name, by VTK's formulas, so that
/// a map looks here as it does there.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <preint/transfer_function.h>

namespace tetralux::preint {

enum class ColorSpace { Rgb, Hsv, HsvWrapped, Lab, Diverging, Step };

/// The colour (display RGB in [0, 1]) at `fraction` of the way from `first` to `second`.
glm::dvec3 interpolateColor(ColorSpace space, const glm::dvec3& first, const glm::dvec3& second, double fraction);

/// Piecewise linear RGB nodes that follow `nodes` interpolated in `space` to within 1/1024 of each channel. Step
/// becomes jumps.
std::vector<ColorNode> sampledInRgb(ColorSpace space, const std::vector<ColorNode>& nodes);

}  // namespace tetralux::preint
