#pragma once

#include "model/usual_values.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <functional>

namespace vcarve {

/// Measures the usual values of a model in about eight windows of at most 8,000 neighboring points,
/// which are in at most eight of its tiles, and returns the median of each value. `log` is only
/// asked whether to stop. Cost: that of a run with 64,000 points, and reading eight tiles.
UsualValues measure_usual_values(std::size_t tiles,
                                 const std::function<Scene(std::size_t tile)>& points_of,
                                 const Options& options, const Log& log);

} // namespace vcarve
