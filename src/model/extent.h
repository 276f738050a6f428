#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace vcarve {

/// The bounding box without the fraction `tail` (below 1/2) of the positions at both ends of each
/// axis; empty without positions. Cost: O(positions).
Eigen::AlignedBox3d middle_box(const std::vector<Eigen::Vector3d>& positions, double tail = 0.05);

struct Ball {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0.0;
};

/// The ball that contains the ends of 94 % of the rays. This excludes the distant background. The
/// center is the mean of these ends, found in four iterations from the mean of all ends. Unlike an
/// axis-aligned box, the ball rotates with the scene. The radius is 0 without rays.
/// Cost: O(points).
Ball region_of_interest(const Scene& scene);

/// The amount of the region of interest that each view sees: the number of cubes, 32 along the
/// diameter of the ball, in which it saw points. Counting points would favor walls seen from
/// nearby, which have most points. Uses at most 100,000 evenly chosen points. Cost: O(points +
/// rays).
std::vector<std::size_t> seen_places(const Scene& scene);

} // namespace vcarve
