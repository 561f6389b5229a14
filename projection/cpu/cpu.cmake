# SPDX-License-Identifier: Apache-2.0
# The tile engine. Its kernels are compiled once per instruction set by Highway, which picks one at run time.
find_package(PkgConfig REQUIRED)
pkg_check_modules(Highway REQUIRED IMPORTED_TARGET libhwy)
target_sources(tetralux_projection PRIVATE
  cpu/cpu_bins.cpp
  cpu/cpu_cull_kernel.cpp
  cpu/cpu_engine.cpp
  cpu/cpu_limited_kernel.cpp
  cpu/cpu_limits.cpp
  cpu/cpu_order.cpp
  cpu/cpu_quick_look.cpp
  cpu/cpu_special_cell.cpp
  cpu/cpu_tile_kernel.cpp
  cpu/cpu_transfer.cpp
)
target_link_libraries(tetralux_projection PRIVATE PkgConfig::Highway)
# The least that vectors of four need; Highway's portable form has one lane.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(cpu/cpu_cull_kernel.cpp cpu/cpu_limited_kernel.cpp cpu/cpu_tile_kernel.cpp PROPERTIES COMPILE_OPTIONS "-msse4.2;-maes;-mpclmul")
endif()
# Sanitizers read one copy of the kernels as well as six: an instrumented one takes minutes to compile.
if(TETRALUX_SANITIZE)
  set_property(SOURCE cpu/cpu_cull_kernel.cpp cpu/cpu_limited_kernel.cpp cpu/cpu_tile_kernel.cpp APPEND PROPERTY
               COMPILE_OPTIONS "-DHWY_COMPILE_ONLY_STATIC;-O1")
endif()
