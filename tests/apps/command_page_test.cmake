# SPDX-License-Identifier: Apache-2.0
#
# cmake -DPROGRAM=tetralux -DPAGE=COMMANDS.md -DFOLDER=… -P command_page_test.cmake: the page in the tree is what the program says of itself,
# and so is the manual page, which man takes without a warning.
execute_process(COMMAND ${PROGRAM} --reference markdown OUTPUT_FILE ${FOLDER}/COMMANDS.md COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${FOLDER}/COMMANDS.md ${PAGE} RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "apps/COMMANDS.md is not what tetralux says of its options: cmake --build BUILD --target command_page")
endif()

execute_process(COMMAND ${PROGRAM} --reference man OUTPUT_FILE ${FOLDER}/tetralux.1 COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${FOLDER}/tetralux.1 lines)
foreach(option --output --scalar --mode --verify --isosurface --max-rmse)  # a roff hyphen is a minus only when escaped
  string(REPLACE "-" "\\-" escaped "${option}")
  string(FIND "${lines}" "${escaped}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "the manual page does not name ${option}")
  endif()
endforeach()
find_program(man man)
if(man)
  set(ENV{MANROFFSEQ} "")
  set(ENV{MANWIDTH} 80)
  set(ENV{LC_ALL} C.UTF-8)
  execute_process(COMMAND ${man} --warnings -E UTF-8 -l -Tutf8 -Z ${FOLDER}/tetralux.1 OUTPUT_QUIET ERROR_VARIABLE warnings RESULT_VARIABLE failed)
  if(failed OR NOT warnings STREQUAL "")
    message(FATAL_ERROR "man complains of the manual page: ${warnings}")
  endif()
endif()

execute_process(COMMAND ${PROGRAM} --reference html RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE error)
if(NOT status EQUAL 2 OR NOT out STREQUAL "" OR NOT error MATCHES "^tetralux: --reference: there is no 'html'; take markdown or man\n$")
  message(FATAL_ERROR "--reference html: status ${status}, '${out}', '${error}'")
endif()
