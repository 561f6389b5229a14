// SPDX-License-Identifier: Apache-2.0
/// \file
/// The values that options take, from text. Every function throws std::runtime_error with `option`, what is wrong and
/// what to give.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <projection/core/scene.h>

namespace tetralux::apps {

/// "x,y,z": three finite numbers.
glm::dvec3 parseVector(const std::string& option, const std::string& text);

/// `count` finite numbers with commas; `form` names them: "px,py,pz,nx,ny,nz".
std::vector<double> parseNumbers(const std::string& option, const std::string& text, std::size_t count,
                                 const std::string& form);

/// "r,g,b" with each from 0 to 1.
glm::dvec3 parseColor(const std::string& option, const std::string& text);

/// "WxH": whole numbers from 1 to 16384.
glm::ivec2 parseSize(const std::string& option, const std::string& text);

/// "r,g,b" with each from 0 to 1, or "none".
std::optional<glm::vec3> parseBackground(const std::string& option, const std::string& text);

projection::Mode parseMode(const std::string& option, const std::string& text);
std::string modeName(projection::Mode mode);
std::string modeNames();  ///< with commas, for help and messages

/// RenderSettings::everyNode from "auto" or "exact".
bool parseIntegration(const std::string& option, const std::string& text);
projection::OrderMethod parseOrder(const std::string& option, const std::string& text);
std::string orderName(projection::OrderMethod order);
std::string orderNames();  ///< with commas

}  // namespace tetralux::apps
