#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace vcarve {

/// The box that leaves out a share `tail` of the positions, below one half, at either end of each
/// axis. Empty where there are none. Cost: O(positions).
Eigen::AlignedBox3d middle_box(const std::vector<Eigen::Vector3d>& positions, double tail);

} // namespace vcarve
