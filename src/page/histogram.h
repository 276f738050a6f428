#pragma once

#include <cstdint>
#include <vector>

namespace vcarve {

/// How often values fall between which bounds.
struct Histogram {
    std::vector<double> bounds;       ///< ascending, one more than counts
    std::vector<std::int64_t> counts; ///< of values from a bound up to the next, that excluded
    std::int64_t values = 0;          ///< in all: those of the counts, and `beyond`
    std::int64_t beyond = 0;          ///< how many lie at the last bound or above it
    double median = 0.0;              ///< of all values, the upper one of two; 0 of none
    double largest = 0.0;             ///< of all values; 0 of none
};

/// Whole numbers one by one, from the smallest to at most `bins` above; those beyond, which long
/// tails have, are counted together.
Histogram histogram_of_counts(std::vector<std::int64_t> values, int bins);

/// Values from 0 up to about their 99th percentile, in `bins` steps that are equal and round (1, 2
/// or 5 times a power of ten), fewer where that does; those beyond are counted together. Values
/// must be finite and not negative.
Histogram histogram_of_lengths(std::vector<double> values, int bins);

} // namespace vcarve
