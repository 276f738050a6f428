#pragma once

#include "base/progress.h"
#include "model/scene_points.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// The default number of points that are merged at a time.
inline constexpr std::size_t kThinnedAtOnce = std::size_t{1} << 20U;

/// Merges points that are closer than the images resolve. Dense clouds then have one point instead
/// of many, and keep all rays. The footprint of a point is the size of `merge_px` pixels at its
/// distance, in the view that shows it largest. The sides of cubes are powers of two times the
/// median footprint. Points are merged in the cube whose side is nearest to their footprint, finer
/// points first, and coarser points join finer ones in their cube. Points whose normals differ by
/// more than 60 degrees stay apart, such as the two sides of a board or an edge. Then clusters
/// across a border of cubes, closer than half a side, are merged in cubes shifted by a third of the
/// median footprint.
///
/// A cluster has the mean position, color and normal of its points and all their views. Its error
/// and id are those of the point with most views, the first of several. Clusters are in the order
/// of these points. The result does not depend on the thread count, or on the position and scale of
/// the scene, but on its rotation. (COLMAP's delaunay_mesher drops points by their distance in
/// pixels and depth, one by one in random order. It keeps their rays with a corner of the cell that
/// contains them.) Points that no view saw are unchanged. The pipeline merges only dense clouds,
/// since a matcher found the points of sparse models one by one.
///
/// Each part of `at_once` points is merged by itself. All results are merged again in the same
/// cubes, at the end and whenever their number has doubled. Each has the weight of its points. So
/// memory holds one part and the earlier results: at most four parts, or twice the last result.
/// Merged points keep only distinct rays. The median footprint and the origin of the result, which
/// is the median of the points, are those of the first part. Cost: O(points log points + rays), in
/// parallel. Throws the exceptions of `parts`.
Scene thin_points(SceneParts& parts, const ThinOptions& options, const Progress& progress = {},
                  std::size_t at_once = kThinnedAtOnce);

/// Merges the points of a scene in memory.
Scene thin_points(const Scene& scene, const ThinOptions& options, const Progress& progress = {});

} // namespace vcarve
