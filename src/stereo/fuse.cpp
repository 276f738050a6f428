#include "stereo/fuse.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kLeastViews = 3;
constexpr double kDepthPx = 6.0;            ///< difference of depths, in pixel sizes there
constexpr double kPlanePx = 2.4;            ///< distance from the other's plane, in pixel sizes
constexpr double kLeastNormalCosine = 0.85; ///< between normals
constexpr double kMostReprojection = 3;     ///< pixels

/// A pixel of a depth map in world coordinates.
struct FusedPixel {
    std::uint32_t map = 0;
    std::size_t pixel = 0;
    Vector3d position;
    Vector3d normal;
};

class Fusion {
  public:
    Fusion(const DepthMaps& depths, Scene& fused) : depths_(depths), fused_(fused)
    {
        used_.reserve(depths.maps.size());
        for (const DepthMap& map : depths.maps) {
            used_.emplace_back(map.planes.size());
        }
    }

    void fuse_map(std::uint32_t map)
    {
        const DepthMap& own = depths_.maps[map];
        for (int y = 0; y < own.height_px; ++y) {
            for (int x = 0; x < own.width_px; ++x) {
                const std::size_t pixel = own.index(x, y);
                if (used_[map][pixel] || !own.is_measured(pixel)) continue;
                fuse_pixel(sample(map, x, y));
            }
        }
    }

  private:
    FusedPixel sample(std::uint32_t map, int x, int y) const
    {
        const StereoView& view = depths_.views[map];
        const std::size_t pixel = depths_.maps[map].index(x, y);
        const PixelPlane& plane = depths_.maps[map].planes[pixel];
        const Eigen::Matrix3d world_from_cam = view.cam_from_world.transpose();
        const Vector3d ray = depth_ray(view.camera, x, y).cast<double>();
        return {map, pixel, view.center + plane.depth * (world_from_cam * ray),
                world_from_cam * plane.normal.cast<double>()};
    }

    /// Returns the pixel of another map that agrees with a sample, if any.
    std::optional<FusedPixel> agreeing(const FusedPixel& own, std::uint32_t map) const
    {
        const StereoView& view = depths_.views[map];
        const DepthMap& depths = depths_.maps[map];
        const Vector3d in_cam = view.cam_from_world * (own.position - view.center);
        if (!(in_cam.z() > 0.0)) return std::nullopt;
        const Eigen::Vector2d pixel = pixel_of(view, own.position);
        if (!(pixel.array().abs() < 1e6).all()) return std::nullopt;
        const auto x = static_cast<int>(std::lround(pixel.x() / kDepthStep));
        const auto y = static_cast<int>(std::lround(pixel.y() / kDepthStep));
        if (!depths.has(x, y) || !depths.is_measured(depths.index(x, y))) return std::nullopt;
        FusedPixel other = sample(map, x, y);
        const double depth = in_cam.z();
        const double pixel_size = depth / view.camera.focal_px;
        const double found = depths.planes[other.pixel].depth;
        const bool agrees =
            std::abs(depth - found) <= kDepthPx * pixel_size &&
            own.normal.dot(other.normal) >= kLeastNormalCosine &&
            std::abs(other.normal.dot(other.position - own.position)) <= kPlanePx * pixel_size;
        if (!agrees) return std::nullopt;
        const StereoView& self = depths_.views[own.map];
        const Eigen::Vector2d back = pixel_of(self, other.position) - pixel_of(self, own.position);
        if (!(back.norm() <= kMostReprojection)) return std::nullopt;
        return other;
    }

    static Eigen::Vector2d pixel_of(const StereoView& view, const Vector3d& position)
    {
        const Vector3d in_cam = view.cam_from_world * (position - view.center);
        return view.camera.focal_px / in_cam.z() * in_cam.head<2>() +
               view.camera.principal_px.cast<double>();
    }

    void fuse_pixel(const FusedPixel& own)
    {
        agreeing_.assign(1, own);
        for (const std::uint32_t neighbor : depths_.neighbors[own.map]) {
            const auto other = agreeing(own, neighbor);
            if (other) agreeing_.push_back(*other);
        }
        if (agreeing_.size() < kLeastViews) return;
        Vector3d position = Vector3d::Zero();
        Vector3d normal = Vector3d::Zero();
        track_.clear();
        for (const FusedPixel& each : agreeing_) {
            position += each.position;
            normal += each.normal;
            track_.push_back(depths_.views[each.map].view);
            used_[each.map][each.pixel] = true;
        }
        std::ranges::sort(track_);
        fused_.positions.push_back(position / static_cast<double>(agreeing_.size()));
        fused_.normals.push_back(normal.normalized().cast<float>());
        fused_.colors.push_back(depths_.views[own.map].colors[own.pixel]);
        fused_.tracks.push_back(track_);
    }

    const DepthMaps& depths_;
    Scene& fused_;
    std::vector<std::vector<bool>> used_; ///< fused pixels of each map
    std::vector<FusedPixel> agreeing_;
    std::vector<std::uint32_t> track_;
};

} // namespace

Scene fuse(const Scene& sparse, const DepthMaps& depths, const Progress& progress)
{
    Scene fused;
    fused.cameras = sparse.cameras;
    fused.views = sparse.views;
    fused.offset = sparse.offset;
    fused.is_dense = true;
    Fusion fusion(depths, fused);
    for (std::uint32_t map = 0; map < depths.maps.size(); ++map) {
        fusion.fuse_map(map);
        progress.report(map + 1.0, static_cast<double>(depths.maps.size()));
    }
    fused.errors_px.assign(fused.num_points(), -1.0);
    for (std::uint64_t i = 0; i < fused.num_points(); ++i) {
        fused.point_ids.push_back(i);
    }
    return fused;
}

} // namespace vcarve
