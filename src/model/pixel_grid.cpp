#include "model/pixel_grid.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

std::vector<Eigen::Vector2d> pixel_grid(const Camera& camera, std::size_t most)
{
    std::vector<Eigen::Vector2d> pixels;
    if (camera.width_px == 0 || camera.height_px == 0) return pixels;
    const auto width_px = static_cast<double>(camera.width_px);
    const auto height_px = static_cast<double>(camera.height_px);
    const auto count = static_cast<double>(most);
    const double columns =
        std::clamp(std::round(std::sqrt(count * width_px / height_px)), 1.0, count);
    const double rows = std::floor(count / columns);
    for (double row = 0.5; row < rows; ++row) {
        for (double column = 0.5; column < columns; ++column) {
            pixels.emplace_back(column / columns * width_px, row / rows * height_px);
        }
    }
    return pixels;
}

} // namespace vcarve
