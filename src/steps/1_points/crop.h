#pragma once

#include "base/progress.h"
#include "region/region.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

struct CroppedPoints {
    Scene scene;
    std::int64_t inside = 0;    ///< points within the region
    std::int64_t witnesses = 0; ///< points outside that some view saw through the region
};

/// The points that say something about a region, in the same order: those within it with all their
/// sights, and of those outside the witnesses, with the sights that pass through the region. So
/// what was seen to be empty there stays so, wherever the sight ends. Throws InputError where no
/// point lies within the region; a scene without points stays as it is. Cost: a question to the
/// region a sight of a point outside, in parallel.
CroppedPoints crop_points(Scene scene, const Region& region, const Progress& progress = {});

} // namespace vcarve
