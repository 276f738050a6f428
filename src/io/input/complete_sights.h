#pragma once

#include "base/progress.h"
#include "io/colmap/colmap_model.h"
#include "io/input/find_input.h"
#include "vcarve/scene.h"

#include <string>
#include <vector>

namespace vcarve {

/// Sees to the sights of a model's points, where most of them have fewer than two, as those of
/// SLAM, of networks that need no matches, and of many converters have: takes them from the 2D
/// points of the images, as COLMAP's own mesher does, and where that leaves most points with fewer
/// than two, adds to these points the nearest views (see nearest_sights). With SightsFrom::nearest
/// all points have those only, with SightsFrom::file none. Returns what the user should know, in
/// sentences; of the sights that were `dropped`, too. Cost: that of reading images, and
/// nearest_sights.
std::vector<std::string> complete_sights(const FoundInput& found, const DroppedSights& dropped,
                                         Scene& scene, const Progress& progress = {});

} // namespace vcarve
