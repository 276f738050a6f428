#include "model/extent.h"
#include "support/scenes.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace vcarve::extent_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

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

TEST(MiddleBox, ExcludesAFractionAtBothEnds)
{
    const Eigen::AlignedBox3d box = middle_box(row(101), 0.02);
    EXPECT_EQ(box.min(), Vector3d(2, -98, 5));
    EXPECT_EQ(box.max(), Vector3d(98, -2, 5));
}

TEST(MiddleBox, IsTheBoundingBoxWithoutTails)
{
    const Eigen::AlignedBox3d box = middle_box(row(101), 0.0);
    EXPECT_EQ(box.min(), Vector3d(0, -100, 5));
    EXPECT_EQ(box.max(), Vector3d(100, 0, 5));
}

TEST(MiddleBox, RoundsTheNumberOfExcludedPositionsDown)
{
    EXPECT_EQ(middle_box(row(50), 0.02).max(), Vector3d(49, 0, 5));
    EXPECT_EQ(middle_box(row(51), 0.02).max(), Vector3d(49, -1, 5));
    EXPECT_EQ(middle_box(row(1), 0.4).min(), Vector3d(0, 0, 5));
}

TEST(MiddleBox, IsEmptyWithoutPositions)
{
    EXPECT_TRUE(middle_box({}, 0.02).isEmpty());
}

/// A point with a track of the first `views` views.
MadePoint seen_point(const Vector3d& position, std::uint32_t views)
{
    MadePoint point{position, {}};
    for (std::uint32_t view = 0; view < views; ++view) {
        point.views.push_back(view);
    }
    return point;
}

/// (i, 0, 5) for i from -50 to 50, shuffled, each seen by ten views: 1010 rays.
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

TEST(RegionOfInterest, ContainsTheEndsOf94PercentOfTheRays)
{
    // 94 % of 1010 rays are 949.4 rays of 95 points, which span -47 to 47.
    const Ball ball = ball_of(seen_row());
    EXPECT_NEAR(ball.center.x(), 0.0, 0.5);
    EXPECT_EQ(ball.center.tail<2>(), Eigen::Vector2d(0, 5));
    EXPECT_NEAR(ball.radius, 47.0, 0.5);
}

TEST(RegionOfInterest, ExcludesDistantBackground)
{
    auto points = seen_row();
    for (int i = 0; i < 5; ++i) {
        points.push_back(seen_point({1e6 + i, 0, 5}, 10)); // a twentieth
    }
    const Ball ball = ball_of(points);
    EXPECT_NEAR(ball.center.x(), 0.0, 1.0);
    EXPECT_NEAR(ball.radius, 50.0, 1.0);
}

TEST(RegionOfInterest, WeightsPointsByNumberOfViews)
{
    auto points = seen_row();
    points.push_back(seen_point({200, 0, 5}, 60)); // 60 of 1070 rays: excluded
    EXPECT_LT(ball_of(points).radius, 60.0);
    points.back() = seen_point({200, 0, 5}, 80); // 80 of 1090: too many to exclude
    EXPECT_GT(ball_of(points).radius, 150.0);
}

TEST(RegionOfInterest, IgnoresPointsWithoutViews)
{
    auto points = seen_row();
    const Ball ball = ball_of(points);
    for (int i = 0; i < 1000; ++i) {
        points.push_back({{-500.0 - i, 500.0 + i, -1}, {}});
    }
    EXPECT_EQ(ball_of(points).center, ball.center);
    EXPECT_EQ(ball_of(points).radius, ball.radius);
}

TEST(RegionOfInterest, HasZeroRadiusWithoutRays)
{
    EXPECT_EQ(ball_of({}).radius, 0.0);
    EXPECT_EQ(ball_of({{{1, 2, 3}, {}}}).radius, 0.0);
}

/// Two points that both views see, at the ends of a line. Their region of interest is the ball of
/// radius 1 around the origin.
Scene ends_of_line()
{
    return make_scene({{0, 0, 9}, {0, 9, 0}}, {{{-1, 0, 0}, {0, 1}}, {{1, 0, 0}, {0, 1}}});
}

void add_point(Scene& scene, const Vector3d& position, const std::vector<std::uint32_t>& track)
{
    scene.positions.push_back(position);
    scene.colors.push_back({});
    scene.errors_px.push_back(1.0);
    scene.point_ids.push_back(scene.positions.size());
    scene.tracks.push_back(track);
}

