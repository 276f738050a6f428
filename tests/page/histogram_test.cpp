#include "page/histogram.h"

#include <gtest/gtest.h>

#include <numeric>

namespace vcarve::histogram_test {
namespace {

using Counts = std::vector<std::int64_t>;
using Bounds = std::vector<double>;

TEST(HistogramOfCounts, CountsWholeNumbersOneByOne)
{
    const Histogram histogram = histogram_of_counts({2, 3, 2, 5, 2}, 10);
    EXPECT_EQ(histogram.bounds, (Bounds{2, 3, 4, 5, 6}));
    EXPECT_EQ(histogram.counts, (Counts{3, 1, 0, 1}));
    EXPECT_EQ(histogram.beyond, 0);
    EXPECT_EQ(histogram.values, 5);
    EXPECT_EQ(histogram.median, 2.0);
    EXPECT_EQ(histogram.largest, 5.0);
}

TEST(HistogramOfCounts, CountsALongTailTogether)
{
    const Histogram histogram = histogram_of_counts({2, 3, 4, 99, 1000}, 3);
    EXPECT_EQ(histogram.bounds, (Bounds{2, 3, 4, 5}));
    EXPECT_EQ(histogram.counts, (Counts{1, 1, 1}));
    EXPECT_EQ(histogram.beyond, 2);
    EXPECT_EQ(histogram.largest, 1000.0);
}

TEST(HistogramOfLengths, HasRoundSteps)
{
    const Histogram histogram = histogram_of_lengths({0.0, 0.1, 0.9, 1.0, 1.9, 3.7}, 4);
    EXPECT_EQ(histogram.bounds, (Bounds{0, 1, 2, 3, 4}));
    EXPECT_EQ(histogram.counts, (Counts{3, 2, 0, 1}));
    EXPECT_EQ(histogram.beyond, 0);
}

TEST(HistogramOfLengths, LeavesOutliersToOneColumn)
{
    std::vector<double> lengths(1000, 1.0);
    lengths[7] = 1e6;
    const Histogram histogram = histogram_of_lengths(lengths, 10);
    EXPECT_EQ(histogram.beyond, 1);
    EXPECT_EQ(histogram.largest, 1e6);
    EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), histogram.beyond),
              1000);
    EXPECT_LT(histogram.bounds.back(), 2.0);
}

TEST(HistogramOfLengths, TakesZerosAndNothing)
{
    EXPECT_EQ(histogram_of_lengths({0.0, 0.0}, 10).counts, (Counts{2}));
    EXPECT_EQ(histogram_of_lengths({}, 10).values, 0);
    EXPECT_TRUE(histogram_of_counts({}, 10).bounds.empty());
}

} // namespace
} // namespace vcarve::histogram_test
