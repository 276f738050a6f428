#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The size of an image, in pixels.
struct PhotographSize {
    int width_px = 0;
    int height_px = 0;
};

/// A photograph or another image: rows from the top, three bytes per pixel, red first.
struct Photograph {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgb;
    std::vector<std::uint8_t> alpha = {}; ///< per pixel, 0 if transparent; empty if none is
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

/// The images that cover a surface, and the position of each face in them.
struct Texture {
    std::vector<Photograph> pages;
    std::vector<std::uint32_t> page_of_face; ///< parallel to the faces of the mesh
    /// The positions of each face's corners in its page: (0, 0) is the upper left corner of the
    /// page, (1, 1) the lower right corner.
    std::vector<std::array<Eigen::Vector2f, 3>> places;

    bool is_empty() const { return pages.empty(); }
};

} // namespace vcarve
