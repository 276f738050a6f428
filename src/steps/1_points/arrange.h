#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

namespace vcarve {

/// The same scene moved so that the median of its points is the origin, for work in doubles far
/// from the world's origin; the move is added to Scene::offset. Points that are not finite stay so
/// and do not count. Two points a few roundings apart may come to lie at one place. Cost: O(points
/// + views).
Scene center_points(Scene scene);

/// Moves a scene so that `origin`, a place in it, is the origin; adds it to Scene::offset. Cost:
/// O(points + views).
void move_origin(Scene& scene, const Eigen::Vector3d& origin);

/// The same scene with its points in the order of a Hilbert curve. The order depends only on where
/// the points are, not on the order they came in; points must be finite and no two at one place.
/// Cost: O(points log points), and 36 bytes a point beside the scene, if it is moved here.
Scene spatial_sort(Scene scene, const Progress& progress = {});

} // namespace vcarve
