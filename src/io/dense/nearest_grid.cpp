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
/// The steepest surface that does not hide its own points: the difference of their distances to the
/// view, divided by their separation across the rays.
constexpr double kSteepest = 2.0;
/// The same for sparse points, whose wider squares mix more surfaces.
constexpr double kSparseSteepest = 1.0;
/// The tolerance for errors of depth, as a fraction of the distance; it applies to small squares.
constexpr double kLeastNearer = 0.01;
/// Width of the squares, in mean point spacings in the image.
constexpr double kSquareWidth = 2.0;
/// The same for sparse points, in spacings of the part of the image that has points: they cluster
/// on texture and leave gaps elsewhere.
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

/// Makes empty squares; see ImageSquares.
void NearestGrid::lay_squares(double width, double share, double count)
{
    squares_ = {camera_, width, share, count};
    least_.assign(squares_.count(), kNothing);
}

/// Sets how much nearer a point must be to hide another one in its square.
void NearestGrid::set_depth(double steepest)
{
    square_angle_ = squares_.side_px() * radians_a_pixel();
    hides_from_ = static_cast<float>(1.0 - std::max(kLeastNearer, steepest * square_angle_));
}

/// At the center of the image; zero if the lens has no ray there.
double NearestGrid::radians_a_pixel() const
{
    const Vector2d middle(0.5 * static_cast<double>(camera_.width_px),
                          0.5 * static_cast<double>(camera_.height_px));
    const auto ahead = ray(camera_, middle);
    const auto beside = ray(camera_, middle + Vector2d::UnitX());
    return ahead && beside ? (*ahead - *beside).norm() : 0.0;
}

} // namespace vcarve
