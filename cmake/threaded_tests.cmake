# vcarve_threaded_tests(OUT TEST...) sets OUT to the test files that use several threads: files that mention
# threads, and those listed here. Other tests have too little input for parallel loops. The pipeline's tests
# run every step on several threads. Tests that run the whole program are excluded, because ThreadSanitizer
# is slow.
function(vcarve_threaded_tests out)
  set(threaded "")
  foreach(test IN LISTS ARGN)
    file(READ ${test} text)
    if(text MATCHES "[Tt]hread|parallel" AND NOT text MATCHES "support/program\\.h")
      list(APPEND threaded ${test})
    endif()
  endforeach()
  foreach(test IN ITEMS baselines/baseline_surface_test.cpp io/colmap/colmap_model_test.cpp
      io/dense/dense_scene_test.cpp io/dense/scan_scene_test.cpp)
    if(test IN_LIST ARGN)
      list(APPEND threaded ${test})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES threaded)
  set(${out} ${threaded} PARENT_SCOPE)
endfunction()
