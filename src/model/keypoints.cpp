#include "model/keypoints.h"

#include "model/camera.h"

#include <cstddef>
#include <limits>
#include <numeric>

namespace vcarve {

namespace {

/// The cell of a pixel; nothing outside the image, or where that has no size.
std::optional<std::size_t> cell_of(const Camera& camera, const Eigen::Vector2d& x_px)
{
    const double u = x_px.x() / static_cast<double>(camera.width_px);
    const double v = x_px.y() / static_cast<double>(camera.height_px);
    if (!(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0)) return std::nullopt;
    const auto column = static_cast<std::size_t>(u * static_cast<double>(kKeypointCells));
    const auto row = static_cast<std::size_t>(v * static_cast<double>(kKeypointCells));
    return row * kKeypointCells + column;
}

} // namespace

void count_keypoint(View& view, const Camera& camera, const Eigen::Vector2d& x_px)
{
    const std::optional<std::size_t> cell = cell_of(camera, x_px);
    if (!cell) return;
    view.keypoints.resize(kKeypointCells * kKeypointCells);
    std::uint16_t& count = view.keypoints[*cell];
    if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
}

std::optional<double> keypoint_density(const View& view, const Camera& camera,
                                       const Eigen::Vector3d& x_in_world)
{
    if (view.keypoints.empty()) return std::nullopt;
    const std::optional<Eigen::Vector2d> pixel =
        project(camera, view.cam_from_world * (x_in_world - view.center));
    const std::optional<std::size_t> cell = pixel ? cell_of(camera, *pixel) : std::nullopt;
    if (!cell) return std::nullopt;
    const double all = std::accumulate(view.keypoints.begin(), view.keypoints.end(), 0.0);
    return view.keypoints[*cell] * static_cast<double>(view.keypoints.size()) / all;
}

} // namespace vcarve
