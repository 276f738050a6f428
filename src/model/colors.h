#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace vcarve {

/// Red, green and blue, from 0 to 255, to be computed with.
inline Eigen::Array3f channels_of(const Color& color)
{
    return {static_cast<float>(color[0]), static_cast<float>(color[1]),
            static_cast<float>(color[2])};
}

/// What was computed as bytes: rounded, and cut off where it is less than 0 or more than 255.
template <typename Channels>
Color rounded_color(const Channels& channels)
{
    Color color;
    for (int i = 0; i < 3; ++i) {
        const double level = std::clamp<double>(channels[i], 0.0, 255.0);
        color[i] = static_cast<std::uint8_t>(std::lround(level));
    }
    return color;
}

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

/// Whether anything is known of the points' colours: not where all are black, as readers and
/// exporters leave them that have none.
inline bool has_colors(const Scene& scene)
{
    return std::ranges::any_of(scene.colors, [](const Color& color) { return color != Color{}; });
}

} // namespace vcarve
