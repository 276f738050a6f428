#include "steps/1_points/denoise.h"

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/nearest_neighbors.h"
#include "model/camera.h"
#include "model/measured_range.h"
#include "model/towards_views.h"
#include "steps/1_points/lexicographic_sort.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using Vectors = std::vector<Vector3d>; ///< one a point

/// The logarithm of how the share of a neighbour falls with its distance, in distances of the
/// farthest one. Sums of logarithms, so that one exponential does for all.
double log_nearness(double distance_sq, double reach_sq)
{
    constexpr double kSpread = 1.0 / 1.5;
    return -distance_sq / (2.0 * kSpread * kSpread * reach_sq);
}

/// Of how it falls with the angle between the normals, about 20 degrees.
double log_likeness(double cosine)
{
    constexpr double kSpread = 0.35;
    return -(1.0 - cosine) / (kSpread * kSpread);
}

/// How many points around a point tell how the surface runs there. More than the few bend it where
/// they reach around an edge; but fitting normals, and noise as large as the distances between
/// points, take more.
constexpr std::size_t kFewAround = 12;
constexpr std::size_t kManyAround = 24;

bool knows_all_normals(const Scene& scene)
{
    return !scene.normals.empty() &&
           std::ranges::none_of(scene.normals, [](const auto& normal) { return normal.isZero(); });
}

/// The nearest points around every point.
class Neighborhoods {
  public:
    Neighborhoods(const Vectors& positions, std::size_t count, const Progress& progress)
        : count_(std::min(count, positions.size() - 1)),
          points_(positions.size() * count_),
          reaches_sq_(positions.size())
    {
        const NearestNeighbors tree(positions);
        const auto kept = static_cast<std::ptrdiff_t>(count_);
        progress.tell(0.4);
        parallel_for_ranges(
            positions.size(), progress.part(0.4, 1.0), [&](std::size_t first, std::size_t last) {
                std::vector<NearestNeighbors::Neighbor> nearest;
                for (std::size_t i = first; i < last; ++i) {
                    tree.find(positions[i], count_ + 1, nearest);
                    reaches_sq_[i] = nearest.back().distance_sq;
                    const auto self = std::ranges::find(nearest, static_cast<std::uint32_t>(i),
                                                        &NearestNeighbors::Neighbor::point);
                    if (self != nearest.end()) nearest.erase(self);
                    std::ranges::transform(nearest.begin(), nearest.begin() + kept,
                                           points_.begin() + begin(i),
                                           &NearestNeighbors::Neighbor::point);
                }
            });
    }

    std::span<const std::uint32_t> around(std::size_t point) const
    {
        return {points_.data() + begin(point), count_};
    }
    /// The square of the distance to the farthest of them.
    double reach_sq(std::size_t point) const { return reaches_sq_[point]; }

    /// The square of how far points stand apart where the surface is flat.
    double spacing_sq(std::size_t point) const
    {
        return reaches_sq_[point] * std::numbers::pi / static_cast<double>(count_);
    }

  private:
    std::ptrdiff_t begin(std::size_t point) const
    {
        return static_cast<std::ptrdiff_t>(point * count_);
    }

    std::size_t count_;
    std::vector<std::uint32_t> points_;
    std::vector<double> reaches_sq_;
};

/// How uncertain a point is if each of its sights is in error by one pixel; zero where they do not
/// cross. Of a scanner's sight the range is in error, too, by as much as a pixel covers there.
Matrix3d covariance_of_a_pixel(const Scene& scene, std::size_t point,
                               const std::vector<double>& focals_px)
{
    Matrix3d information = Matrix3d::Zero();
    for (const std::uint32_t v : scene.tracks[point]) {
        const View& view = scene.views[v];
        const Vector3d sight = scene.positions[point] - view.center;
        const double distance_sq = sight.squaredNorm();
        const double pixels_sq = focals_px[view.camera] * focals_px[view.camera] / distance_sq;
        if (scene.cameras[view.camera].measures_range) {
            information += pixels_sq * Matrix3d::Identity();
            continue;
        }
        information += pixels_sq * (Matrix3d::Identity() - sight * sight.transpose() / distance_sq);
    }
    const double scale = information.trace() / 3.0;
    if (!(information.determinant() > 1e-12 * scale * scale * scale)) return Matrix3d::Zero();
    return information.inverse();
}

/// The direction in which the points around a point spread least, towards the views.
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

/// Normals of the surface at the points: the cloud's or fitted ones, then filtered.
Vectors surface_normals(const Scene& scene, const Neighborhoods& neighborhoods)
{
    Vectors normals(scene.num_points());
    parallel_for(normals.size(), [&](std::size_t i) {
        const bool is_known = !scene.normals.empty() && !scene.normals[i].isZero();
        normals[i] = is_known ? Vector3d(scene.normals[i].cast<double>())
                              : fitted_normal(scene, neighborhoods, i);
    });
    Vectors filtered(normals.size());
    parallel_for(normals.size(), [&](std::size_t i) {
        Vector3d sum = normals[i];
        for (const std::uint32_t other : neighborhoods.around(i)) {
            const double distance_sq = (scene.positions[other] - scene.positions[i]).squaredNorm();
            sum += std::exp(log_nearness(distance_sq, neighborhoods.reach_sq(i)) +
                            log_likeness(normals[i].dot(normals[other]))) *
                   normals[other];
        }
        filtered[i] = sum.normalized();
    });
    return filtered;
}

