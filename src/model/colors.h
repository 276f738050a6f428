#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace vcarve {

/// Red, green and blue as floats, from 0 to 255.
inline Eigen::Array3f channels_of(const Color& color)
{
    return {static_cast<float>(color[0]), static_cast<float>(color[1]),
            static_cast<float>(color[2])};
}

/// Converts channels to bytes: rounds them and clamps them to 0 to 255.
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

/// The mean color of one or more points, weighted by weight(point) and rounded. Cost: O(points).
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

/// Whether the points have colors. False if all are black, because readers and exporters use black
/// for missing colors.
inline bool has_colors(const Scene& scene)
{
    return std::ranges::any_of(scene.colors, [](const Color& color) { return color != Color{}; });
}

} // namespace vcarve
