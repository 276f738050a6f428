#include "picture/eye.h"

#include "base/parallel.h"
#include "io/colmap/text_reader.h"
#include "model/camera.h"
#include "model/extent.h"
#include "model/views.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kOutsideWidthPx = 1280.0;
constexpr double kOutsideHeightPx = 960.0;
constexpr double kHalfAngleRad = 22.5 * std::numbers::pi / 180.0;
constexpr double kOrbitHeightRad = 35.0 * std::numbers::pi / 180.0;
/// Shows a margin around the ball, for example the tops of walls.
constexpr double kRoom = 1.2;

bool has_lens(const Camera& camera)
{
    if (camera.width_px == 0 || camera.height_px == 0) return false;
    const Eigen::Vector2d middle(static_cast<double>(camera.width_px) / 2.0,
                                 static_cast<double>(camera.height_px) / 2.0);
    return ray(camera, middle).has_value();
}

Eye eye_of(const Scene& scene, const View& view)
{
    return {.name = view.name,
            .camera = scene.cameras[view.camera],
            .cam_from_world = view.cam_from_world,
            .center = view.center + scene.offset};
}

/// The horizontal direction from a position to most cameras, or any if they are evenly distributed.
Vector3d side_of(const Scene& scene, const Vector3d& from, const Vector3d& up)
{
    const auto level = [&](const Vector3d& way) -> Vector3d {
        return (way - way.dot(up) * up).normalized();
    };
    const auto side =
        mean_direction(scene, [&](const View& view) { return level(view.center - from); });
    if (side && level(*side).norm() > 0.5) return level(*side);
    if (!scene.views.empty()) {
        Vector3d first = level(scene.views.front().center - from);
        if (first.norm() > 0.5) return first;
    }
    return up.unitOrthogonal();
}

/// Looks at a ball with a margin, from the direction `from`.
Eye outside_of(const Ball& ball, const Vector3d& from, const Vector3d& upward)
{
    Eye eye;
    eye.camera.width_px = static_cast<std::uint64_t>(kOutsideWidthPx);
    eye.camera.height_px = static_cast<std::uint64_t>(kOutsideHeightPx);
    const double focal_px = kOutsideHeightPx / 2.0 / std::tan(kHalfAngleRad);
    eye.camera.params = {focal_px, kOutsideWidthPx / 2.0, kOutsideHeightPx / 2.0};
    const double radius = ball.radius > 0.0 ? ball.radius : 1.0;
    eye.center = ball.center + from * (kRoom * radius / std::sin(kHalfAngleRad));

    // Rows are the camera's axes: right, down, forward.
    const Vector3d ahead = -from;
    const Vector3d right = ahead.cross(upward).normalized();
    Eigen::Matrix3d axes;
    axes << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
    eye.cam_from_world = Eigen::Quaterniond(axes);
    eye.through_backs = true;
    return eye;
}

Eye outside(const Scene& scene, const std::string& word)
{
    Ball ball = region_of_interest(scene);
    const Vector3d up = up_of(scene);
    const Vector3d side = side_of(scene, ball.center, up);
    ball.center += scene.offset;
    const Vector3d oblique = std::cos(kOrbitHeightRad) * side + std::sin(kOrbitHeightRad) * up;
    // From above, the side with most cameras is at the bottom.
    Eye eye = word == "top" ? outside_of(ball, up, -side) : outside_of(ball, oblique, up);
    eye.name = word;
    return eye;
}

/// The view with a known lens that sees most of the region of interest, or null.
const View* widest_view(const Scene& scene)
{
    const std::vector<std::size_t> places = seen_places(scene);
    const View* widest = nullptr;
    for (const View& view : scene.views) {
        const auto index = static_cast<std::size_t>(&view - scene.views.data());
        const bool sees_more =
            widest == nullptr ||
            places[index] > places[static_cast<std::size_t>(widest - scene.views.data())];
        if (sees_more && has_lens(scene.cameras[view.camera])) widest = &view;
    }
    return widest;
}

/// The names of the first images, for error messages.
std::string names_of(const Scene& scene)
{
    constexpr std::size_t kShown = 3;
    if (scene.views.empty()) return "none";
    std::string names;
    for (std::size_t i = 0; i < std::min(kShown, scene.views.size()); ++i) {
        names += (i == 0 ? "" : ", ") + printable(scene.views[i].name);
    }
    return names + (scene.views.size() > kShown ? ", ..." : "");
}

} // namespace

const View& named_view(const Scene& scene, const std::string& name)
{
    const auto found = std::ranges::find(scene.views, name, &View::name);
    if (found == scene.views.end()) {
        throw UsageError(fmt::format("--view must be auto, top, orbit or the name of an image, but "
                                     "\"{}\" is none of the {} images ({})",
                                     name, scene.views.size(), names_of(scene)));
    }
    if (!has_lens(scene.cameras[found->camera])) {
        throw UsageError(
            fmt::format("--view {}: the view through camera {} cannot be drawn, because "
                        "its lens model is unknown",
                        name, scene.cameras[found->camera].id));
    }
    return *found;
}

Eye choose_eye(const Scene& scene, const std::string& word)
{
    if (word == "top" || word == "orbit") return outside(scene, word);
    if (word == "auto") {
        const View* widest = widest_view(scene);
        return widest == nullptr ? outside(scene, "orbit") : eye_of(scene, *widest);
    }
    return eye_of(scene, named_view(scene, word));
}

Eigen::Array2i picture_size(const Camera& camera, double most_pixels)
{
    constexpr double kLongest = 4096.0;
    const Eigen::Array2d size(static_cast<double>(camera.width_px),
                              static_cast<double>(camera.height_px));
    const double scale = std::min(std::sqrt(most_pixels / size.prod()), kLongest / size.maxCoeff());
    constexpr double kRounding = 1e-6; // keeps 1280 from becoming 1279
    return (scale * size + kRounding).floor().max(1.0).cast<int>();
}

LensRays::LensRays(const Camera& camera, const Eigen::Array2i& size_px)
    : camera_(camera),
      step_(Eigen::Array2d(static_cast<double>(camera.width_px),
                           static_cast<double>(camera.height_px)) /
            size_px.cast<double>()),
      columns_(size_px.x() + 1),
      corners_(static_cast<std::size_t>(columns_) * (size_px.y() + 1), Eigen::Vector3d::Zero())
{
    parallel_for(corners_.size(), [&](std::size_t i) {
        const std::size_t row = i / columns_;
        const Eigen::Array2d place(static_cast<double>(i % columns_), static_cast<double>(row));
        corners_[i] = exact(place).value_or(Eigen::Vector3d::Zero());
    });
}

std::optional<Eigen::Vector3d> LensRays::exact(const Eigen::Array2d& place) const
{
    return ray(camera_, (step_ * place).matrix());
}

std::optional<Eigen::Vector3d> LensRays::at(int x, int y, const Eigen::Array2d& within) const
{
    const std::size_t first = static_cast<std::size_t>(y) * columns_ + x;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int down : {0, 1}) {
        for (const int right : {0, 1}) {
            const Eigen::Vector3d& corner =
                corners_[first + static_cast<std::size_t>(down) * columns_ + right];
            if (corner.isZero(0.0)) return exact(Eigen::Array2d(x, y) + within);
            const double weight_x = right == 0 ? 1.0 - within.x() : within.x();
            const double weight_y = down == 0 ? 1.0 - within.y() : within.y();
            sum += weight_x * weight_y * corner;
        }
    }
    return sum.normalized();
}

} // namespace vcarve
