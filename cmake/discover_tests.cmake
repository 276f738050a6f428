include(GoogleTest)

# vcarve_discover_tests(TARGET) tells ctest of every test in a program. Where it is sanitized ctest
# gets a test for every suite instead, since many more would take longer to start than to test.
function(vcarve_discover_tests target)
  if(VCARVE_SANITIZE)
    set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    add_custom_command(TARGET ${target} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D OUTPUT=${suites}
        -P ${PROJECT_SOURCE_DIR}/cmake/list_suites.cmake)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites})
  else()
    gtest_discover_tests(${target} DISCOVERY_TIMEOUT 120)
  endif()
endfunction()
