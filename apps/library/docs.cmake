# SPDX-License-Identifier: Apache-2.0
# The target `docs`: the reference of the public headers by Doxygen, in BUILD/docs/html. What has no comment is an error.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
  set(DOXYGEN_PROJECT_NAME Tetralux)
  set(DOXYGEN_PROJECT_NUMBER ${PROJECT_VERSION})
  set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${CMAKE_CURRENT_SOURCE_DIR}/README.md)
  set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR}/projection/renderer ${CMAKE_CURRENT_SOURCE_DIR})
  set(DOXYGEN_STRIP_FROM_INC_PATH ${DOXYGEN_STRIP_FROM_PATH})
  set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
  set(DOXYGEN_WARN_NO_PARAMDOC NO)  # parameters are told in sentences
  set(DOXYGEN_HIDE_UNDOC_RELATIONS NO)
  set(DOXYGEN_GENERATE_LATEX NO)
  set(DOXYGEN_HAVE_DOT NO)
  set(DOXYGEN_QUIET YES)
  set(DOXYGEN_EXAMPLE_PATH ${PROJECT_SOURCE_DIR}/apps)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/projection/renderer/tetralux/*.h ${CMAKE_CURRENT_SOURCE_DIR}/tetralux/*.h)
  doxygen_add_docs(docs ${headers} ${CMAKE_CURRENT_SOURCE_DIR}/README.md COMMENT "reference of the public headers: ${PROJECT_BINARY_DIR}/docs/html")
else()
  add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E echo "docs: doxygen is missing: apps/install_packages docs, then configure again"
                    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
