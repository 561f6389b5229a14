// SPDX-License-Identifier: Apache-2.0
/// \file
/// Colour maps by the names that people know: all of matplotlib's and ParaView's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <preint/transfer_function.h>

namespace tetralux::preint {

struct ColorMap {
    std::string name;                    ///< as its makers write it, with "_r" where it is reversed
    std::vector<ColorNode> nodes;        ///< over fractions from 0 to 1, linear between them in RGB
    std::vector<glm::dvec3> categories;  ///< a categorical map's colours, one for each value; else empty
};

/// By its name in any case, with or without what is no letter or digit ("coolToWarm" is "Cool to Warm"), or by an alias
/// (coolwarm, jet, grey …); "_r" at the end reverses it. \throws std::runtime_error for others, naming those nearest.
ColorMap colorMap(std::string_view name);

/// Whether there is one of that name.
bool isColorMap(std::string_view name);

/// All of them, as their makers write them, without aliases and reverses.
std::vector<std::string> colorMapNames();

}  // namespace tetralux::preint
