#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace vcarve {

/// The box without the share `tail`, below one half, of the positions at either end of each axis;
/// empty if there are none. Cost: O(positions).
Eigen::AlignedBox3d middle_box(const std::vector<Eigen::Vector3d>& positions, double tail = 0.05);

} // namespace vcarve
