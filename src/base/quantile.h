#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace vcarve {

/// The value that so large a share of the values, 0 to 1, does not exceed, the lower of two; 0
/// where there are none. Changes their order. Cost: O(n).
inline double quantile_in_place(std::span<double> values, double share)
{
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

} // namespace vcarve
