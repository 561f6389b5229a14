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
  run_program.cpp
)
target_compile_definitions(tetralux_bench PRIVATE TETRALUX_VERSION="${PROJECT_VERSION}")
target_link_libraries(tetralux_bench PUBLIC tetralux_plot tetralux_projection tetralux_io nlohmann_json::nlohmann_json PRIVATE fmt::fmt TBB::tbb)

target_sources(tetralux PRIVATE bench.cpp bench_options.cpp)
target_link_libraries(tetralux PRIVATE tetralux_bench)

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
