#include "steps/4_visibility/sight_weights.h"

#include "model/measured_range.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

double views_weight(double views, double views_sigma)
{
    if (views_sigma == 0.0) {
        return 1.0;
    }
    const double ratio = views / views_sigma;
    return 1.0 - std::exp(-0.5 * ratio * ratio);
}

} // namespace

// Full weight is what the median of the points that are seen gets, so that a model of two-view
// points is not all doubt.
SightWeights::SightWeights(const Scene& scene, const Scales& scales, const TraceOptions& options)
    : scene_(scene),
      options_(options),
      median_error_px_(scales.median_error_px),
      full_(views_weight(scales.median_views, options.views_sigma))
{
}

std::int32_t SightWeights::full_weight(Index point, double weight) const
{
    weight *= by_views(scene_.tracks[point]) * by_error(scene_.errors_px[point]);
    return static_cast<std::int32_t>(std::lround(kUnit * weight));
}

/// A measured range needs no second view that agrees, and so its sight stands for two.
double SightWeights::by_views(std::span<const std::uint32_t> track) const
{
    constexpr double kOfARange = 2.0;
    if (has_measured_range(scene_, track)) {
        return kOfARange;
    }
    return views_weight(static_cast<double>(track.size()), options_.views_sigma) / full_;
}

/// Errors up to the median one, and unknown ones, take nothing away.
double SightWeights::by_error(double error_px) const
{
    if (options_.error_sigma == 0.0 || median_error_px_ == 0.0) {
        return 1.0;
    }
    const double ratio = error_px / median_error_px_;
    const double beyond = std::max(0.0, ratio * ratio - 1.0);
    return std::exp(-0.5 * beyond / (options_.error_sigma * options_.error_sigma));
}

} // namespace vcarve
