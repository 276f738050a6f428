#include "base/parallel.h"
#include "base/threads.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <vector>

namespace vcarve::parallel_test {
namespace {

TEST(ParallelCollect, PreservesTheOrder)
{
    const auto twice_the_odd = [](std::size_t i, std::vector<std::size_t>& items) {
        if (i % 2 == 1) items.insert(items.end(), {i, i});
    };
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < 1000; ++i) {
        twice_the_odd(i, expected);
    }
    for (const std::size_t grain : {1, 7, 1000, 5000}) {
        EXPECT_EQ(parallel_collect<std::size_t>(1000, twice_the_odd, grain), expected);
    }
    EXPECT_TRUE(parallel_collect<std::size_t>(0, twice_the_odd).empty());
}

TEST(AvailableThreads, ReturnsOneOnASingleCore)
{
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
    int core = 0;
    while (!CPU_ISSET(core, &before)) {
        ++core;
    }
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
    EXPECT_EQ(available_threads(), 1);
    ASSERT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
}

} // namespace
} // namespace vcarve::parallel_test
