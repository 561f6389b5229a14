# SPDX-License-Identifier: Apache-2.0
#
# cmake -DREADELF=… -DPROGRAM=… -P no_vtk_test.cmake: a program that links tetralux_projection alone needs no VTK.
execute_process(COMMAND ${READELF} -d ${PROGRAM} OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^[]*vtk[^]]*" found "${needed}")
if(found OR NOT needed MATCHES "libtbb")
  message(FATAL_ERROR "${PROGRAM} needs VTK: ${found}")
endif()
