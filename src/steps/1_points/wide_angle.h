#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace vcarve {

/// The result of look_for_angle().
struct AngleSearch {
    bool is_found = false;
    std::size_t num_angles = 0; ///< computed
};

/// Finds out whether two rays meet at `min_angle_rad` or more, as computed by atan2(). Cost:
/// O(rays) if the widest angle differs from a narrow `min_angle_rad` by more than half a percent;
/// O(rays squared) otherwise.
AngleSearch look_for_angle(std::span<const Eigen::Vector3d> rays, double min_angle_rad);

} // namespace vcarve
