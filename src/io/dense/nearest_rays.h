#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// The maximum number of rays per point.
inline constexpr std::size_t kMostNearestViews = 8;

/// Estimates the tracks of points without visibility data. Among the nearest 32 views with a point
/// in their image, the point gets the nearest ones that see it with no other point clearly in
/// front.
///
/// Each view has a z-buffer of square tiles, two mean point spacings wide. For sparse points they
/// are four spacings wide, measured in the part of the image that has points. A point is hidden by
/// nearer points in its tile, unless a surface of slope 2 (sparse points: 1) could contain both. So
/// a surface hides points behind it if it is sampled densely enough; through gaps, a view gets rays
/// to points that it did not see. Points that are not finite and views without an image size get no
/// rays. Of the points, only the positions and `is_dense` are used.
///
/// Cost: a view visits only points in the cone around its queried points that are no farther away.
/// So O(points log points + points log views) if views show what is near them, up to O(points x
/// views) otherwise; in parallel. Memory: 80 bytes per point and 50 MiB.
Tracks nearest_rays(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
