# SPDX-License-Identifier: Apache-2.0
# The OpenGL side of tetralux_projection. No GL library is linked: contexts open theirs at run time, and glad writes the table of OpenGL's
# functions here, from the specification that its package brings.
include(gl/embed_shaders.cmake)

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
  gl/egl_context.cpp
  gl/gl_cell_buffer.cpp
  gl/gl_cell_order.cpp
  gl/gl_cell_outline.cpp
  gl/gl_cell_program.cpp
  gl/gl_cell_stream.cpp
  gl/gl_compute.cpp
  gl/gl_context.cpp
  gl/gl_draw_trial.cpp
  gl/gl_engine.cpp
  gl/gl_frame_target.cpp
  gl/gl_functions.cpp
  gl/gl_limits.cpp
  gl/gl_path.cpp
  gl/gl_program.cpp
  gl/gl_radix_sort.cpp
  gl/gl_resident_cells.cpp
  gl/gl_resolve.cpp
  gl/gl_sampler_probe.cpp
  gl/gl_tiles.cpp
  gl/gl_walk.cpp
  gl/osmesa_context.cpp
  gl/shared_library.cpp
)
target_link_libraries(tetralux_projection PRIVATE tetralux_glad ${CMAKE_DL_LIBS})
tetralux_embed_shaders(tetralux_projection FILES
  preint/gather_segment.glsl
  preint/glsl_prelude.glsl
  preint/table_lookup.glsl
  projection/cells/cell_interval.glsl
  projection/cells/cell_outline.glsl
  projection/cells/covered_pixels.glsl
  projection/gl/gl_cell_corners.glsl
  projection/gl/gl_cell_doubles.glsl
  projection/gl/gl_cell_setup.comp
  projection/gl/gl_compact.comp
  projection/gl/gl_compute.glsl
  projection/gl/gl_cull.comp
  projection/gl/gl_order_check.comp
  projection/gl/gl_order_places.comp
  projection/gl/gl_plan.comp
  projection/gl/gl_points.comp
  projection/gl/gl_radix_count.comp
  projection/gl/gl_radix_scatter.comp
  projection/gl/gl_scan.comp
  projection/gl/gl_settle_ties.comp
  projection/order/order_position.glsl
  projection/cells/projected_cell.glsl
  projection/gl/gl_cell.frag
  projection/gl/gl_cell_pixel.glsl
  projection/gl/gl_cell.vert
  projection/gl/gl_cell_record.glsl
  projection/gl/gl_full_screen.vert
  projection/gl/gl_light.glsl
  projection/gl/gl_modes.glsl
  projection/gl/gl_precision.glsl
  projection/gl/gl_sampler_probe.frag
  projection/gl/gl_segment.glsl
  projection/gl/gl_table.glsl
  projection/gl/gl_tile_bin.comp
  projection/gl/gl_tile_draw.comp
  projection/gl/gl_tile_outline.glsl
  projection/gl/gl_tile_plan.comp
  projection/gl/gl_tile_ranges.comp
  projection/gl/gl_variants.glsl
  projection/gl/gl_walk.glsl
  shading/cell_shading.glsl
  shading/light_model.glsl
  shading/silhouette.glsl
  shading/surface_shadow.glsl
)
