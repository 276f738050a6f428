#pragma once

#include "base/progress.h"
#include "model/scene_points.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// So many points are merged at a time.
inline constexpr std::size_t kThinnedAtOnce = std::size_t{1} << 20U;

/// Merges points that lie nearer to each other than the images they were seen in can tell, so that
/// a dense cloud has one point where it had many and none of its sights is lost. A point's
/// footprint is what `merge_px` pixels of the view that shows it largest cover at its distance.
/// Space is cut into cubes whose sides are halves and doubles of the median footprint; points whose
/// footprint is the side of a cube or up to twice that, and which lie in the same cube, become one,
/// finer points first, and coarser points join finer ones in their cube. Points whose normals
/// differ by more than 60 degrees stay apart, as the two sides of a board or of an edge. Then
/// clusters that stand nearer than half a cube to each other across a border are merged alike in
/// cubes shifted by half.
///
/// A cluster stands at the mean of its points and has the mean of their colours and normals and all
/// views that saw any; error and id are those of the point with most views, the first of several.
/// The order is that of these points. The result does not depend on the number of threads, and not
/// on where and how large the scene is, but on how it is turned.
/// (COLMAP's delaunay_mesher drops points by their distance in pixels and depth, one by one in
/// random order, and keeps the dropped points' sights with a corner of the cell they lie in.)
/// Points that no view saw stay as they are, and so do those whose reprojection error is known: a
/// matcher found them one by one.
///
/// Points are taken `at_once` at a time, and merged among each other; what is left of all parts is
/// merged again in the same cubes, at the end and whenever it has doubled, as if each were a point.
/// So at no time are more points in memory than one part and what is left of those before, which is
/// at most four parts, or twice what was left when it was merged last; of a merged-away point only
/// those of its sights remain that the others do not have. The median
/// footprint, and the origin of the result, which is the median of the points, are those of the
/// first part. Cost: O(points log points + sights), in parallel. Throws what the parts throw.
Scene thin_points(SceneParts& parts, const ThinOptions& options, const Progress& progress = {},
                  std::size_t at_once = kThinnedAtOnce);

/// The same of a scene in memory.
Scene thin_points(const Scene& scene, const ThinOptions& options, const Progress& progress = {});

} // namespace vcarve
