#pragma once

#include "model/scene.h"

#include <Eigen/Geometry>

#include <vector>

namespace vcarve {

/// The box that leaves out a share `tail` of the positions, below one half, at either end of each
/// axis. Empty where there are none. Cost: O(positions).
Eigen::AlignedBox3d middle_box(const std::vector<Eigen::Vector3d>& positions, double tail);

/// The box of what was looked at, whatever lies far behind: each point counts once for every view
/// that saw it, and a fiftieth of these sights is left out at either end of each axis. Empty where
/// there are no sights. Cost: O(points log points).
Eigen::AlignedBox3d looked_at_box(const Scene& scene);

} // namespace vcarve
