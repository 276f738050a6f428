include(GoogleTest)

# vcarve_discover_tests(TARGET) adds every test of a program to ctest. With sanitizers it adds every
# suite instead, because starting a process for each test would take longer than the tests.
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
