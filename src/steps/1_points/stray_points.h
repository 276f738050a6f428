#pragma once

#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// Drops stray points: false matches that two views agree on by chance, far before or behind what
/// is there, from which giant faces and needles would hang. Two views cannot tell them from good
/// points, but what stands around can: features come in crowds. How alone a point stands is the
/// distance to the 4th nearest of the others over that to the nearest of the views that saw it, so
/// that the background, which is sampled as densely as seen, stands no more alone than what is
/// near. Of the points of at most two views those go that stand `stray_spacing` times more alone
/// than the median point; two thirds of that where the reprojection error is among the largest
/// twentieth, and 1.75 times that where it is below the median. What is usual is estimated from
/// some thousand points, evenly spread. Points that a scanner measured stay. The points follow each
/// other in space, as spatial_sort() puts them; their order stays. Returns how many were dropped.
/// Cost: O(points log points), in parallel, and 4 bytes a point.
std::int64_t drop_stray_points(Scene& scene, const FilterOptions& options);

} // namespace vcarve
