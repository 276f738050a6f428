#include "geometry/lexicographic_sort.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace vcarve::lexicographic_sort_test {
namespace {

TEST(LexicographicSort, IsByCoordinatesAndThenByIndexWithoutWhatIsNotFinite)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(lexicographic_sort({{1, 0, 0},
                                  {0, 1, 0},
                                  {nan, 0, 0},
                                  {0, 0, 5},
                                  {0, 1, 0},
                                  {0, infinity, 0},
                                  {0, 1, -1},
                                  {-2, 9, 9}}),
              (std::vector<std::uint32_t>{7, 3, 6, 1, 4, 0}));
    EXPECT_TRUE(lexicographic_sort({}).empty());
}

} // namespace
} // namespace vcarve::lexicographic_sort_test
