#include "points/middle_box.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace vcarve {
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

/// The same, each point seen by ten views.
std::vector<MadePoint> seen_row(int count)
{
    std::vector<MadePoint> points;
    for (const Vector3d& position : row(count)) {
        points.push_back({position, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}});
    }
    return points;
}

Scene seen_by_many(const std::vector<MadePoint>& points)
{
    return make_scene(std::vector<Vector3d>(100, Vector3d::Zero()), points);
}

/// A point that the first views see.
MadePoint far_point(const Vector3d& position, std::uint32_t views)
{
    MadePoint point{position, {}};
    for (std::uint32_t view = 0; view < views; ++view) {
        point.views.push_back(view);
    }
    return point;
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

TEST(LookedAtBox, LeavesOutAFiftiethOfTheSightsAtEitherEnd)
{
    // 1000 sights, so 20 and with them two points are left out.
    const Eigen::AlignedBox3d box = looked_at_box(seen_by_many(seen_row(100)));
    EXPECT_EQ(box.min(), Vector3d(2, -97, 5));
    EXPECT_EQ(box.max(), Vector3d(97, -2, 5));
}

TEST(LookedAtBox, LeavesOutWhatFewViewsSawFarBehind)
{
    auto points = seen_row(100);
    points.push_back(far_point({1e6, 0, 5}, 5)); // of 1005 sights 20 are left out
    const Eigen::AlignedBox3d box = looked_at_box(seen_by_many(points));
    EXPECT_EQ(box.max(), Vector3d(98, -1, 5));
    EXPECT_EQ(box.min(), Vector3d(2, -97, 5));
}

TEST(LookedAtBox, HoldsWhatManyViewsSawFarBehind)
{
    auto points = seen_row(100);
    points.push_back(far_point({1e6, 0, 5}, 20)); // of 1020 sights 20 are left out
    EXPECT_EQ(looked_at_box(seen_by_many(points)).max(), Vector3d(99, 0, 5));
    points.back() = far_point({1e6, 0, 5}, 21);
    EXPECT_EQ(looked_at_box(seen_by_many(points)).max(), Vector3d(1e6, 0, 5));
}

TEST(LookedAtBox, CountsNoPointThatNobodySaw)
{
    auto points = seen_row(100);
    for (int i = 0; i < 1000; ++i) {
        points.push_back({{-500.0 - i, 500.0 + i, -1}, {}});
    }
    const Eigen::AlignedBox3d box = looked_at_box(seen_by_many(points));
    EXPECT_EQ(box.min(), Vector3d(2, -97, 5));
    EXPECT_EQ(box.max(), Vector3d(97, -2, 5));
}

TEST(LookedAtBox, IsEmptyWithoutSights)
{
    EXPECT_TRUE(looked_at_box(seen_by_many({})).isEmpty());
    EXPECT_TRUE(looked_at_box(seen_by_many({{{1, 2, 3}, {}}})).isEmpty());
}

} // namespace
} // namespace vcarve
