# SPDX-License-Identifier: Apache-2.0
#
# cmake -DBUILD=… -DEXAMPLE=…/example.cpp -DWORK=… [-DFLAGS=…] -P install_test.cmake: installs the library into an empty folder, builds the
# example against it as a stranger's project would, and draws a picture.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(WRITE ${WORK}/source/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(stranger LANGUAGES C CXX)
find_package(tetralux 0.1 REQUIRED)
add_executable(stranger ${EXAMPLE})
target_link_libraries(stranger PRIVATE tetralux::projection)
")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --component library --prefix ${WORK}/prefix)
# Debug: what matters is that it compiles, links and runs.
run(${CMAKE_COMMAND} -S ${WORK}/source -B ${WORK}/build -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/stranger bucky:6 ${WORK}/stranger.png)
file(SIZE ${WORK}/stranger.png size)
if(size LESS 1000)
  message(FATAL_ERROR "the installed library drew a picture of ${size} bytes")
endif()
