#pragma once

#include "base/median.h"
#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vcarve {

/// The median of value(i) over the i in [0, count), or over every n-th where there are many.
/// Negative values count for none. Cost: O(count), in parallel.
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

} // namespace vcarve
