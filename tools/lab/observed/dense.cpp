#include "observed/dense.h"

#include "observed/observe.h"
#include "observed/onlookers.h"
#include "observed/spots.h"
#include "random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace vcarve::observed {

namespace {

using bench::Random;
using Eigen::Vector3d;

/// Makes points of depths that views agree on.
class Fusion {
  public:
    explicit Fusion(const ObservedScene& observed)
        : onlookers_(observed), spots_(observed.parts, Spread::area)
    {
        scene_.cameras = {onlookers_.camera()};
        scene_.views = onlookers_.views();
        scene_.is_dense = true;
    }

    void add_point(Random& random)
    {
        const Spot spot = spots_.draw(random);
        const std::vector<std::uint32_t> seeing = onlookers_.seeing(spot);
        if (seeing.empty()) return;
        const std::uint32_t reference = seeing[random.below(seeing.size())];
        const std::vector<std::uint32_t> views = agreeing(spot, reference, seeing, random);
        constexpr std::size_t kLeastViews = 3;
        const double off = depth_error(spot, reference, views.size(), random);
        const Vector3d normal = bent(spot.normal, random);
        if (views.size() < kLeastViews) return;
        const Vector3d& center = scene_.views[reference].center;
        add(center + (1.0 + off) * (spot.position - center), normal, spot.paint, views);
    }

    std::size_t num_points() const { return scene_.num_points(); }
    Scene take() { return std::move(scene_); }

  private:
    std::vector<std::uint32_t> agreeing(const Spot& spot, std::uint32_t reference,
                                        const std::vector<std::uint32_t>& seeing,
                                        Random& random) const
    {
        constexpr double kAgrees = 0.75;
        constexpr double kLeastCosine = 0.5; // 60 degrees
        const auto towards = [&](std::uint32_t view) -> Vector3d {
            return (scene_.views[view].center - spot.position).normalized();
        };
        std::vector<std::uint32_t> views;
        for (const std::uint32_t view : seeing) {
            const bool alike = towards(view).dot(towards(reference)) >= kLeastCosine;
            if (view == reference || (random.uniform() < kAgrees && alike)) views.push_back(view);
        }
        return views;
    }

    /// As a share of the depth.
    double depth_error(const Spot& spot, std::uint32_t reference, std::size_t num_views,
                       Random& random) const
    {
        constexpr double kDisparityPx = 0.5;
        constexpr double kBaseline = 0.2; // of the depth
        constexpr double kFalse = 1.0 / 200.0;
        constexpr double kMostFalse = 0.1;
        const double noise = random.normal();
        const double false_by = random.uniform(-kMostFalse, kMostFalse);
        if (random.uniform() < kFalse) return false_by;
        const double focal_px = onlookers_.camera().params[0];
        const double along = onlookers_.in_camera(reference, spot.position).z() /
                             (spot.position - scene_.views[reference].center).norm();
        return noise * along * kDisparityPx / (focal_px * kBaseline) /
               std::sqrt(static_cast<double>(num_views));
    }

    static Vector3d bent(const Vector3d& normal, Random& random)
    {
        constexpr double kBend = 0.1;
        return (normal + kBend * random.normal_3d()).normalized();
    }

    void add(const Vector3d& position, const Vector3d& normal, const render::Paint& paint,
             const std::vector<std::uint32_t>& views)
    {
        const Eigen::Array3i levels = (255.0F * paint.tint).round().cast<int>();
        scene_.positions.push_back(position);
        scene_.normals.emplace_back(normal.cast<float>());
        scene_.colors.push_back({static_cast<std::uint8_t>(levels[0]),
                                 static_cast<std::uint8_t>(levels[1]),
                                 static_cast<std::uint8_t>(levels[2])});
        scene_.errors_px.push_back(-1.0);
        scene_.point_ids.push_back(scene_.point_ids.size());
        scene_.tracks.push_back(views);
    }

    Onlookers onlookers_;
    Spots spots_;
    Scene scene_;
};

} // namespace

Scene observe_densely(const ObservedScene& observed, std::size_t num_points)
{
    constexpr std::uint64_t kSeed = 2;
    const std::size_t most_tries = 100 * num_points;
    Random random(kSeed);
    Fusion fusion(observed);
    for (std::size_t i = 0; i < most_tries && fusion.num_points() < num_points; ++i) {
        fusion.add_point(random);
    }
    if (fusion.num_points() < num_points) {
        throw std::runtime_error(observed.name +
                                 ": too little of the scene is seen by three views");
    }
    return fusion.take();
}

} // namespace vcarve::observed
