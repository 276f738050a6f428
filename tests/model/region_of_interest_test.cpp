#include "model/region_of_interest.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace vcarve::region_of_interest_test {
namespace {

using Eigen::Vector3d;

/// A point that the first views see.
MadePoint seen_point(const Vector3d& position, std::uint32_t views)
{
    MadePoint point{position, {}};
    for (std::uint32_t view = 0; view < views; ++view) {
        point.views.push_back(view);
    }
    return point;
}

/// (i, 0, 5) for i from -50 to 50, shuffled, each seen by ten views: 1010 sights.
std::vector<MadePoint> seen_row()
{
    std::vector<MadePoint> points;
    for (int i = -50; i <= 50; ++i) {
        points.push_back(seen_point({static_cast<double>(i), 0, 5}, 10));
    }
    std::shuffle(points.begin(), points.end(), std::mt19937(51));
    return points;
}

Ball ball_of(const std::vector<MadePoint>& points)
{
    return region_of_interest(make_scene(std::vector<Vector3d>(100, Vector3d::Zero()), points));
}

TEST(RegionOfInterest, HoldsNineteenTwentiethsOfTheSightsOrSo)
{
    // 94 % of 1010 sights are 949.4, so 95 points: one more than from -47 to 46.
    const Ball ball = ball_of(seen_row());
    EXPECT_NEAR(ball.center.x(), 0.0, 0.5);
    EXPECT_EQ(ball.center.tail<2>(), Eigen::Vector2d(0, 5));
    EXPECT_NEAR(ball.radius, 47.0, 0.5);
}

TEST(RegionOfInterest, IsWhereMostSightsEndWhateverLiesFarBehind)
{
    auto points = seen_row();
    for (int i = 0; i < 5; ++i) {
        points.push_back(seen_point({1e6 + i, 0, 5}, 10)); // a twentieth
    }
    const Ball ball = ball_of(points);
    EXPECT_NEAR(ball.center.x(), 0.0, 1.0);
    EXPECT_NEAR(ball.radius, 50.0, 1.0);
}

TEST(RegionOfInterest, CountsAPointOnceForEveryViewThatSawIt)
{
    auto points = seen_row();
    points.push_back(seen_point({200, 0, 5}, 60)); // 60 of 1070 sights: left out
    EXPECT_LT(ball_of(points).radius, 60.0);
    points.back() = seen_point({200, 0, 5}, 80); // 80 of 1090: more than may be left out
    EXPECT_GT(ball_of(points).radius, 150.0);
}

TEST(RegionOfInterest, CountsNoPointThatNobodySaw)
{
    auto points = seen_row();
    const Ball ball = ball_of(points);
    for (int i = 0; i < 1000; ++i) {
        points.push_back({{-500.0 - i, 500.0 + i, -1}, {}});
    }
    EXPECT_EQ(ball_of(points).center, ball.center);
    EXPECT_EQ(ball_of(points).radius, ball.radius);
}

TEST(RegionOfInterest, HasNoRadiusWithoutSights)
{
    EXPECT_EQ(ball_of({}).radius, 0.0);
    EXPECT_EQ(ball_of({{{1, 2, 3}, {}}}).radius, 0.0);
}

} // namespace
} // namespace vcarve::region_of_interest_test
