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
target_include_directories(tetralux_glad SYSTEM PUBLIC $<BUILD_INTERFACE:${glad_dir}/include>)
target_compile_options(tetralux_glad PRIVATE -w)  # not our code

target_sources(tetralux_projection PRIVATE
  egl_context.cpp
  gl_cell_buffer.cpp
  gl_cell_order.cpp
  gl_cell_outline.cpp
  gl_cell_program.cpp
  gl_cell_stream.cpp
  gl_compute.cpp
  gl_context.cpp
  gl_draw_trial.cpp
  gl_engine.cpp
  gl_frame_target.cpp
  gl_functions.cpp
  gl_limits.cpp
  gl_path.cpp
  gl_program.cpp
  gl_radix_sort.cpp
  gl_resident_cells.cpp
  gl_resolve.cpp
  gl_sampler_probe.cpp
  gl_tiles.cpp
  osmesa_context.cpp
  shared_library.cpp
  transfer_support.cpp
)
target_link_libraries(tetralux_projection PRIVATE tetralux_glad ${CMAKE_DL_LIBS})
tetralux_embed_shaders(tetralux_projection FILES
  preint/gather_segment.glsl
  preint/glsl_prelude.glsl
  preint/table_lookup.glsl
  projection/cell_interval.glsl
  projection/cell_outline.glsl
  projection/covered_pixels.glsl
  projection/gl_cell_corners.glsl
  projection/gl_cell_doubles.glsl
  projection/gl_cell_setup.comp
  projection/gl_compact.comp
  projection/gl_compute.glsl
  projection/gl_cull.comp
  projection/gl_order_check.comp
  projection/gl_order_places.comp
  projection/gl_plan.comp
  projection/gl_points.comp
  projection/gl_radix_count.comp
  projection/gl_radix_scatter.comp
  projection/gl_scan.comp
  projection/gl_settle_ties.comp
  projection/order_position.glsl
  projection/projected_cell.glsl
  projection/gl_cell.frag
  projection/gl_cell_pixel.glsl
  projection/gl_cell.vert
  projection/gl_cell_record.glsl
  projection/gl_full_screen.vert
  projection/gl_light.glsl
  projection/gl_modes.glsl
  projection/gl_precision.glsl
  projection/gl_sampler_probe.frag
  projection/gl_segment.glsl
  projection/gl_table.glsl
  projection/gl_tile_bin.comp
  projection/gl_tile_draw.comp
  projection/gl_tile_outline.glsl
  projection/gl_tile_plan.comp
  projection/gl_tile_ranges.comp
  projection/gl_variants.glsl
  shading/cell_shading.glsl
  shading/light_model.glsl
  shading/silhouette.glsl
)
