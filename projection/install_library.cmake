# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts down for programs that use the library: find_package(tetralux), then link tetralux::projection.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(library_targets)
foreach(part mesh io preint shading projection)
  add_library(tetralux::${part} ALIAS tetralux_${part})
  set_target_properties(tetralux_${part} PROPERTIES EXPORT_NAME ${part})
  list(APPEND library_targets tetralux_${part})
endforeach()
install(TARGETS ${library_targets} tetralux_headers tetralux_glad EXPORT tetralux ARCHIVE COMPONENT library)
install(DIRECTORY mesh preint shading projection DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tetralux COMPONENT library
        FILES_MATCHING PATTERN "*.h" PATTERN "*.inl" PATTERN "*.glsl")

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tetralux)
install(EXPORT tetralux NAMESPACE tetralux:: DESTINATION ${package_dir} COMPONENT library)
get_property(vtk_components GLOBAL PROPERTY TETRALUX_VTK_COMPONENTS)
list(JOIN vtk_components " " vtk_components)
configure_package_config_file(projection/tetralux-config.cmake.in tetralux-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(tetralux-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tetralux-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/tetralux-config-version.cmake
        DESTINATION ${package_dir} COMPONENT library)
