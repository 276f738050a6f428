#pragma once

#include "vcarve/texture.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vcarve {

/// The size of an image, in pixels.
struct PhotographSize {
    int width_px = 0;
    int height_px = 0;
};

/// The color at a position of an image, each channel from 0 to 255. Interpolates bilinearly between
/// pixel centers; (0.5, 0.5) is the center of the first pixel. Colors at the edges extend beyond
/// them.
inline Eigen::Array3f between_pixels(const Photograph& image, const Eigen::Vector2d& place)
{
    const double column = std::clamp(place.x() - 0.5, 0.0, image.width_px - 1.0);
    const double row = std::clamp(place.y() - 0.5, 0.0, image.height_px - 1.0);
    const int x = static_cast<int>(column);
    const int y = static_cast<int>(row);
    const auto right = static_cast<float>(column - x);
    const auto below = static_cast<float>(row - y);
    const std::size_t step = x + 1 < image.width_px ? 3 : 0;
    const auto row_bytes = static_cast<std::size_t>(3) * image.width_px;
    const std::uint8_t* upper = image.rgb.data() + y * row_bytes + static_cast<std::size_t>(3) * x;
    const std::uint8_t* lower = upper + (y + 1 < image.height_px ? row_bytes : 0);
    const auto mixed = [&](const std::uint8_t* at) {
        const Eigen::Array3f left(at[0], at[1], at[2]);
        const Eigen::Array3f next(at[step], at[step + 1], at[step + 2]);
        return Eigen::Array3f(left + right * (next - left));
    };
    const Eigen::Array3f above = mixed(upper);
    return above + below * (mixed(lower) - above);
}

} // namespace vcarve
