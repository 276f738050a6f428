#pragma once

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// How far apart points lie around each point: the distance to its 6th nearest other point, or to
/// the farthest where there are fewer. Points that coincide would have none, so no spacing is less
/// than a hundredth of the median one. Precondition: at least two points, all finite. Cost: O(n log
/// n), parallel.
std::vector<double> point_spacings(const std::vector<Eigen::Vector3d>& points);

} // namespace vcarve