/// Estimates where the points are, each from itself and those around.
class Denoiser {
  public:
    Denoiser(const Scene& scene, std::size_t num_around, const Progress& progress)
        : scene_(scene),
          neighborhoods_(scene.positions, num_around, progress),
          normals_(surface_normals(scene, neighborhoods_)),
          spreads_(scene.num_points()),
          variances_(scene.num_points())
    {
        const std::vector<double> focals_px = mean_focals_px(scene.cameras);
        parallel_for(variances_.size(), [&](std::size_t i) {
            spreads_[i] = covariance_of_a_pixel(scene, i, focals_px) * normals_[i];
            variances_[i] = normals_[i].dot(spreads_[i]);
        });
    }

    /// The standard deviation of the points' places in the images.
    double noise_px() const
    {
        constexpr double kSigmaOfMedian = 1.4826; // of a normal distribution
        constexpr double kAll = 1e100;            // no plane is too far
        return kSigmaOfMedian * median_of_some([&](std::size_t i) {
                   const double height = height_above_surface(i, kAll).value;
                   return variances_[i] > 0.0 ? std::abs(height) / std::sqrt(variances_[i]) : 0.0;
               });
    }

    /// The same of their heights, over the distances between points: the median.
    double noise_in_spacings() const
    {
        return noise_px() * median_of_some([&](std::size_t i) {
                   return std::sqrt(variances_[i] / neighborhoods_.spacing_sq(i));
               });
    }

    /// Where a point is, if planes farther than `gate` times what a pixel makes of its uncertainty
    /// are others, and it is so much from where it was at most.
    Vector3d estimate(std::size_t point, double gate) const
    {
        const Vector3d& position = scene_.positions[point];
        if (scene_.errors_px[point] >= 0.0 || !(variances_[point] > 0.0)) return position;
        const Height height = height_above_surface(point, gate);
        const double deviation = std::sqrt(variances_[point]);
        const double most = gate / deviation;
        const double way = height.value / (variances_[point] + height.variance);
        return position - std::clamp(way, -most, most) * spreads_[point];
    }

  private:
    /// The median of value(i) over the points, or over every so manieth where there are many.
    template <typename Value>
    double median_of_some(const Value& value) const
    {
        constexpr std::size_t kEnough = 100'000;
        const std::size_t step = 1 + variances_.size() / kEnough;
        std::vector<double> values((variances_.size() + step - 1) / step);
        parallel_for(values.size(), [&](std::size_t i) { values[i] = value(i * step); });
        return median_in_place(values);
    }

    /// How far a point lies above the surface, and how uncertain the surface is there.
    struct Height {
        double value = 0.0;
        double variance = 0.0; ///< at a pixel
    };

    Height height_above_surface(std::size_t point, double gate) const
    {
        constexpr double kLeastAgreement = 1e-6; // of planes, or they are all others
        double sum = 0.0;
        double weights = 0.0;
        double squares = 0.0;
        double all_weights = 0.0;
        for (const std::uint32_t other : neighborhoods_.around(point)) {
            const Vector3d way = scene_.positions[point] - scene_.positions[other];
            const double cosine = normals_[point].dot(normals_[other]);
            const double variance = variances_[point] + variances_[other];
            if (!(variances_[other] > 0.0)) continue;
            const double height = normals_[other].dot(way);
            const double of_all =
                std::exp(log_nearness(way.squaredNorm(), neighborhoods_.reach_sq(point)) +
                         log_likeness(cosine)) /
                variance;
            const double agreement = std::exp(-height * height / (2.0 * gate * gate * variance));
            const double weight = of_all * agreement;
            all_weights += of_all;
            sum += weight * height;
            weights += weight;
            squares += weight * weight * variance;
        }
        if (!(weights > kLeastAgreement * all_weights)) return {};
        return {sum / weights, squares / (weights * weights)};
    }

    const Scene& scene_;
    Neighborhoods neighborhoods_;
    Vectors normals_;
    Vectors spreads_;               ///< the covariance of a pixel times the normal
    std::vector<double> variances_; ///< the same along the normal
};

/// Whether a scan is so exact that its points stand out of the surface by next to nothing beside
/// the distances between them. What is taken for noise there is what the surface is like.
bool is_exact_scan(const Scene& scene, const Denoiser& denoiser)
{
    constexpr double kExact = 0.083;
    return has_scanners(scene) && denoiser.noise_in_spacings() < kExact;
}

Denoiser make_denoiser(const Scene& scene, const Progress& progress)
{
    constexpr double kNoisy = 0.4;
    if (knows_all_normals(scene)) {
        Denoiser denoiser(scene, kFewAround, progress.part(0.0, 0.6));
        if (denoiser.noise_in_spacings() < kNoisy) return denoiser;
    }
    return {scene, kManyAround, progress.part(0.6, 1.0)};
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

DenoiseReport denoise_points(Scene& scene, const DenoiseOptions& options, const Progress& progress)
{
    constexpr std::size_t kLeastPoints = 4; // a point and three around it
    DenoiseReport report;
    if (scene.num_points() < kLeastPoints) return report;
    const Denoiser denoiser = make_denoiser(scene, progress.part(0.0, 0.7));
    progress.tell(0.8);
    report.noise_px = denoiser.noise_px();
    const double gate = options.denoise * report.noise_px;
    if (!(gate > 0.0) || is_exact_scan(scene, denoiser)) return report;
    Vectors estimates(scene.num_points());
    parallel_for(estimates.size(), progress.part(0.85, 1.0),
                 [&](std::size_t i) { estimates[i] = denoiser.estimate(i, gate); });
    keep_apart(estimates, scene.positions);
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        if (estimates[i] != scene.positions[i]) ++report.moved;
    }
    scene.positions = std::move(estimates);
    return report;
}

} // namespace vcarve
