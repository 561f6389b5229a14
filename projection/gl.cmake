# SPDX-License-Identifier: Apache-2.0
# The OpenGL side of tetralux_projection. No GL library is linked: contexts open theirs at run time, and glad writes the table of OpenGL's
# functions here, from the specification that its package brings.
include(embed_shaders.cmake)

find_program(GLAD_PROGRAM glad)
if(NOT GLAD_PROGRAM)
  message(FATAL_ERROR "glad, which writes the OpenGL function table, is missing: apt install python3-glad")
endif()
set(glad_dir ${CMAKE_CURRENT_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h ${glad_dir}/include/KHR/khrplatform.h
  COMMAND ${GLAD_PROGRAM} --quiet --reproducible --api gl:core=4.5 --extensions= --out-path ${glad_dir} c --mx
  COMMENT "Writing the OpenGL function table" VERBATIM)
add_library(tetralux_glad STATIC ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h)
target_include_directories(tetralux_glad SYSTEM PUBLIC ${glad_dir}/include)

target_sources(tetralux_projection PRIVATE
  egl_context.cpp
  gl_cell_outline.cpp
  gl_context.cpp
  gl_functions.cpp
  gl_program.cpp
  osmesa_context.cpp
  shared_library.cpp
)
target_link_libraries(tetralux_projection PRIVATE tetralux_glad ${CMAKE_DL_LIBS})
tetralux_embed_shaders(tetralux_projection FILES
  projection/gl_cell.vert
  projection/gl_cell_record.glsl
)
