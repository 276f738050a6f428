#include "dense/stereo.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "render/photograph.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace vcarve::dense {

namespace {

using Eigen::Vector3d;
using render::Hit;
using render::Pinhole;

/// A normally distributed number that depends only on its arguments (Box and Muller).
double normal_number(std::uint64_t seed, std::uint64_t index)
{
    const double u = 1.0 - random_number(seed, 2 * index);
    const double v = random_number(seed, 2 * index + 1);
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

/// Normally distributed numbers, smoothed over windows of 5 x 5.
std::vector<double> smooth_numbers(int width, int height, std::uint64_t seed)
{
    constexpr std::uint64_t kSide = 5;
    std::vector<double> result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const std::uint64_t padded = static_cast<std::uint64_t>(width) + kSide - 1;
    parallel_for(result.size(), [&](std::size_t i) {
        const std::uint64_t x = i % static_cast<std::size_t>(width);
        const std::uint64_t y = i / static_cast<std::size_t>(width);
        double sum = 0.0;
        for (std::uint64_t dy = 0; dy < kSide; ++dy) {
            for (std::uint64_t dx = 0; dx < kSide; ++dx) {
                sum += normal_number(seed, (y + dy) * padded + x + dx);
            }
        }
        result[i] =
            sum / static_cast<double>(kSide); // a sum of 25: restores a standard deviation of 1
    });
    return result;
}

/// The distance to the sixth nearest view, because a matcher uses several views.
double baseline(const std::vector<Pinhole>& views, std::size_t view)
{
    std::vector<double> distances;
    for (std::size_t other = 0; other < views.size(); ++other) {
        if (other != view) distances.push_back((views[other].center - views[view].center).norm());
    }
    std::ranges::sort(distances);
    return distances.at(std::min<std::size_t>(5, distances.size() - 1));
}

/// Whether the depth jumps within two pixels.
bool is_at_jump(const std::vector<Hit>& hits, const Pinhole& view, int x, int y)
{
    constexpr double kJump = 0.03;
    const auto hit_at = [&](int u, int v) -> const Hit& {
        return hits[static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width_px) +
                    static_cast<std::size_t>(u)];
    };
    const double depth = hit_at(x, y).depth;
    for (int v = std::max(0, y - 2); v <= std::min(view.height_px - 1, y + 2); ++v) {
        for (int u = std::max(0, x - 2); u <= std::min(view.width_px - 1, x + 2); ++u) {
            const Hit& hit = hit_at(u, v);
            if (hit.face == Hit::kNoFace || std::abs(hit.depth - depth) > kJump * depth)
                return true;
        }
    }
    return false;
}

/// A normal rotated by two normally distributed angles.
Vector3d shaken(const Vector3d& normal, double sigma_deg, std::uint64_t seed, std::uint64_t index)
{
    const double sigma = sigma_deg * std::numbers::pi / 180.0;
    const Vector3d u = normal.unitOrthogonal();
    return (normal + sigma * normal_number(seed, 2 * index) * u +
            sigma * normal_number(seed, 2 * index + 1) * normal.cross(u))
        .normalized();
}

using Eigen::Vector2d;
using Eigen::Vector3d;
using render::Pinhole;

/// A pixel of a view and the position at its depth.
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

/// The depth of a position in the camera's frame, and its pixel.
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
    /// The nearest views with a similar direction.
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

    /// The pixel of a view that shows a position, if its depth agrees.
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

    /// Adds the point of some pixels, and marks them as used.
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

DepthMap stereo_depths(const render::PhotoScene& scene, std::size_t view, const StereoNoise& noise,
                       std::uint64_t seed)
{
    const Pinhole& lens = scene.views[view];
    const std::vector<Hit> hits = render::rasterize(scene.parts.mesh, lens);
    const Picture picture = render::photograph(scene.parts, lens);
    const std::uint64_t own = (seed << 20U) + 8 * view;
    const std::vector<double> smooth = smooth_numbers(lens.width_px, lens.height_px, own);
    const double scale = 1.0 / (lens.focal_px.x() * baseline(scene.views, view));
    const double least_cosine = std::cos(noise.most_slant_deg * std::numbers::pi / 180.0);

    DepthMap map{std::vector<double>(hits.size(), 0.0), std::vector<Vector3d>(hits.size()), {}};
    for (const Eigen::Array3f& pixel : picture.pixels) {
        map.colors.push_back({static_cast<std::uint8_t>(pixel[0]),
                              static_cast<std::uint8_t>(pixel[1]),
                              static_cast<std::uint8_t>(pixel[2])});
    }
    parallel_for(hits.size(), [&](std::size_t i) {
        const int x = static_cast<int>(i) % lens.width_px;
        const int y = static_cast<int>(i) / lens.width_px;
        const Hit& hit = hits[i];
        if (hit.face == Hit::kNoFace || !hit.front || is_at_jump(hits, lens, x, y)) return;
        const Vector3d normal = render::face_normal(scene.parts.mesh, hit.face);
        const Vector3d ray = lens.ray({x + 0.5, y + 0.5}).normalized();
        if (-normal.dot(ray) < least_cosine) return;
        const double error_px =
            noise.smooth_px * smooth[i] + noise.rough_px * normal_number(own + 1, i);
        map.depths[i] = hit.depth * (1.0 + error_px * hit.depth * scale);
        if (random_number(own + 2, i) < noise.outliers)
            map.depths[i] = hit.depth * (0.6 + 0.8 * random_number(own + 3, i));
        map.normals[i] = shaken(normal, noise.normal_deg, own + 4, i);
    });
    return map;
}

FusedCloud fuse(const std::vector<Pinhole>& views, std::vector<DepthMap> maps,
                const FuseOptions& options)
{
    return Fusion(views, std::move(maps), options).cloud();
}

} // namespace vcarve::dense
