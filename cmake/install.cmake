# cmake --install gives the library with its public headers for find_package(vcarve), and where it is
# built the program with its man page and completion.
include(CMakePackageConfigHelpers)

install(TARGETS vcarve EXPORT vcarve_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/vcarve)
install(EXPORT vcarve_targets NAMESPACE vcarve:: FILE vcarveTargets.cmake
  DESTINATION ${package_folder})
get_target_property(library_type vcarve TYPE)
if(library_type STREQUAL "SHARED_LIBRARY")
  set(VCARVE_IS_SHARED TRUE)
else()
  set(VCARVE_IS_SHARED FALSE)
endif()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/vcarveConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/vcarveConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfigVersion.cmake
  DESTINATION ${package_folder})

if(VCARVE_PROGRAM)
  # A shared library beside it is found without being known to the system.
  set_target_properties(colmap-vcarve PROPERTIES
    INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS colmap-vcarve RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(TARGET colmap-vcarve-mpi)
    set_target_properties(colmap-vcarve-mpi PROPERTIES
      INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    install(TARGETS colmap-vcarve-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
  install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${completion} RENAME colmap-vcarve
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()
