#include "base/unset_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace vcarve::unset_array_test {
namespace {

TEST(UnsetArray, HoldsWhatItIsGiven)
{
    UnsetArray<int> array(3, 7);
    array.resize(5, 8);
    EXPECT_EQ(array, (UnsetArray<int>{7, 7, 7, 8, 8}));
    const UnsetArray<int> copy = array;
    EXPECT_EQ(copy, array);
}

TEST(UnsetArray, IsFilledToItsEnd)
{
    using Pair = std::array<std::int32_t, 2>;
    for (const std::size_t count : {0U, 1U, 65536U, 200001U}) {
        const UnsetArray<Pair> array = filled_array(count, Pair{3, -4});
        EXPECT_EQ(array.size(), count);
        EXPECT_EQ(std::ranges::count(array, Pair{3, -4}), static_cast<std::ptrdiff_t>(count));
    }
}

} // namespace
} // namespace vcarve::unset_array_test
