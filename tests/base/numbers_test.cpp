#include "base/numbers.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace vcarve::numbers_test {
namespace {

std::string refusal_of(std::uint64_t count, std::uint64_t most)
{
    return refusal<InputError>([&] { require_indexable(count, most, "points"); });
}

TEST(RequireIndexable, AcceptsAtMostAsManyAsIndices)
{
    EXPECT_EQ(refusal_of(4'294'967'295, kMostIndices), "no exception");
    EXPECT_EQ(
        refusal_of(4'294'967'296, kMostIndices),
        "the model results in 4294967296 points, but 32-bit indices allow at most 4294967295");
}

TEST(RequireIndexable, ReservesSixHalfEdgesPerFace)
{
    EXPECT_EQ(refusal_of(357'913'941, kMostFaces), "no exception");
    EXPECT_EQ(refusal_of(357'913'942, kMostFaces),
              "the model results in 357913942 points, but 32-bit indices allow at most 357913941");
}

TEST(RoundHalfUp, AgreesWithTheStandardLibrary)
{
    for (const double number : {0.0, 0.25, 0.49999999999999994, 0.5, 0.75, 1.5, 2.5, 255.49,
                                1e6 + 0.5, 2147483646.5, 2147483647.0}) {
        EXPECT_EQ(round_half_up(number), std::lround(number)) << number;
    }
}

TEST(RandomNumber, DependsOnlyOnSeedAndIndex)
{
    EXPECT_EQ(random_number(1, 5), random_number(1, 5));
    EXPECT_NE(random_number(1, 5), random_number(1, 6));
    EXPECT_NE(random_number(1, 5), random_number(2, 5));
}

TEST(RandomNumber, IsUniformInTheUnitInterval)
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
} // namespace vcarve::numbers_test
