# SPDX-License-Identifier: Apache-2.0
# `tetralux bench`, the program that draws VTK's rows for it, and the kernels' benchmark.
option(TETRALUX_BENCH_VTK "Build tetralux-bench-vtk, which draws VTK's rows of `tetralux bench`" ON)

# Plots as SVG and PNG.
add_library(tetralux_plot STATIC histogram_plot.cpp plot.cpp plot_png.cpp plot_svg.cpp)
target_link_libraries(tetralux_plot PUBLIC tetralux_projection PRIVATE tetralux_annotation fmt::fmt PkgConfig::CAIRO)

add_library(tetralux_bench STATIC
  bench_engine.cpp
  bench_machine.cpp
  bench_memory.cpp
  bench_output.cpp
  bench_row.cpp
  bench_run.cpp
  bench_scene.cpp
  bench_statistics.cpp
  bench_vtk_rows.cpp
  option_values.cpp
)
target_compile_definitions(tetralux_bench PRIVATE TETRALUX_VERSION="${PROJECT_VERSION}")
target_link_libraries(tetralux_bench PUBLIC tetralux_plot tetralux_projection tetralux_io nlohmann_json::nlohmann_json PRIVATE fmt::fmt TBB::tbb)

target_sources(tetralux PRIVATE bench.cpp bench_options.cpp)
target_link_libraries(tetralux PRIVATE tetralux_bench)

# CLI11 costs each file that includes it ten seconds, so these are compiled as two.
set_target_properties(tetralux PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
set_source_files_properties(render.cpp render_options.cpp light_options.cpp opaque_options.cpp shape_options.cpp options/camera_options.cpp
  options/color_options.cpp options/part_options.cpp options/time_options.cpp PROPERTIES UNITY_GROUP rendering)
set_source_files_properties(bench.cpp bench_options.cpp colors.cpp command_reference.cpp compare.cpp extract.cpp info.cpp main.cpp
  mesh_command.cpp read_options.cpp PROPERTIES UNITY_GROUP commands)

tetralux_precompile(tetralux_plot tetralux_bench)

if(TETRALUX_BENCH_VTK)
  add_subdirectory(bench_vtk)
endif()

if(TETRALUX_TESTS)
  find_package(benchmark)
  if(benchmark_FOUND)
    add_executable(tetralux-bench-kernels bench_kernels.cpp)
    target_link_libraries(tetralux-bench-kernels PRIVATE tetralux_bench benchmark::benchmark)
  endif()
endif()
