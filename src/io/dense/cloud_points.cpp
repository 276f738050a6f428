#include "io/dense/cloud_points.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "base/text.h"
#include "model/scene_points.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace vcarve {
namespace {

/// Scales a normal to unit length, or sets it to zero if it has no direction.
void make_unit(Eigen::Vector3f& normal)
{
    const Eigen::Vector3d exact = normal.cast<double>();
    const double length = exact.norm();
    normal.setZero();
    if (length > 0.0 && std::isfinite(length)) normal = (exact / length).cast<float>();
}

/// The logit of half opacity.
constexpr float kLeastLogit = 0.0F;
constexpr double kHuge = 10.0; ///< times the median

bool is_solid(const Splat& splat)
{
    return splat.opacity_logit >= kLeastLogit;
}

/// The logarithm of the half-axis above which a Gaussian is huge.
float largest_log_axis(const std::vector<Splat>& splats)
{
    std::vector<double> logs;
    for (const Splat& splat : splats) {
        if (is_solid(splat) && !std::isnan(splat.log_axis)) logs.push_back(splat.log_axis);
    }
    return logs.empty() ? 0.0F : static_cast<float>(median_in_place(logs) + std::log(kHuge));
}

} // namespace

void take_attributes(PointCloud cloud, std::uint64_t first, Scene& scene)
{
    const std::size_t num_points = scene.num_points();
    scene.normals = std::move(cloud.normals);
    parallel_for(scene.normals.size(), [&](std::size_t i) { make_unit(scene.normals[i]); });
    scene.colors = std::move(cloud.colors);
    scene.colors.resize(num_points, Color{});
    scene.is_dense = true;
    scene.errors_px.assign(num_points, -1.0);
    scene.point_ids.resize(num_points);
    std::iota(scene.point_ids.begin(), scene.point_ids.end(), first);
}

KeptSplats keep_solid_splats(PointCloud& cloud)
{
    const float largest = largest_log_axis(cloud.splats);
    KeptSplats kept;
    std::int64_t faint = 0;
    std::int64_t huge = 0;
    for (std::uint64_t i = 0; i < cloud.splats.size(); ++i) {
        if (!is_solid(cloud.splats[i])) {
            ++faint;
        } else if (!(cloud.splats[i].log_axis <= largest)) {
            ++huge;
        } else {
            kept.places.push_back(i);
        }
    }
    if (faint + huge == 0) return kept;
    cloud.positions = values_at(kept.places, cloud.positions);
    cloud.normals = values_at(kept.places, cloud.normals);
    cloud.colors = values_at(kept.places, cloud.colors);
    kept.note =
        fmt::format("of {} Gaussians, {} are dropped because their opacity is below one half, "
                    "and {} because they are over {} times as large as the median",
                    grouped_digits(static_cast<std::int64_t>(cloud.splats.size())),
                    grouped_digits(faint), grouped_digits(huge), kHuge);
    return kept;
}

} // namespace vcarve
