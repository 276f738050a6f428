#include "base/random_number.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace vcarve::random_number_test {
namespace {

TEST(RandomNumber, DependsOnSeedAndIndexAlone)
{
    EXPECT_EQ(random_number(1, 5), random_number(1, 5));
    EXPECT_NE(random_number(1, 5), random_number(1, 6));
    EXPECT_NE(random_number(1, 5), random_number(2, 5));
}

TEST(RandomNumber, FillsTheUnitIntervalEvenly)
{
    std::array<int, 10> tenths{};
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const double number = random_number(7, i);
        ASSERT_GE(number, 0.0);
        ASSERT_LT(number, 1.0);
        ++tenths[static_cast<std::size_t>(10.0 * number)];
    }
    // Four standard deviations of a binomial count.
    for (const int count : tenths) {
        EXPECT_NEAR(count, 10000, 380);
    }
}

} // namespace
} // namespace vcarve::random_number_test