TEST(SeenPlaces, CountsCubesInsteadOfPoints)
{
    Scene scene = ends_of_line();
    // The first view sees ten equal points, the second one two points in different cubes. There are
    // 32 cubes along the diameter.
    for (int i = 0; i < 10; ++i) {
        add_point(scene, {0.01, 0.01, 0.01}, {0});
    }
    add_point(scene, {0.01, 0.2, 0.01}, {1});
    add_point(scene, {0.01, -0.2, 0.01}, {1});
    EXPECT_THAT(seen_places(scene), ElementsAre(3U, 4U));
}

TEST(SeenPlaces, IgnoresDistantAndNonFinitePoints)
{
    Scene scene = ends_of_line();
    for (int i = 0; i < 40; ++i) {
        add_point(scene, {0.01, 0.01, 0.01}, {0, 1});
    }
    add_point(scene, {0, 0, -100}, {1});
    add_point(scene, {0, std::numeric_limits<double>::quiet_NaN(), 0}, {});
    const std::vector<std::size_t> places = seen_places(scene);
    EXPECT_EQ(places[1], places[0]);
}

TEST(SeenPlaces, AreZeroWithoutPoints)
{
    EXPECT_THAT(seen_places(make_scene({{0, 0, 9}, {0, 9, 0}}, {})), ElementsAre(0U, 0U));
    EXPECT_TRUE(seen_places({}).empty());
}

TEST(SeenPlaces, CountsEqualPositionsOnce)
{
    const Scene scene = make_scene({{0, 0, 9}}, {{{1, 2, 3}, {0}}, {{1, 2, 3}, {0}}});
    EXPECT_THAT(seen_places(scene), ElementsAre(1U));
}

/// A cloud with a diameter of `size` around a position.
Scene cloud_at(const Vector3d& place, double size)
{
    return moved(bumpy_sphere(500, 1), size / 2.0, Eigen::Quaterniond::Identity(), place);
}

TEST(RoundOffset, IsRoundAndNearTheModel)
{
    // The diagonal of the middle nine tenths of a ball of diameter 40 is about 60.
    EXPECT_EQ(round_offset(cloud_at({500123.4, 4600987.6, 5270.0}, 40.0)),
              Vector3d(500100.0, 4601000.0, 5300.0));
    EXPECT_EQ(round_offset(cloud_at({-500123.4, 0.0, 0.0}, 4.0)), Vector3d(-500120.0, 0.0, 0.0));
    EXPECT_EQ(round_offset(cloud_at({12.3456, 0.0, 0.0}, 0.04)), Vector3d(12.3, 0.0, 0.0));
}

TEST(RoundOffset, IsZeroAlongAxesWhereModelIsNearTheOrigin)
{
    EXPECT_EQ(round_offset(cloud_at({0.0, 0.0, 0.0}, 4.0)), Vector3d(0, 0, 0));
    EXPECT_EQ(round_offset(cloud_at({5e5, 4.6e6, 100.0}, 40.0)), Vector3d(5e5, 4.6e6, 0.0));
    EXPECT_EQ(round_offset(cloud_at({5e5, 4.6e6, 100.0}, 1e5)), Vector3d(0.0, 5e6, 0.0));
}

TEST(RoundOffset, LeavesCoordinatesThatFitIntoFloats)
{
    for (const double size : {1e-3, 0.4, 7.0, 300.0, 1e5}) {
        for (double far = 0.1; far < 1e7; far *= 1.7) {
            const Scene scene = cloud_at({far, -far, 0.3 * far}, size);
            const Vector3d offset = round_offset(scene);
            double worst = 0.0;
            for (const Vector3d& position : scene.positions) {
                const Vector3d left = position - offset;
                worst = std::max(worst,
                                 (left - left.cast<float>().cast<double>()).cwiseAbs().maxCoeff());
            }
            EXPECT_LT(worst, 1e-6 * size) << far << " " << size;
        }
    }
}

TEST(RoundOffset, UsesFinitePointsInTheFrameOfTheFile)
{
    Scene scene = cloud_at({23.4, 0.0, 0.0}, 4.0);
    scene.positions[7].x() = std::numeric_limits<double>::quiet_NaN();
    scene.offset = {500100.0, 0.0, 0.0};
    EXPECT_EQ(round_offset(scene), Vector3d(500120.0, 0.0, 0.0));
}

TEST(RoundOffset, IsZeroForModelsWithoutExtent)
{
    EXPECT_EQ(round_offset({}), Vector3d(0, 0, 0));
    EXPECT_EQ(round_offset(make_scene({}, {{{5e5, 0, 0}, {}}, {{5e5, 0, 0}, {}}})),
              Vector3d(0, 0, 0));
}

} // namespace
} // namespace vcarve::extent_test
