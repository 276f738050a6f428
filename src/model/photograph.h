#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// How many pixels an image has.
struct PhotographSize {
    int width_px = 0;
    int height_px = 0;
};

/// A photograph, or another image: rows from the top, three bytes a pixel, red first.
struct Photograph {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgb;
    std::vector<std::uint8_t> alpha = {}; ///< per pixel, 0 where nothing is shown; empty: no 0
};

/// The colour at a place of an image, each channel from 0 to 255, bilinear between the middles of
/// four pixels: (0.5, 0.5) is that of the first. Beyond the edges the image goes on with the
/// colours there.
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

/// The images that cover a surface, and which part of them covers which face.
struct Texture {
    std::vector<Photograph> pages;
    std::vector<std::uint32_t> page_of_face; ///< parallel to the faces of the mesh
    /// Of each face where its corners lie in its page: (0, 0) is the page's upper left corner,
    /// (1, 1) its lower right one.
    std::vector<std::array<Eigen::Vector2f, 3>> places;

    bool is_empty() const { return pages.empty(); }
};

} // namespace vcarve
