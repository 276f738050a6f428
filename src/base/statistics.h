#pragma once

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace vcarve {

/// The median of the values; the upper of two middle values; 0 without values. Changes their order.
/// Cost: O(n).
inline double median_in_place(std::span<double> values)
{
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The same, but leaves the caller's values unchanged.
inline double median(std::vector<double> values)
{
    return median_in_place(values);
}

/// The median of value(i) over i in [0, count), or over every n-th i if `count` is large (at most
/// 100,000 samples). Ignores negative values. Cost: O(samples), in parallel.
template <typename Value>
double median_of_some(std::size_t count, const Value& value)
{
    constexpr std::size_t kEnough = 100'000;
    const std::size_t step = 1 + count / kEnough;
    std::vector<double> values((count + step - 1) / step);
    parallel_for(values.size(), [&](std::size_t i) { values[i] = value(i * step); });
    std::erase_if(values, [](double number) { return number < 0.0; });
    return median_in_place(values);
}

/// The quantile of the values at `share`, from 0 to 1; the lower of two neighboring values; 0
/// without values. Changes their order. Cost: O(n).
inline double quantile_in_place(std::span<double> values, double share)
{
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

} // namespace vcarve
