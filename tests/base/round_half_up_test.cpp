#include "base/round_half_up.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::round_half_up_test {
namespace {

TEST(RoundHalfUp, GivesWhatTheStandardLibraryGives)
{
    for (const double number : {0.0, 0.25, 0.49999999999999994, 0.5, 0.75, 1.5, 2.5, 255.49,
                                1e6 + 0.5, 2147483646.5, 2147483647.0}) {
        EXPECT_EQ(round_half_up(number), std::lround(number)) << number;
    }
}

} // namespace
} // namespace vcarve::round_half_up_test
