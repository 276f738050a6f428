#include "base/parallel.h"
#include "base/union_find.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace vcarve::union_find_test {
namespace {

TEST(UnionFind, UsesTheLeastMemberAsRoot)
{
    UnionFind sets(6);
    sets.join(5, 3);
    sets.join(4, 2);
    sets.join(3, 4);
    EXPECT_EQ(sets.root(5), 2U);
    EXPECT_EQ(sets.root(3), 2U);
    EXPECT_EQ(sets.root(0), 0U);
    sets.join(1, 5);
    EXPECT_EQ(sets.root(4), 1U);
}

TEST(UnionFind, JoinsConcurrentlyWithTheSameResult)
{
    constexpr std::uint32_t kSize = 100'000;
    constexpr std::uint32_t kSets = 7; // one per residue modulo 7
    tbb::task_arena(4).execute([&] {
        for (int round = 0; round < 20; ++round) {
            UnionFind sets(kSize);
            parallel_for(
                kSize - kSets,
                [&](std::size_t i) {
                    const auto from_the_end = static_cast<std::uint32_t>(kSize - 1 - i);
                    sets.join(from_the_end, from_the_end - kSets);
                },
                16);
            for (std::uint32_t i = 0; i < kSize; ++i) {
                ASSERT_EQ(sets.root(i), i % kSets);
            }
        }
    });
}

} // namespace
} // namespace vcarve::union_find_test
