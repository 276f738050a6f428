#include "base/arrays.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace vcarve::arrays_test {
namespace {

TEST(UnsetArray, StoresAssignedValues)
{
    UnsetArray<int> array(3, 7);
    array.resize(5, 8);
    EXPECT_EQ(array, (UnsetArray<int>{7, 7, 7, 8, 8}));
    const UnsetArray<int> copy = array;
    EXPECT_EQ(copy, array);
}

TEST(UnsetArray, IsFilledCompletely)
{
    using Pair = std::array<std::int32_t, 2>;
    for (const std::size_t count : {0U, 1U, 65536U, 200001U}) {
        const UnsetArray<Pair> array = filled_array(count, Pair{3, -4});
        EXPECT_EQ(array.size(), count);
        EXPECT_EQ(std::ranges::count(array, Pair{3, -4}), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(ParallelRows, OrdersItemsOfARowBySource)
{
    // Source i has item i in row i % 3; source 4 has no item.
    const RowTable table = gather_rows(7, 4, [](std::size_t i, const auto& visit) {
        if (i != 4) visit(static_cast<std::uint32_t>(i % 3), static_cast<std::uint32_t>(i));
    });
    EXPECT_EQ(table.ends, (std::vector<std::uint32_t>{3, 4, 6, 6}));
    EXPECT_EQ(table.items, (UnsetArray<std::uint32_t>{0, 3, 6, 1, 2, 5}));
    EXPECT_EQ(table[1].size(), 1U);
    EXPECT_TRUE(table[3].empty());
}

TEST(ParallelRows, DoesNotDependOnThreadCount)
{
    constexpr std::size_t kSources = 300'000; // enough for several blocks
    constexpr std::size_t kRows = 1000;
    std::vector<std::vector<std::uint32_t>> expected(kRows);
    const auto for_each = [&](std::size_t i, const auto& visit) {
        for (std::size_t k = 0; k < 3; ++k) {
            visit(static_cast<std::uint32_t>((i * 7919 + k * 104'729) % kRows),
                  static_cast<std::uint32_t>(3 * i + k));
        }
    };
    for (std::size_t i = 0; i < kSources; ++i) {
        for_each(i, [&](std::uint32_t row, std::uint32_t item) { expected[row].push_back(item); });
    }
    for (const int threads : {1, 2, 4, 16}) {
        tbb::task_arena arena(threads);
        const RowTable table =
            arena.execute([&] { return gather_rows(kSources, kRows, for_each); });
        for (std::size_t row = 0; row < kRows; ++row) {
            const auto found = table[row];
            ASSERT_TRUE(std::ranges::equal(found, expected[row]))
                << threads << " threads, row " << row;
        }
    }
}

} // namespace
} // namespace vcarve::arrays_test
