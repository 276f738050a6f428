#include "steps/2_planes/shown_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// Unit vectors from a place to some points; zero to one at the place itself.
std::vector<Vector3d> ways_to(const std::vector<std::uint32_t>& points, const Scene& scene,
                              const Vector3d& from)
{
    std::vector<Vector3d> ways(points.size());
    std::ranges::transform(points, ways.begin(), [&](std::uint32_t point) -> Vector3d {
        return (scene.positions[point] - from).normalized();
    });
    return ways;
}

} // namespace

ShownPoints::ShownPoints(const Scene& scene, std::uint32_t view, std::vector<std::uint32_t> points)
    : scene_(scene),
      center_(scene.views[view].center),
      points_(std::move(points)),
      ways_(ways_to(points_, scene, center_)),
      tree_(ways_)
{
}

bool ShownPoints::looks_at(const Vector3d& place, const FlatParts& parts, std::uint32_t part) const
{
    constexpr std::array<std::size_t, 2> kLook = {8, 40}; // most find what they need among a few
    const Vector3d& normal = parts.patches[part].region->plane.normal;
    const double far = (place - center_).norm();
    const Vector3d way = (place - center_) / far;
    // In the image: towards the horizon of the plane.
    const Vector3d onward = (normal - way.dot(normal) * way).normalized();
    const auto is_onward = [&](std::size_t other) {
        const Vector3d beside = ways_[other] - way;
        const double along = onward.dot(beside);
        return along > 0.0 && (beside - along * onward).norm() <= along;
    };
    const auto is_own = [&](std::uint32_t point) { return parts.region_of[point] == part; };
    const auto hides = [&](std::uint32_t point) {
        return (scene_.positions[point] - center_).norm() < far;
    };
    thread_local std::vector<PointTree::Near> shown;
    for (const std::size_t count : kLook) {
        tree_.find_nearest(way, count, shown);
        if (!is_own(points_[shown.front().point])) return false;
        const auto next = std::ranges::find_if(shown, is_onward, &PointTree::Near::point);
        if (next == shown.end()) continue;
        const std::uint32_t point = points_[next->point];
        return is_own(point) || !hides(point);
    }
    return true;
}

} // namespace vcarve
