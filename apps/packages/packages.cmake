# SPDX-License-Identifier: Apache-2.0
# Debian packages: `cmake --workflow --preset packages`, or `cpack -G DEB` in any build folder whose prefix is /usr.
#
#   tetralux          the program and its manual page
#   tetralux-mesher   the program that `tetralux mesh` starts: by its libraries under AGPL-3+ and GPL-3+, so apart
#   libtetralux-dev   headers, static libraries, CMake files
find_program(TETRALUX_GZIP gzip REQUIRED)

set(CPACK_PACKAGE_CONTACT "Tetralux <tetralux@tetralux.invalid>")

# What Debian wants in /usr/share/doc of each package: its licence, and a changelog in Debian's form.
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, where it is set
function(tetralux_package_documents component package copyright)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/changelog.in ${CMAKE_CURRENT_BINARY_DIR}/packages/${package}/changelog @ONLY)
  execute_process(COMMAND ${TETRALUX_GZIP} -9nf ${CMAKE_CURRENT_BINARY_DIR}/packages/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/packages/${package}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package}
          COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${copyright} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package} RENAME copyright
          COMPONENT ${component})
endfunction()
tetralux_package_documents(programs tetralux copyright)
tetralux_package_documents(library libtetralux-dev copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tetralux)
set(CPACK_PACKAGE_VENDOR Tetralux)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL programs library)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME tetralux)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "libegl1, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "tetralux-mesher, libosmesa6")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "pictures of scalar fields on unstructured meshes
Draws volumes, isosurfaces, silhouettes and light on tetrahedra and every other
solid cell type, in exact front-to-back order and with pre-integration, on a
processor or by OpenGL, without a window. How far a picture is from the exact
one is known, and can be measured.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libtetralux-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
# what the static libraries are linked with; VTK, which find_package asks for with COMPONENTS io only
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libfmt-dev, libtbb-dev, libpng-dev, libopenexr-dev, libhwy-dev, libdeflate-dev, liblz4-dev, pkgconf | pkg-config")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libvtk9-dev")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "pictures of scalar fields on unstructured meshes (development files)
Headers, static libraries and CMake files of Tetralux: a renderer that keeps a
mesh, a field and a transfer function, and draws them into the caller's memory.
The target tetralux::tetralux needs no VTK; tetralux::io reads files by VTK.")

if(TETRALUX_MESHER)
  tetralux_package_documents(mesher tetralux-mesher copyright-mesher)
  list(APPEND CPACK_COMPONENTS_ALL mesher)
  set(CPACK_DEBIAN_MESHER_PACKAGE_NAME tetralux-mesher)
  set(CPACK_DEBIAN_MESHER_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_MESHER_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_MESHER_PACKAGE_ENHANCES "tetralux")
  set(CPACK_COMPONENT_MESHER_DESCRIPTION "points, surfaces and other cells to tetrahedra
Turns closed surfaces and clouds of points with values into tetrahedra, mends
surfaces, coarsens meshes and tells the error that this makes. It is started by
\"tetralux mesh\". With TetGen it is under the AGPL, with CGAL under the GPL.")
endif()
include(CPack)
