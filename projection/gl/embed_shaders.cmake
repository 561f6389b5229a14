# SPDX-License-Identifier: Apache-2.0
# tetralux_embed_shaders(target FILES …): compiles GLSL texts into the target as what projection/gl/gl_shader_text.h declares, by their
# paths from the project's root. Editing a text rebuilds it.
function(tetralux_embed_shaders target)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(entries "")
  foreach(file IN LISTS ARG_FILES)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
    file(READ ${PROJECT_SOURCE_DIR}/${file} text)
    string(APPEND entries "    {\"${file}\", R\"glsl(${text})glsl\"},\n")
  endforeach()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/gl_shader_text.cpp)
  file(CONFIGURE OUTPUT ${generated} @ONLY CONTENT "// Made by projection/gl/embed_shaders.cmake.
#include <projection/gl/gl_shader_text.h>

#include <stdexcept>
#include <string>

namespace tetralux::projection {

std::string_view glShaderText(std::string_view path) {
    static constexpr struct { std::string_view path, text; } texts[] = {
@entries@    };
    for (const auto& entry : texts) {
        if (entry.path == path) return entry.text;
    }
    throw std::runtime_error(\"shader '\" + std::string(path) + \"': not embedded; add it to projection/gl/gl.cmake\");
}

}  // namespace tetralux::projection
")
  target_sources(${target} PRIVATE ${generated})
endfunction()
