# SPDX-License-Identifier: Apache-2.0
# The tile engine. Its kernels are compiled once per instruction set by Highway, which picks one at run time.
find_package(PkgConfig REQUIRED)
pkg_check_modules(Highway REQUIRED IMPORTED_TARGET libhwy)
target_sources(tetralux_projection PRIVATE
  cpu/cpu_bins.cpp
  cpu/cpu_cull_kernel.cpp
  cpu/cpu_engine.cpp
  cpu/cpu_clipped_kernel.cpp
  cpu/cpu_limits.cpp
  cpu/cpu_order.cpp
  cpu/cpu_quick_variant.cpp
  cpu/cpu_special_cell.cpp
  cpu/cpu_tile_kernel.cpp
  cpu/cpu_transfer.cpp
)
target_link_libraries(tetralux_projection PRIVATE PkgConfig::Highway)
set(kernels cpu/cpu_cull_kernel.cpp cpu/cpu_clipped_kernel.cpp cpu/cpu_tile_kernel.cpp)
# Sanitizers read one copy of the kernels as well as all of them, and an instrumented one takes minutes to compile; whoever
# works on kernels waits for one copy too.
if(TETRALUX_SANITIZE)
  set_source_files_properties(${kernels} PROPERTIES COMPILE_OPTIONS "-msse4.2;-maes;-mpclmul;-DHWY_COMPILE_ONLY_STATIC;-O1")
elseif(TETRALUX_ONE_INSTRUCTION_SET)
  set_source_files_properties(${kernels} PROPERTIES COMPILE_OPTIONS "-march=haswell;-maes;-mpclmul;-DHWY_COMPILE_ONLY_STATIC")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # the least that vectors of four need; Highway's portable form has one lane
  set_source_files_properties(${kernels} PROPERTIES COMPILE_OPTIONS "-msse4.2;-maes;-mpclmul")
endif()
set_source_files_properties(${kernels} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)  # other options
