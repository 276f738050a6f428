#include "dense/fuse.h"

#include "base/statistics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace vcarve::dense {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using render::Pinhole;

/// A pixel of a view and the place its depth stands for.
struct Found {
    std::uint32_t view;
    std::size_t pixel;
    Vector3d place;
};

Vector3d place_of(const Pinhole& view, const DepthMap& map, std::size_t pixel)
{
    const auto width = static_cast<std::size_t>(view.width_px);
    const std::size_t column = pixel % width;
    const std::size_t row = pixel / width;
    const Vector2d middle(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    return view.center + map.depths[pixel] * view.ray(middle);
}

/// Where a place is in the camera's frame and in its image.
struct Projection {
    double depth;
    Vector2d place_px;
};

Projection project(const Pinhole& view, const Vector3d& place)
{
    const Vector3d in_camera = view.cam_from_world * (place - view.center);
    return {in_camera.z(),
            view.principal_px + view.focal_px.cwiseProduct(in_camera.head<2>() / in_camera.z())};
}

class Fusion {
  public:
    Fusion(const std::vector<Pinhole>& views, std::vector<DepthMap> maps,
           const FuseOptions& options)
        : views_(views), maps_(std::move(maps)), options_(options)
    {
    }

    FusedCloud cloud()
    {
        FusedCloud cloud;
        for (std::uint32_t view = 0; view < views_.size(); ++view) {
            const std::vector<std::uint32_t> others = views_beside(view);
            for (std::size_t pixel = 0; pixel < maps_[view].depths.size(); ++pixel) {
                if (maps_[view].depths[pixel] == 0.0) continue;
                const std::vector<Found> found = agreeing(view, pixel, others);
                if (found.size() >= options_.least_views) add(found, cloud);
            }
        }
        return cloud;
    }

  private:
    /// The nearest views that look in a similar direction.
    std::vector<std::uint32_t> views_beside(std::uint32_t view) const
    {
        constexpr double kLeastCosine = 0.5;
        constexpr std::size_t kMost = 12;
        std::vector<std::pair<double, std::uint32_t>> beside;
        for (std::uint32_t other = 0; other < views_.size(); ++other) {
            const double cosine =
                views_[view].cam_from_world.row(2).dot(views_[other].cam_from_world.row(2));
            if (other == view || cosine < kLeastCosine) continue;
            beside.emplace_back((views_[other].center - views_[view].center).norm(), other);
        }
        std::ranges::sort(beside);
        std::vector<std::uint32_t> nearest;
        for (std::size_t i = 0; i < std::min(kMost, beside.size()); ++i) {
            nearest.push_back(beside[i].second);
        }
        return nearest;
    }

    std::vector<Found> agreeing(std::uint32_t view, std::size_t pixel,
                                const std::vector<std::uint32_t>& others) const
    {
        const Vector3d place = place_of(views_[view], maps_[view], pixel);
        const Vector2d at_px = project(views_[view], place).place_px;
        std::vector<Found> found = {{view, pixel, place}};
        for (const std::uint32_t other : others) {
            const std::optional<Found> match = match_in(other, place);
            if (!match) continue;
            const Vector2d back_px = project(views_[view], match->place).place_px;
            if ((back_px - at_px).norm() <= options_.most_place_error_px) found.push_back(*match);
        }
        return found;
    }

    /// The pixel of a view that shows a place, where its depth agrees.
    std::optional<Found> match_in(std::uint32_t view, const Vector3d& place) const
    {
        const Pinhole& lens = views_[view];
        const Projection at = project(lens, place);
        if (!(at.depth > 0.0)) return std::nullopt;
        const double x = std::floor(at.place_px.x());
        const double y = std::floor(at.place_px.y());
        if (!(x >= 0.0 && y >= 0.0 && x < lens.width_px && y < lens.height_px)) return std::nullopt;
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(lens.width_px) +
                           static_cast<std::size_t>(x);
        const double depth = maps_[view].depths[pixel];
        if (depth == 0.0 || std::abs(depth - at.depth) > options_.most_depth_error * at.depth)
            return std::nullopt;
        return Found{view, pixel, place_of(lens, maps_[view], pixel)};
    }

    /// Adds the point that some pixels make, which belong to no other from then on.
    void add(const std::vector<Found>& found, FusedCloud& cloud)
    {
        Vector3d position;
        Vector3d normal = Vector3d::Zero();
        std::vector<std::uint32_t> views;
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<double> values(found.size());
            std::ranges::transform(found, values.begin(),
                                   [&](const Found& one) { return one.place[axis]; });
            position[axis] = median(values);
        }
        for (const Found& one : found) {
            normal += maps_[one.view].normals[one.pixel];
            views.push_back(one.view);
            maps_[one.view].depths[one.pixel] = 0.0;
        }
        std::ranges::sort(views);
        cloud.positions.push_back(position);
        cloud.normals.push_back(normal.normalized());
        cloud.colors.push_back(maps_[found[0].view].colors[found[0].pixel]);
        cloud.views.push_back(std::move(views));
    }

    const std::vector<Pinhole>& views_;
    std::vector<DepthMap> maps_;
    FuseOptions options_;
};

} // namespace

FusedCloud fuse(const std::vector<Pinhole>& views, std::vector<DepthMap> maps,
                const FuseOptions& options)
{
    return Fusion(views, std::move(maps), options).cloud();
}

} // namespace vcarve::dense
