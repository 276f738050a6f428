#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace vcarve {

/// The box without the share `tail`, below one half, of the positions at either end of each axis;
/// empty if there are none. Cost: O(positions).
Eigen::AlignedBox3d middle_box(const std::vector<Eigen::Vector3d>& positions, double tail = 0.05);

struct Ball {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0.0;
};

/// The ball that holds what was looked at, whatever lies far behind: 94 % of the sights end in it.
/// Its centre is the mean of where those end, found in four rounds from the mean of all. It turns
/// with the scene, unlike a box along the axes. Of radius 0 where there are no sights.
/// Cost: O(points).
Ball region_of_interest(const Scene& scene);

/// How much of what was looked at (region_of_interest) each view sees: in how many of the cubes
/// that fill the ball, 32 along its diameter, it saw points. Numbers of points would prefer a wall
/// seen from near, which has most of them. Of more than 100,000 points, that many, evenly chosen.
/// Cost: O(points + sights).
std::vector<std::size_t> seen_places(const Scene& scene);

} // namespace vcarve
