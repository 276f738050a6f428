#include "geometry/bilateral_filter.h"

#include "base/statistics.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The log-weight of an angle between normals: a Gaussian, standard deviation about 20 degrees.
double log_likeness(double cosine)
{
    constexpr double kSpread = 0.35;
    return -(1.0 - cosine) / (kSpread * kSpread);
}

} // namespace

double log_nearness(double distance_sq, double reach_sq)
{
    constexpr double kSpread = 1.0 / 1.5;
    return -distance_sq / (2.0 * kSpread * kSpread * reach_sq);
}

std::vector<Vector3d> filtered_normals(std::span<const Vector3d> positions,
                                       std::span<const Vector3d> normals,
                                       const Neighborhoods& neighborhoods)
{
    std::vector<Vector3d> filtered(normals.size());
    parallel_for(normals.size(), [&](std::size_t i) {
        Vector3d sum = normals[i];
        for (const std::uint32_t other : neighborhoods.around(i)) {
            const double distance_sq = (positions[other] - positions[i]).squaredNorm();
            sum += std::exp(log_nearness(distance_sq, neighborhoods.reach_sq(i)) +
                            log_likeness(normals[i].dot(normals[other]))) *
                   normals[other];
        }
        filtered[i] = sum.normalized();
    });
    return filtered;
}

Height BilateralFilter::height(std::size_t point, double gate) const
{
    constexpr double kLeastAgreement = 1e-6; // minimum share of the weights
    double sum = 0.0;
    double weights = 0.0;
    double squares = 0.0;
    double all_weights = 0.0;
    for (const std::uint32_t other : neighborhoods_.around(point)) {
        const Vector3d way = positions_[point] - positions_[other];
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

Vector3d BilateralFilter::estimate(std::size_t point, double gate) const
{
    const Vector3d& position = positions_[point];
    const double variance = variances_[point];
    if (!(variance > 0.0)) return position;
    const Height above = height(point, gate);
    const double most = gate / std::sqrt(variance);
    const double way = above.value / (variance + above.variance);
    return position - std::clamp(way, -most, most) * spreads_[point];
}

double BilateralFilter::noise_px() const
{
    constexpr double kSigmaOfMedian = 1.4826; // standard deviation / median of absolute values
    constexpr double kAll = 1e100;            // uses planes at any distance
    return kSigmaOfMedian * median_of_some(variances_.size(), [&](std::size_t i) {
               constexpr double kUnknown = -1.0;
               const double variance = variances_[i];
               if (!(variance > 0.0)) return kUnknown;
               return std::abs(height(i, kAll).value) / std::sqrt(variance);
           });
}

double BilateralFilter::noise_in_spacings() const
{
    return noise_px() * median_of_some(variances_.size(), [&](std::size_t i) {
               return std::sqrt(variances_[i] / neighborhoods_.spacing_sq(i));
           });
}

} // namespace vcarve
