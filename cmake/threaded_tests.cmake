# vcarve_threaded_tests(OUT TEST...) puts into OUT those of the files that test what several threads
# do: that name threads, or whose subject, the file of src/ that they are called after, loops in
# parallel; and those called after what they use, named here. What runs the whole program is left out:
# ThreadSanitizer takes long for it, and the tests of the library do in parallel all that it does.
function(vcarve_threaded_tests out)
  set(named baselines/baseline_surface_test.cpp io/colmap/colmap_model_test.cpp
    io/dense/dense_scene_test.cpp io/dense/scan_scene_test.cpp)
  set(threaded "")
  foreach(test IN LISTS ARGN)
    string(REPLACE "_test.cpp" "" subject ${test})
    set(text "")
    foreach(file IN ITEMS ${PROJECT_SOURCE_DIR}/src/${subject}.cpp
        ${PROJECT_SOURCE_DIR}/src/${subject}.h ${CMAKE_CURRENT_SOURCE_DIR}/${test})
      if(EXISTS ${file})
        file(READ ${file} part)
        string(APPEND text "${part}")
      endif()
    endforeach()
    if(test IN_LIST named OR
        (text MATCHES "[Tt]hread|parallel|tbb" AND NOT text MATCHES "support/program\\.h"))
      list(APPEND threaded ${test})
    endif()
  endforeach()
  set(${out} ${threaded} PARENT_SCOPE)
endfunction()
