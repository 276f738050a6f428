#include "io/dense/nearest_grid.h"

#include "model/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kNothing = std::numeric_limits<float>::infinity();
/// How steep a surface may stand before a view: by how much more the distance of its points differs
/// than they lie apart across the sights.
constexpr double kSteepest = 2.0;
/// The same of sparse points, whose squares are wider and hold more of what is not one surface.
constexpr double kSparseSteepest = 1.0;
/// What depths are off by, as a share of the distance, where squares are small.
constexpr double kLeastNearer = 0.01;
/// Squares of the grid are so many times as wide as points stand apart in the image on average.
constexpr double kSquareWidth = 2.0;
/// The same of sparse points, in the part of the image that has any: they gather where there is
/// texture, and leave gaps elsewhere.
constexpr double kSparseSquareWidth = 4.0;

} // namespace

std::optional<Projected> project_into(const View& view, const Camera& camera, const Vector3d& place)
{
    const Vector3d in_camera = view.cam_from_world * (place - view.center);
    if (!in_camera.allFinite() || !image_shows(camera, in_camera)) return std::nullopt;
    const auto place_px = project(camera, in_camera);
    if (!place_px) return std::nullopt;
    return Projected{*place_px, static_cast<float>(in_camera.norm())};
}

NearestGrid::NearestGrid(const View& view, const Scene& scene, const std::vector<Vector3d>& places,
                         std::size_t stride)
    : view_(view), camera_(scene.cameras[view.camera])
{
    std::vector<Vector2d> sample;
    for (std::size_t i = 0; i < places.size(); i += stride) {
        if (const auto projected = project_into(view, camera_, places[i]))
            sample.push_back(projected->place_px);
    }
    const auto shown = static_cast<double>(1 + sample.size());
    const double count = 1.0 + static_cast<double>(sample.size() * stride);
    if (scene.is_dense) {
        lay_squares(kSquareWidth, 1.0, count);
        set_depth(kSteepest);
        return;
    }
    lay_squares(kSquareWidth, 1.0, shown);
    constexpr float kTaken = 0.0F;
    for (const Vector2d& place_px : sample) {
        least_[squares_.of(place_px)] = kTaken;
    }
    const auto taken = static_cast<double>(std::ranges::count(least_, kTaken));
    lay_squares(kSparseSquareWidth, taken / static_cast<double>(least_.size()), count);
    set_depth(kSparseSteepest);
}

void NearestGrid::add(const Vector3d& position)
{
    const auto projected = project_into(view_, camera_, position);
    if (!projected) return;
    float& nearest = least_[squares_.of(projected->place_px)];
    nearest = std::min(nearest, projected->distance);
}

bool NearestGrid::sees(const Vector3d& position) const
{
    const auto projected = project_into(view_, camera_, position);
    if (!projected) return false;
    return least_[squares_.of(projected->place_px)] >= projected->distance * hides_from_;
}

/// Empty ones, see ImageSquares.
void NearestGrid::lay_squares(double width, double share, double count)
{
    squares_ = {camera_, width, share, count};
    least_.assign(squares_.count(), kNothing);
}

/// By how much nearer a point must be to hide another in its square.
void NearestGrid::set_depth(double steepest)
{
    square_angle_ = squares_.side_px() * radians_a_pixel();
    hides_from_ = static_cast<float>(1.0 - std::max(kLeastNearer, steepest * square_angle_));
}

/// In the middle of the image; zero where its camera shows no direction there.
double NearestGrid::radians_a_pixel() const
{
    const Vector2d middle(0.5 * static_cast<double>(camera_.width_px),
                          0.5 * static_cast<double>(camera_.height_px));
    const auto ahead = ray(camera_, middle);
    const auto beside = ray(camera_, middle + Vector2d::UnitX());
    return ahead && beside ? (*ahead - *beside).norm() : 0.0;
}

} // namespace vcarve
