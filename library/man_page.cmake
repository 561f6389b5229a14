# SPDX-License-Identifier: Apache-2.0
#
# cmake -DPROGRAM=… -DNAME=… -DCOMMANDS=a;b -DVERSION=… -DOUTPUT=… -P man_page.cmake: a manual page of what the program's --help says.
cmake_minimum_required(VERSION 3.25)

# `text` as lines that troff leaves as they are.
function(as_roff text out)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

function(add_section title)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  as_roff("${help}" help)
  string(STRIP "${help}" help)
  set(page "${page}.SH ${title}\n.nf\n${help}\n.fi\n" PARENT_SCOPE)
endfunction()

set(upper ${NAME})
string(TOUPPER ${NAME} upper)
as_roff(${NAME} name)
set(page ".TH ${upper} 1 \"\" \"${NAME} ${VERSION}\" \"User Commands\"\n.SH NAME\n${name} \\- ${SUMMARY}\n")
add_section(SYNOPSIS)
foreach(command IN LISTS COMMANDS)
  string(TOUPPER ${command} title)
  add_section(${title} ${command})
endforeach()
file(WRITE ${OUTPUT} "${page}")
execute_process(COMMAND gzip -9nf ${OUTPUT} COMMAND_ERROR_IS_FATAL ANY)
