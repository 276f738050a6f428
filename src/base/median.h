#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace vcarve {

/// The middle one of the values, the upper of two; 0 where there are none. Changes their order.
/// Cost: O(n).
inline double median_in_place(std::span<double> values)
{
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The same, leaving the values of the caller as they are.
inline double median(std::vector<double> values)
{
    return median_in_place(values);
}

} // namespace vcarve
