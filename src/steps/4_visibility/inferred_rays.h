#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

namespace vcarve {

/// The views that likely saw points of a dense cloud, but are missing in their tracks.
/// stereo_fusion lists only views whose own depths agreed, so the space in front of points with few
/// such views stays unproven. A point with fewer than five rays gets each view that
///   - saw a point around it: every fourth of the 64 next to it in the order of spatial_sort(),
///   - is in front of it, by its normal,
///   - and saw a point at a similar distance beside it in the image, and none clearly nearer in the
///     same square. Squares are twice as wide as the spacing of the view's points in its image.
/// So a wall without points still occludes, because its views saw nothing behind it. Scanners
/// record all their rays and get no more. Views ascend per point, and none is in the point's track.
/// Cost: O(rays log points) in parallel; 20 bytes per ray.
Tracks inferred_rays(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
