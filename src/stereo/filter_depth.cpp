#include "stereo/filter_depth.h"

#include "base/union_find.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// Joins neighboring pixels if are_joined(a, b).
template <typename AreJoined>
UnionFind regions_of(const DepthMap& map, const AreJoined& are_joined)
{
    UnionFind regions(map.planes.size());
    for (int y = 0; y < map.height_px; ++y) {
        for (int x = 0; x < map.width_px; ++x) {
            const auto pixel = static_cast<std::uint32_t>(map.index(x, y));
            const auto join = [&](int to_x, int to_y) {
                if (!map.has(to_x, to_y)) return;
                const auto other = static_cast<std::uint32_t>(map.index(to_x, to_y));
                if (are_joined(pixel, other)) regions.join(pixel, other);
            };
            join(x + 1, y);
            join(x, y + 1);
        }
    }
    return regions;
}

/// A pixel's ray at z = 1, and the inverse of its depth.
struct InverseDepth {
    Eigen::Vector3d ray;
    double inverse = 0.0;

    /// Whether a plane, 1 / z = plane . ray, passes within 0.5 % of the depth.
    bool lies_in(const Eigen::Vector3d& plane) const
    {
        constexpr double kTolerance = 0.005;
        return std::abs(plane.dot(ray) - inverse) < kTolerance * inverse;
    }
};

using InverseDepths = std::vector<InverseDepth>;

/// The least-squares plane through the pixels.
Eigen::Vector3d fitted_plane(const InverseDepths& pixels)
{
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const InverseDepth& pixel : pixels) {
        products += pixel.ray * pixel.ray.transpose();
        right += pixel.inverse * pixel.ray;
    }
    return products.ldlt().solve(right);
}

InverseDepths pixels_in(const Eigen::Vector3d& plane, const InverseDepths& pixels)
{
    InverseDepths found;
    std::ranges::copy_if(pixels, std::back_inserter(found),
                         [&](const InverseDepth& pixel) { return pixel.lies_in(plane); });
    return found;
}

/// Finds the plane with the most pixels by random sampling (RANSAC), and returns these pixels.
InverseDepths largest_plane(const InverseDepths& pixels)
{
    constexpr int kSamples = 200;
    std::minstd_rand random(1);
    InverseDepths best;
    for (int i = 0; i < kSamples; ++i) {
        const auto any = [&] { return pixels[random() % pixels.size()]; };
        const InverseDepths found = pixels_in(fitted_plane({any(), any(), any()}), pixels);
        if (found.size() > best.size()) best = found;
    }
    return best;
}

/// The region of the image between some pixels: within sqrt(3) standard deviations of their mean.
class Between {
  public:
    explicit Between(const InverseDepths& pixels)
    {
        for (const InverseDepth& pixel : pixels) {
            mean_ += pixel.ray.head<2>() / static_cast<double>(pixels.size());
        }
        Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
        for (const InverseDepth& pixel : pixels) {
            const Eigen::Vector2d from_mean = pixel.ray.head<2>() - mean_;
            spread += from_mean * from_mean.transpose() / static_cast<double>(pixels.size());
        }
        inverse_ = spread.inverse();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
        is_wide_ = axes.eigenvalues()[0] > 0.01 * axes.eigenvalues()[1];
    }

    /// Pixels of a narrow band, such as the edge of a roof, do not determine a plane.
    bool is_wide() const { return is_wide_; }
    bool contains(const Eigen::Vector3d& ray) const
    {
        const Eigen::Vector2d from_mean = ray.head<2>() - mean_;
        return from_mean.dot(inverse_ * from_mean) < 3.0;
    }

  private:
    Eigen::Vector2d mean_ = Eigen::Vector2d::Zero();
    Eigen::Matrix2d inverse_;
    bool is_wide_ = false;
};

