#include "steps/1_points/denoise.h"

#include "base/parallel.h"
#include "geometry/bilateral_filter.h"
#include "geometry/nearest_neighbors.h"
#include "geometry/point_order.h"
#include "model/camera.h"
#include "model/views.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using Vectors = std::vector<Vector3d>; ///< one per point

/// Number of neighbors that define the surface around a point. A larger number bends it near edges,
/// but is needed to fit normals and for noise as large as the point spacing.
constexpr std::size_t kFewAround = 12;
constexpr std::size_t kManyAround = 24;

bool knows_all_normals(const Scene& scene)
{
    return !scene.normals.empty() &&
           std::ranges::none_of(scene.normals, [](const auto& normal) { return normal.isZero(); });
}

/// The direction of least spread of the points around a point, oriented towards the views.
Vector3d fitted_normal(const Scene& scene, const Neighborhoods& neighborhoods, std::size_t point)
{
    const Vector3d& position = scene.positions[point];
    const auto around = neighborhoods.around(point);
    Vector3d mean = position;
    for (const std::uint32_t other : around) {
        mean += scene.positions[other];
    }
    mean /= static_cast<double>(around.size() + 1);
    Matrix3d spread = (position - mean) * (position - mean).transpose();
    for (const std::uint32_t other : around) {
        const Vector3d from_mean = scene.positions[other] - mean;
        const double distance_sq = (scene.positions[other] - position).squaredNorm();
        spread += std::exp(log_nearness(distance_sq, neighborhoods.reach_sq(point))) * from_mean *
                  from_mean.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    const Vector3d normal = solver.computeDirect(spread).eigenvectors().col(0);
    return normal.dot(towards_views(scene, point)) < 0.0 ? Vector3d(-normal) : normal;
}

/// Filtered surface normals at the points, from the cloud or fitted.
Vectors surface_normals(const Scene& scene, const Neighborhoods& neighborhoods)
{
    Vectors normals(scene.num_points());
    parallel_for(normals.size(), [&](std::size_t i) {
        const bool is_known = !scene.normals.empty() && !scene.normals[i].isZero();
        normals[i] = is_known ? Vector3d(scene.normals[i].cast<double>())
                              : fitted_normal(scene, neighborhoods, i);
    });
    return filtered_normals(scene.positions, normals, neighborhoods);
}

BilateralFilter filter_of(const Scene& scene, std::size_t num_around, const Progress& progress)
{
    Neighborhoods neighborhoods = nearest_neighborhoods(scene.positions, num_around, progress);
    Vectors normals = surface_normals(scene, neighborhoods);
    const std::vector<double> focals_px = mean_focals_px(scene.cameras);
    return {scene.positions, std::move(normals), std::move(neighborhoods),
            [&](std::size_t point) { return covariance_of_a_pixel(scene, point, focals_px); }};
}

/// A filter, and the noise of the model.
struct NoiseFilter {
    BilateralFilter filter;
    UsualValues* usual;
    std::optional<double> UsualValues::*px;
    std::optional<double> UsualValues::*in_spacings;

    double noise_px() const
    {
        return usual_value(usual, px, [&] { return filter.noise_px(); });
    }
    double noise_in_spacings() const
    {
        return usual_value(usual, in_spacings, [&] { return filter.noise_in_spacings(); });
    }
};

/// Whether a scan is so exact that its noise is negligible beside the point spacing. The measured
/// noise is then real surface detail.
bool is_exact_scan(const Scene& scene, const NoiseFilter& filter)
{
    constexpr double kExact = 0.083;
    return has_scanners(scene) && filter.noise_in_spacings() < kExact;
}

NoiseFilter filter_of(const Scene& scene, UsualValues* usual, const Progress& progress)
{
    constexpr double kNoisy = 0.4;
    if (knows_all_normals(scene)) {
        NoiseFilter few = {filter_of(scene, kFewAround, progress.part(0.0, 0.6)), usual,
                           &UsualValues::noise_px, &UsualValues::noise_spacings};
        if (few.noise_in_spacings() < kNoisy) return few;
    }
    return {filter_of(scene, kManyAround, progress.part(0.6, 1.0)), usual,
            &UsualValues::wide_noise_px, &UsualValues::wide_noise_spacings};
}

} // namespace

void keep_apart(std::vector<Vector3d>& positions, const std::vector<Vector3d>& before)
{
    bool changed = true;
    while (changed) {
        changed = false;
        const std::vector<std::uint32_t> order = lexicographic_sort(positions);
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (positions[order[i]] != positions[order[i - 1]]) continue;
            for (const std::uint32_t point : {order[i - 1], order[i]}) {
                changed = changed || positions[point] != before[point];
                positions[point] = before[point];
            }
        }
    }
}

DenoiseReport denoise_points(Scene& scene, const DenoiseOptions& options, const Progress& progress,
                             UsualValues* usual)
{
    constexpr std::size_t kLeastPoints = 4; // a point and three neighbors
    DenoiseReport report;
    if (scene.num_points() < kLeastPoints) return report;
    const NoiseFilter filter = filter_of(scene, usual, progress.part(0.0, 0.7));
    progress.report(0.8);
    report.noise_px = filter.noise_px();
    const double gate = options.denoise * report.noise_px;
    if (!(gate > 0.0) || is_exact_scan(scene, filter)) return report;
    Vectors estimates(scene.num_points());
    parallel_for(estimates.size(), progress.part(0.85, 1.0),
                 [&](std::size_t i) { estimates[i] = filter.filter.estimate(i, gate); });
    keep_apart(estimates, scene.positions);
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        if (estimates[i] != scene.positions[i]) ++report.moved;
    }
    scene.positions = std::move(estimates);
    return report;
}

} // namespace vcarve
