#include "observed/onlookers.h"

#include "model/camera.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace vcarve::observed {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera camera_of(const render::Pinhole& view)
{
    return {.id = 1,
            .model = 1, // PINHOLE
            .width_px = static_cast<std::uint64_t>(view.width_px),
            .height_px = static_cast<std::uint64_t>(view.height_px),
            .params = {view.focal_px.x(), view.focal_px.y(), view.principal_px.x(),
                       view.principal_px.y()}};
}

} // namespace

using Eigen::Vector3d;

Spots::Spots(const render::Parts& parts, Spread spread) : parts_(parts)
{
    double sum = 0.0;
    for (std::size_t face = 0; face < parts.mesh.faces.size(); ++face) {
        const double contrast = spread == Spread::area ? 1.0 : paint_of(face).contrast;
        sum += normal_of(face).norm() * contrast;
        sums_.push_back(sum);
    }
}

Spot Spots::draw(bench::Random& random) const
{
    const double sum = random.uniform(0.0, sums_.back());
    const auto found = std::ranges::upper_bound(sums_, sum);
    const auto face = static_cast<std::size_t>(found - sums_.begin());
    double to_second = random.uniform();
    double to_third = random.uniform();
    if (to_second + to_third > 1.0) {
        to_second = 1.0 - to_second;
        to_third = 1.0 - to_third;
    }
    const auto& [a, b, c] = corners_of(face);
    return {a + to_second * (b - a) + to_third * (c - a), normal_of(face).normalized(),
            paint_of(face)};
}

std::array<Vector3d, 3> Spots::corners_of(std::size_t face) const
{
    const auto& [a, b, c] = parts_.mesh.faces[face];
    const auto& positions = parts_.mesh.positions;
    return {positions[a], positions[b], positions[c]};
}

Vector3d Spots::normal_of(std::size_t face) const
{
    const auto [a, b, c] = corners_of(face);
    return (b - a).cross(c - a);
}

const render::Paint& Spots::paint_of(std::size_t face) const
{
    return parts_.paint_of_part[parts_.part_of_face[face]];
}

Onlookers::Onlookers(const ObservedScene& observed)
    : camera_(camera_of(observed.views.front())), tree_(observed.parts.mesh)
{
    for (const render::Pinhole& pinhole : observed.views) {
        View view;
        view.id = static_cast<std::uint32_t>(views_.size() + 1);
        view.name = fmt::format("{}_{:02}.png", observed.name, view.id);
        view.cam_from_world = Eigen::Quaterniond(pinhole.cam_from_world).normalized();
        view.center = pinhole.center;
        views_.push_back(view);
    }
}

std::vector<std::uint32_t> Onlookers::seeing(const Spot& spot) const
{
    constexpr double kLeastCosine = 0.26; // 75 degrees
    constexpr double kTouch = 1e-4;       // share of the ray; nearer hits are the spot's face
    std::vector<std::uint32_t> seeing;
    for (std::uint32_t i = 0; i < views_.size(); ++i) {
        const Vector3d way = views_[i].center - spot.position;
        if (spot.normal.dot(way) < kLeastCosine * way.norm()) continue;
        if (!view_shows(views_[i], camera_, spot.position)) continue;
        if (!tree_.is_met(spot.position + kTouch * way, views_[i].center)) seeing.push_back(i);
    }
    return seeing;
}

Vector3d Onlookers::in_camera(std::uint32_t view, const Vector3d& position) const
{
    return views_[view].cam_from_world * (position - views_[view].center);
}

std::optional<Vector2d> Onlookers::place_px(std::uint32_t view, const Vector3d& position) const
{
    return project(camera_, in_camera(view, position));
}

} // namespace vcarve::observed
