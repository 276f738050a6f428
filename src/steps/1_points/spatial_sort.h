#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

namespace vcarve {

/// The same scene with its points in the order of a Hilbert curve. The order depends only on where
/// the points are, not on the order they came in; points must be finite and no two at one place.
/// Cost: O(points log points).
Scene spatial_sort(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
