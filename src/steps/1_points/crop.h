#pragma once

#include "base/progress.h"
#include "region/region.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

struct CroppedPoints {
    Scene scene;
    std::int64_t inside = 0;    ///< points inside the region
    std::int64_t witnesses = 0; ///< points outside with a ray that passes through the region
};

/// Returns the points that affect a region, in the same order. Inside points keep all rays. Outside
/// points keep the rays that pass through the region (witnesses), so that these still mark its free
/// space. Throws InputError if no point is inside the region; a scene without points is returned
/// unchanged. Cost: one region query per point and per ray of an outside point, in parallel.
CroppedPoints crop_points(Scene scene, const Region& region, const Progress& progress = {});

} // namespace vcarve
