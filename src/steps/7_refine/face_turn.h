#pragma once

#include "geometry/triangle.h"

#include <Eigen/Core>

#include <array>

namespace vcarve {

/// Whether a face turns by more than 60 degrees where its corners go, or has no area before or
/// after: vertices that move must not turn faces over.
inline bool turns_too_far(const std::array<Eigen::Vector3d, 3>& before,
                          const std::array<Eigen::Vector3d, 3>& after)
{
    constexpr double kLeastCosine = 0.5;
    const Eigen::Vector3d old_normal = scaled_normal(before[0], before[1], before[2]);
    const Eigen::Vector3d new_normal = scaled_normal(after[0], after[1], after[2]);
    const double scale = old_normal.norm() * new_normal.norm();
    return !(old_normal.dot(new_normal) > kLeastCosine * scale);
}

} // namespace vcarve
