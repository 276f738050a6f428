#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

namespace vcarve {

/// Moves the scene so that the median of its points is the origin, and adds the shift to
/// Scene::offset. Doubles then keep their precision far from the world's origin. Non-finite points
/// stay non-finite and do not count. Points a few roundings apart may become coincident. Cost:
/// O(points + views).
Scene center_points(Scene scene);

/// Moves a scene so that its position `origin` becomes the origin, and adds it to Scene::offset.
/// Cost: O(points + views).
void move_origin(Scene& scene, const Eigen::Vector3d& origin);

/// Sorts the points along a Hilbert curve. The order depends only on the positions, not on the
/// input order. Points must be finite and distinct. Cost: O(points log points), and 36 bytes per
/// point beside the scene, if it is moved here.
Scene spatial_sort(Scene scene, const Progress& progress = {});

} // namespace vcarve
