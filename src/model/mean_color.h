#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace vcarve {

/// The mean colour of some points of a scene, one at least, of which each counts weight(point)
/// times; rounded. Cost: O(points).
template <typename Weight>
Color mean_color(const Scene& scene, std::span<const std::uint32_t> points, const Weight& weight)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (const std::uint32_t point : points) {
        const Color& color = scene.colors[point];
        sum += weight(point) * Eigen::Vector3d(color[0], color[1], color[2]);
        weights += weight(point);
    }
    const Eigen::Vector3d mean = (sum / weights).array().round();
    return {static_cast<std::uint8_t>(mean[0]), static_cast<std::uint8_t>(mean[1]),
            static_cast<std::uint8_t>(mean[2])};
}

} // namespace vcarve
