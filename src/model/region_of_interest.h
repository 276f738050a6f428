#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

namespace vcarve {

struct Ball {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0.0;
};

/// The ball that holds what was looked at, whatever lies far behind: 94 % of the sights end in it.
/// Its centre is the mean of where those end, found in four rounds from the mean of all. It turns
/// with the scene, unlike a box along the axes. Of radius 0 where there are no sights.
/// Cost: O(points).
Ball region_of_interest(const Scene& scene);

} // namespace vcarve
