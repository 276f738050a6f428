# vcarve_threaded_tests(OUT TEST...) puts into OUT those of the files that test what several threads
# do: that name threads, and those named here. Loops cut little input into one piece, so that other
# tests would show nothing; those of the pipeline run every pass on several threads. What runs the whole
# program is left out: ThreadSanitizer takes long for it.
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