class PlainRegions {
  public:
    PlainRegions(DepthMap& map, const Pinhole& camera, const std::vector<PixelPlane>& surface)
        : map_(map),
          surface_(surface),
          camera_(camera),
          regions_(regions_of(map,
                              [&](std::size_t a, std::size_t b) {
                                  return map.costs[a] == DepthMap::kPlain &&
                                         map.costs[b] == DepthMap::kPlain;
                              })),
          pixels_(map.planes.size()),
          around_(map.planes.size())
    {
        for (int y = 0; y < map.height_px; ++y) {
            for (int x = 0; x < map.width_px; ++x) {
                const auto pixel = static_cast<std::uint32_t>(map.index(x, y));
                if (map.costs[pixel] != DepthMap::kPlain) continue;
                const std::uint32_t region = regions_.root(pixel);
                pixels_[region].push_back({ray(x, y), pixel});
                for (const auto& [right, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    look(x, y, right, down, around_[region]);
                }
            }
        }
    }

    void fill()
    {
        constexpr std::size_t kFewest = 20;
        for (std::size_t region = 0; region < pixels_.size(); ++region) {
            const InverseDepths& around = around_[region];
            if (around.size() < kFewest) continue;
            const InverseDepths agreeing = largest_plane(around);
            if (agreeing.size() < kFewest || 5 * agreeing.size() < 2 * around.size()) continue;
            const Between between(agreeing);
            if (between.is_wide()) fill(region, fitted_plane(agreeing), between);
        }
    }

  private:
    struct Pixel {
        Eigen::Vector3d ray;
        std::uint32_t index;
    };

    Eigen::Vector3d ray(int x, int y) const { return depth_ray(camera_, x, y).cast<double>(); }

    /// Adds the first measured pixel beyond the border of a region, if it is near.
    void look(int x, int y, int right, int down, InverseDepths& around) const
    {
        constexpr int kNear = 4;
        for (int step = 1; step <= kNear; ++step) {
            const int to_x = x + step * right;
            const int to_y = y + step * down;
            if (!map_.has(to_x, to_y)) return;
            const std::size_t other = map_.index(to_x, to_y);
            if (map_.costs[other] == DepthMap::kPlain) return;
            if (!map_.is_measured(other)) continue;
            around.push_back({ray(to_x, to_y), 1.0 / map_.planes[other].depth});
            return;
        }
    }

    void fill(std::size_t region, const Eigen::Vector3d& plane, const Between& between)
    {
        constexpr double kLeastFacing = 0.1;
        constexpr double kSameDepth = 0.02;
        const Eigen::Vector3d normal = -plane.normalized();
        for (const Pixel& pixel : pixels_[region]) {
            const double inverse = plane.dot(pixel.ray);
            const bool faces = -normal.dot(pixel.ray) > kLeastFacing * pixel.ray.norm();
            const double depth_there = surface_[pixel.index].depth;
            const bool is_surface = std::abs(inverse * depth_there - 1.0) < kSameDepth;
            if (!is_surface || !faces || !between.contains(pixel.ray)) continue;
            map_.planes[pixel.index] = {static_cast<float>(1.0 / inverse), normal.cast<float>()};
            map_.costs[pixel.index] = DepthMap::kFilled;
        }
    }

    DepthMap& map_;
    const std::vector<PixelPlane>& surface_;
    const Pinhole& camera_;
    UnionFind regions_;
    std::vector<std::vector<Pixel>> pixels_; ///< pixels of each region
    std::vector<InverseDepths> around_;      ///< measured pixels around each region
};

} // namespace

void drop_speckles(DepthMap& map, const Pinhole& camera, int min_pixels)
{
    constexpr float kSameDepthPx = 6.0F;
    const float same = kSameDepthPx / camera.focal_px;
    UnionFind regions = regions_of(map, [&](std::size_t a, std::size_t b) {
        const float depth = map.planes[a].depth;
        return map.is_measured(a) && map.is_measured(b) &&
               std::abs(depth - map.planes[b].depth) < same * depth;
    });
    std::vector<int> sizes(map.planes.size());
    for (std::uint32_t pixel = 0; pixel < sizes.size(); ++pixel) {
        ++sizes[regions.root(pixel)];
    }
    for (std::uint32_t pixel = 0; pixel < sizes.size(); ++pixel) {
        if (!map.is_measured(pixel)) continue;
        if (sizes[regions.root(pixel)] < min_pixels) map.costs[pixel] = DepthMap::kNoCost;
    }
}

void fill_plain_regions(DepthMap& map, const Pinhole& camera,
                        const std::vector<PixelPlane>& surface)
{
    PlainRegions(map, camera, surface).fill();
}

} // namespace vcarve
