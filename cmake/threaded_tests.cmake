# vcarve_threaded_tests(OUT TEST...) puts into OUT those of the files that test what several threads
# do: that name threads, or whose subject, the file of src/ that they are called after, loops in
# parallel; and those called after what they use, named here. What runs the whole program is left out:
# ThreadSanitizer takes long for it, and the tests of the library do in parallel all that it does.
function(vcarve_threaded_tests out)
  set(threaded baseline_surface_test.cpp colmap_model_test.cpp dense_scene_test.cpp scan_scene_test.cpp)
  foreach(test IN LISTS ARGN)
    string(REPLACE "_test.cpp" "" subject ${test})
    file(GLOB_RECURSE subjects ${PROJECT_SOURCE_DIR}/src/${subject}.cpp
      ${PROJECT_SOURCE_DIR}/src/${subject}.h)
    set(text "")
    foreach(file IN LISTS subjects ITEMS ${CMAKE_CURRENT_SOURCE_DIR}/${test})
      file(READ ${file} part)
      string(APPEND text "${part}")
    endforeach()
    if(text MATCHES "[Tt]hread|parallel|tbb" AND NOT text MATCHES "support/program\\.h")
      list(APPEND threaded ${test})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES threaded)
  set(${out} ${threaded} PARENT_SCOPE)
endfunction()
