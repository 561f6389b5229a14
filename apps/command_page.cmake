# SPDX-License-Identifier: Apache-2.0
# The reference of the command line, written by the program itself (command_reference.h): the manual page, and COMMANDS.md, which stands in
# the tree; the test `command_page` holds it.
include(GNUInstallDirs)
find_program(TETRALUX_GZIP gzip REQUIRED)
set(manual ${CMAKE_CURRENT_BINARY_DIR}/tetralux.1.gz)
add_custom_command(OUTPUT ${manual} DEPENDS tetralux
                   COMMAND tetralux --reference man > ${CMAKE_CURRENT_BINARY_DIR}/tetralux.1
                   COMMAND ${TETRALUX_GZIP} -9nf ${CMAKE_CURRENT_BINARY_DIR}/tetralux.1)
set(completion ${CMAKE_CURRENT_BINARY_DIR}/completion/tetralux)  # bash-completion looks for a file named as the program
add_custom_command(OUTPUT ${completion} DEPENDS tetralux
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/completion
                   COMMAND tetralux --reference bash > ${completion})
add_custom_target(manual ALL DEPENDS ${manual} ${completion})
install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT programs)
install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
add_custom_target(command_page COMMAND tetralux --reference markdown > ${CMAKE_CURRENT_SOURCE_DIR}/COMMANDS.md)
