#pragma once

#include "model/usual_values.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

namespace vcarve {

/// Measures the usual values of a model in at most eight windows of about 8,000 neighboring points,
/// and returns the median of each value. `log` is only asked whether to stop. Cost: that of a run
/// with 64,000 points, and O(points).
UsualValues measure_usual_values(const Scene& scene, const Options& options, const Log& log);

} // namespace vcarve
