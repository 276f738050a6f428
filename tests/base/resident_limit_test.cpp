#include "base/resident_limit.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace vcarve::resident_limit_test {
namespace {

constexpr std::int64_t kMiB = std::int64_t{1} << 20;

TEST(ResidentLimit, DropsNothingBelowTheLimit)
{
    EXPECT_EQ(bytes_to_drop({.all = 0, .of_files = 0}, 1600), 0);
    EXPECT_EQ(bytes_to_drop({.all = 1000, .of_files = 1000}, 1600), 0);
    EXPECT_EQ(
        bytes_to_drop({.all = 1200, .of_files = 1200}, std::numeric_limits<std::int64_t>::max()),
        0);
}

TEST(ResidentLimit, DropsToHalfTheLimit)
{
    EXPECT_EQ(bytes_to_drop({.all = 1001, .of_files = 1001}, 1600), 201);
    EXPECT_EQ(bytes_to_drop({.all = 3000, .of_files = 3000}, 1600), 2200);
}

TEST(ResidentLimit, KeepsSomePagesIfOtherMemoryExceedsTheLimit)
{
    EXPECT_EQ(bytes_to_drop({.all = 3000, .of_files = 500}, 1600), 300);
    EXPECT_EQ(bytes_to_drop({.all = 3000, .of_files = 200}, 1600), 0);
    EXPECT_EQ(bytes_to_drop({.all = 3000, .of_files = 100}, 1600), 0);
}

TEST(ResidentSize, GrowsWithWrittenMemory)
{
    const auto before = resident_size();
    ASSERT_TRUE(before);
    EXPECT_GE(before->all, before->of_files);
    EXPECT_GT(before->of_files, 0) << "pages of the program file";
    // AddressSanitizer adds an eighth, so 64 MiB would reach the upper bound.
    const std::vector<char> written(static_cast<std::size_t>(60 * kMiB), 'x');
    const auto after = resident_size();
    EXPECT_GE(after->all - before->all, 56 * kMiB);
#ifndef VCARVE_WATCHES_THREADS // ThreadSanitizer's shadow memory is several times larger
    EXPECT_LE(after->all - before->all, 72 * kMiB);
#endif
    EXPECT_EQ(written.back(), 'x');
}

} // namespace
} // namespace vcarve::resident_limit_test
