#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>

namespace vcarve {

/// Where the views that saw a point are, all taken together: the sum of the unit vectors to them.
inline Eigen::Vector3d towards_views(const Scene& scene, std::size_t point)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t view : scene.tracks[point]) {
        sum += (scene.views[view].center - scene.positions[point]).normalized();
    }
    return sum;
}

} // namespace vcarve
