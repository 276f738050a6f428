#include "model/middle_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace vcarve::middle_box_test {
namespace {

using Eigen::Vector3d;

/// (i, -i, 5) for i from 0 to count - 1, shuffled.
std::vector<Vector3d> row(int count)
{
    std::vector<Vector3d> positions;
    positions.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        positions.emplace_back(i, -i, 5.0);
    }
    std::shuffle(positions.begin(), positions.end(), std::mt19937(51));
    return positions;
}

TEST(MiddleBox, LeavesOutAShareAtEitherEnd)
{
    const Eigen::AlignedBox3d box = middle_box(row(101), 0.02);
    EXPECT_EQ(box.min(), Vector3d(2, -98, 5));
    EXPECT_EQ(box.max(), Vector3d(98, -2, 5));
}

TEST(MiddleBox, IsTheWholeBoxWithoutTails)
{
    const Eigen::AlignedBox3d box = middle_box(row(101), 0.0);
    EXPECT_EQ(box.min(), Vector3d(0, -100, 5));
    EXPECT_EQ(box.max(), Vector3d(100, 0, 5));
}

TEST(MiddleBox, LeavesOutNoPartOfAPosition)
{
    EXPECT_EQ(middle_box(row(50), 0.02).max(), Vector3d(49, 0, 5));
    EXPECT_EQ(middle_box(row(51), 0.02).max(), Vector3d(49, -1, 5));
    EXPECT_EQ(middle_box(row(1), 0.4).min(), Vector3d(0, 0, 5));
}

TEST(MiddleBox, IsEmptyWithoutPositions)
{
    EXPECT_TRUE(middle_box({}, 0.02).isEmpty());
}

} // namespace
} // namespace vcarve::middle_box_test
