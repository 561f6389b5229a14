// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tetralux::projection {

/// The text of a shader file that the build has embedded, by its path from the project's root:
/// "projection/gl/gl_cell.frag". \throws std::runtime_error when there is none of that name.
std::string_view glShaderText(std::string_view path);

}  // namespace tetralux::projection
