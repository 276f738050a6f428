#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <optional>

namespace vcarve {

/// The mean of what `direction` says of the views; nothing where these cancel out.
template <typename Direction>
std::optional<Eigen::Vector3d> mean_direction(const Scene& scene, const Direction& direction)
{
    constexpr double kAgreeing = 0.1; // a mean of unit vectors that is shorter says nothing
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const View& view : scene.views) {
        sum += direction(view);
    }
    if (!(sum.norm() > kAgreeing * static_cast<double>(scene.views.size()))) return std::nullopt;
    return sum.normalized();
}

/// The direction that is up, unit. COLMAP does not know it: it is the mean of the upward directions
/// of the cameras; where these cancel out, the mean direction they look back along; z of a laser
/// scan.
Eigen::Vector3d up_of(const Scene& scene);

} // namespace vcarve
