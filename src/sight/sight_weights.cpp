#include "sight/sight_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace vcarve {

namespace {

double views_weight(std::size_t views, double views_sigma)
{
    if (views_sigma == 0.0) {
        return 1.0;
    }
    const double ratio = static_cast<double>(views) / views_sigma;
    return 1.0 - std::exp(-0.5 * ratio * ratio);
}

/// The middle one, the larger of two; nothing where there are none.
template <typename Value>
std::optional<Value> median(std::vector<Value> values)
{
    if (values.empty()) {
        return std::nullopt;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<std::size_t> track_lengths(const Tracks& tracks)
{
    std::vector<std::size_t> lengths;
    for (std::size_t point = 0; point < tracks.size(); ++point) {
        if (!tracks[point].empty()) {
            lengths.push_back(tracks[point].size());
        }
    }
    return lengths;
}

std::vector<double> known_errors_px(const Scene& scene)
{
    std::vector<double> errors;
    std::copy_if(scene.errors_px.begin(), scene.errors_px.end(), std::back_inserter(errors),
                 [](double error) { return error >= 0.0; });
    return errors;
}

} // namespace

SightWeights::SightWeights(const Scene& scene, const TraceOptions& options)
    : scene_(scene), options_(options), median_error_px_(median(known_errors_px(scene)))
{
    // Full weight is what the median of the points that are seen gets, so that a model of two-view
    // points is not all doubt.
    full_ = views_weight(median(track_lengths(scene.tracks)).value_or(1), options.views_sigma);
}

std::int32_t SightWeights::full_vote(Index point, double weight) const
{
    const double by_views = views_weight(scene_.tracks[point].size(), options_.views_sigma);
    weight *= by_views / full_ * by_error(scene_.errors_px[point]);
    return static_cast<std::int32_t>(std::lround(kUnit * weight));
}

/// Errors up to the median one, and unknown ones, take nothing away.
double SightWeights::by_error(double error_px) const
{
    const double unit_px = median_error_px_.value_or(0.0);
    if (options_.error_sigma == 0.0 || unit_px == 0.0) {
        return 1.0;
    }
    const double ratio = error_px / unit_px;
    const double beyond = std::max(0.0, ratio * ratio - 1.0);
    return std::exp(-0.5 * beyond / (options_.error_sigma * options_.error_sigma));
}

} // namespace vcarve
