#include "tiles/tiling.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace vcarve::tiling_test {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

std::vector<Vector3d> random_ground(std::size_t count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> side(0.0, 1.0);
    std::vector<Vector3d> positions(count);
    for (Vector3d& position : positions) {
        position = {4.0 * side(random), side(random), 0.01 * side(random)};
    }
    return positions;
}

TEST(Tiling, PutsEveryPositionInTheBoxOfOneTile)
{
    const std::vector<Vector3d> positions = random_ground(1000);
    const Tiling tiling = divide(positions, 100);
    ASSERT_EQ(tiling.size(), 10U);
    std::vector<int> counts(tiling.size());
    for (const Vector3d& position : positions) {
        const std::size_t tile = tiling.tile_of(position);
        ++counts[tile];
        EXPECT_TRUE((position.array() >= tiling.low[tile].array()).all());
        EXPECT_TRUE((position.array() < tiling.high[tile].array()).all());
    }
    for (const int count : counts) {
        EXPECT_LE(count, 100);
        EXPECT_GE(count, 99);
    }
}

TEST(Tiling, DividesTheLongestSideAndNotThin)
{
    const Tiling tiling = divide(random_ground(1000), 500);
    ASSERT_EQ(tiling.size(), 2U);
    EXPECT_EQ(tiling.nodes[0].axis, 0U);
    EXPECT_NEAR(tiling.nodes[0].cut, 2.0, 0.1);
    EXPECT_EQ(tiling.high[0].z(), std::numeric_limits<double>::infinity());
}

TEST(Tiling, HasOneTileForFewPointsAndKeepsEqualPositionsTogether)
{
    EXPECT_EQ(divide({}, 10).size(), 1U);
    EXPECT_EQ(divide(random_ground(10), 10).size(), 1U);
    EXPECT_EQ(divide(std::vector<Vector3d>(50, {1, 2, 3}), 10).size(), 1U);
}

TEST(Tiling, HasMarginsOfFortySpacings)
{
    const Tiling tiling = divide(random_ground(10'000), 5'000);
    ASSERT_EQ(tiling.size(), 2U);
    const double spacing = 1.0 / 50.0; // 100 x 50 points on 2 x 1
    EXPECT_NEAR(tiling.margins[0], 40.0 * spacing, 4.0 * spacing);
    EXPECT_TRUE(tiling.region(0).contains(Vector3d(2.5, 0.5, 0.0)));
    EXPECT_FALSE(tiling.region(0).contains(Vector3d(3.5, 0.5, 0.0)));
    EXPECT_TRUE(tiling.are_near(0, 1));
}

TEST(SegmentMeetsBox, FromOutsideThroughAndInside)
{
    const AlignedBox3d box(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
    EXPECT_TRUE(meets(box, {-1, 0.5, 0.5}, {2, 0.5, 0.5}));
    EXPECT_TRUE(meets(box, {0.2, 0.5, 0.5}, {0.3, 0.5, 0.5}));
    EXPECT_TRUE(meets(box, {-1, 0.5, 0.5}, {0.5, 0.5, 0.5}));
    EXPECT_FALSE(meets(box, {-1, 0.5, 0.5}, {-0.1, 0.5, 0.5}));
    EXPECT_FALSE(meets(box, {-1, 1.5, 0.5}, {2, 1.5, 0.5}));
    EXPECT_FALSE(meets(box, {-0.5, 0.7, 0.5}, {0.7, 1.9, 0.5}));
}

} // namespace
} // namespace vcarve::tiling_test
