#pragma once

#include "model/usual_values.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// Drops stray points. A stray point is a false match that two views agree on by chance. It is far
/// in front of or behind the surface, and causes giant faces and needles. Two views cannot
/// distinguish it from a good point, but its isolation can, because features cluster. The isolation
/// of a point is the distance to the 4th nearest other point, over the distance to the nearest view
/// that saw it. So the background, sampled as densely in images, is no more isolated than the
/// foreground. A point with at most two views is dropped if its isolation is at least
/// `stray_spacing` times the median. The limit is two thirds of that for the largest twentieth of
/// reprojection errors, and 1.75 times that for errors below the median. The medians come from some
/// thousand evenly spread points. Points of scanners stay. The points must be in the order of
/// spatial_sort(), which is kept. Returns the number of dropped points. Cost: O(points log points),
/// in parallel, and 4 bytes per point.
std::int64_t drop_stray_points(Scene& scene, const FilterOptions& options,
                               UsualValues* usual = nullptr);

} // namespace vcarve
