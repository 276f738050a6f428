# cmake --install installs the library and its public headers for find_package(vcarve) and pkg-config.
# It also installs the program, its man page and completion if the program was built.
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
  set(VCARVE_STATIC_LIBS "")
else()
  set(VCARVE_IS_SHARED FALSE)
  string(CONCAT VCARVE_STATIC_LIBS " -lOpenMeshTools -lOpenMeshCore -ltbb -ltbbmalloc -lfmt"
    " -lgmp -lmpfr -lmeshoptimizer -lembree${EMBREE_VERSION_MAJOR} -ljpeg -lpng -ltiff -lwebp")
endif()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/vcarveConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/vcarveConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/vcarveConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindWebP.cmake
  DESTINATION ${package_folder})

file(RELATIVE_PATH VCARVE_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${PROJECT_SOURCE_DIR}/cmake/vcarve.pc.in ${CMAKE_CURRENT_BINARY_DIR}/vcarve.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vcarve.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Targets that were not built are skipped: `tools/build vcarve` builds the library, tools/run the program.
if(VCARVE_PROGRAM)
  # The program finds a shared library in its prefix without the system's configuration.
  set(programs colmap-vcarve colmap-vcarve-mpi)
  set_target_properties(${programs} PROPERTIES
    INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} OPTIONAL)
  install(FILES ${PROJECT_BINARY_DIR}/colmap-vcarve.1
    DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/completion.bash RENAME colmap-vcarve
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)
endif()
