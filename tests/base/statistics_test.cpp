#include "base/statistics.h"

#include <gtest/gtest.h>

namespace vcarve::statistics_test {
namespace {

TEST(Median, ReturnsTheUpperMiddleValue)
{
    EXPECT_EQ(median({}), 0.0);
    EXPECT_EQ(median({3, 1, 2}), 2.0);
    EXPECT_EQ(median({4, 1, 3, 2}), 3.0);
}

} // namespace
} // namespace vcarve::statistics_test
