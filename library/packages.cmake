# SPDX-License-Identifier: Apache-2.0
# `cpack -G DEB` in a build folder: tetralux (the program), tetralux-mesher (the helper that links copyleft libraries, a package of its own)
# and libtetralux-dev (headers, libraries, CMake files). What they depend on is what their binaries need, by dpkg-shlibdeps.
set(maintainer "Tetralux developers <tetralux@example.org>")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGE_VENDOR Tetralux)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL programs library)

set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "volume renderer for unstructured meshes
Draws scalar fields on unstructured meshes: volumes, isosurfaces, silhouettes
and light, in exact order from front to back, on a processor or a GPU.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME tetralux)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "libegl1, libosmesa6, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS tetralux-mesher)

set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "volume renderer for unstructured meshes (development files)
Headers, libraries and CMake files of Tetralux, which draws scalar fields on
unstructured meshes: find_package(tetralux), and with the component io the
readers, which need libvtk9-dev.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libtetralux-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libfmt-dev, libtbb-dev, libpng-dev, libopenexr-dev, libhwy-dev, liblz4-dev, libdeflate-dev, pkgconf")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS libvtk9-dev)

if(TETRALUX_MESHER)
  list(APPEND CPACK_COMPONENTS_ALL mesher)
  set(CPACK_COMPONENT_MESHER_DESCRIPTION "tetrahedra from surfaces and points
The helper program of \"tetralux mesh\". It links TetGen (AGPL-3) and CGAL, in
part GPL-3, which is why it has a package of its own.")
  set(CPACK_DEBIAN_MESHER_PACKAGE_NAME tetralux-mesher)
  set(CPACK_DEBIAN_MESHER_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_MESHER_PACKAGE_ENHANCES tetralux)
endif()

# What Debian's policy asks of every package: its licence and its changelog.
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(folder ${documents}/${package})
  configure_file(debian/copyright.in ${folder}/copyright @ONLY)
  file(WRITE ${folder}/changelog.Debian "${package} (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * CHANGELOG.md of Tetralux "
    "${PROJECT_VERSION} tells what has changed.\n\n -- ${maintainer}  ${date}\n")
  execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${folder}/copyright ${folder}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
