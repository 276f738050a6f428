#include "page/histogram.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// The smallest round number that is not smaller.
double round_step(double step)
{
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (step <= factor * power) return factor * power;
    }
    return 10.0 * power;
}

/// The value that a share of all lies below. Sorts them as far as it must.
template <typename Value>
double quantile(std::vector<Value>& values, double share)
{
    const auto rank = std::min(static_cast<std::size_t>(share * static_cast<double>(values.size())),
                               values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
}

template <typename Value>
void count(Histogram& histogram, std::vector<Value>& values)
{
    histogram.values = static_cast<std::int64_t>(values.size());
    histogram.median = quantile(values, 0.5);
    histogram.largest = static_cast<double>(*std::ranges::max_element(values));
    histogram.counts.assign(histogram.bounds.size() - 1, 0);
    for (const Value value : values) {
        const auto bound = std::ranges::upper_bound(histogram.bounds, static_cast<double>(value));
        if (bound == histogram.bounds.end()) {
            ++histogram.beyond;
        } else {
            ++histogram.counts[static_cast<std::size_t>(bound - histogram.bounds.begin() - 1)];
        }
    }
}

} // namespace

Histogram histogram_of_counts(std::vector<std::int64_t> values, int bins)
{
    Histogram histogram;
    if (values.empty()) return histogram;
    const auto [low, high] = std::ranges::minmax(values);
    const std::int64_t steps = std::min<std::int64_t>(bins, high - low + 1);
    for (std::int64_t i = 0; i <= steps; ++i) {
        histogram.bounds.push_back(static_cast<double>(low + i));
    }
    count(histogram, values);
    return histogram;
}

Histogram histogram_of_lengths(std::vector<double> values, int bins)
{
    Histogram histogram;
    if (values.empty()) return histogram;
    const double end = quantile(values, 0.99);
    const double step = end > 0.0 ? round_step(end / bins) : 1.0;
    const auto steps = static_cast<int>(std::floor(end / step)) + 1;
    for (int i = 0; i <= steps; ++i) {
        histogram.bounds.push_back(i * step);
    }
    count(histogram, values);
    return histogram;
}

} // namespace vcarve
