# cmake --install gives the program, its man page and completion, and for find_package(vcarve) the
# library with its headers.
include(CMakePackageConfigHelpers)

install(TARGETS colmap-vcarve RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${completion} RENAME colmap-vcarve
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

install(TARGETS vcarve EXPORT vcarve_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vcarve
  FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/vcarve)
install(EXPORT vcarve_targets NAMESPACE vcarve:: FILE vcarveTargets.cmake
  DESTINATION ${package_folder})
configure_package_config_file(cmake/vcarveConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/vcarveConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfigVersion.cmake
  DESTINATION ${package_folder})
