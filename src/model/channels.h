#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>

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

} // namespace vcarve
