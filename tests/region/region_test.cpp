#include "model/extent.h"
#include "region/region.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace vcarve::region_test {
namespace {

using Eigen::Vector3d;

RegionChoice box(const Vector3d& low, const Vector3d& high)
{
    return {.kind = RegionChoice::Kind::box, .low = low, .high = high};
}

TEST(Region, IsNullIfEverythingIsChosen)
{
    EXPECT_EQ(make_region({}, Scene()), nullptr);
}

TEST(BoxRegion, ContainsItsBoundary)
{
    const auto region = make_region(box({0, 0, 0}, {1, 2, 3}), Scene());
    EXPECT_TRUE(region->contains({0.5, 1.0, 1.5}));
    EXPECT_TRUE(region->contains({1, 2, 3}));
    EXPECT_TRUE(region->contains({0, 1, 1}));
    EXPECT_FALSE(region->contains({-1e-300, 1, 1}));
    EXPECT_FALSE(region->contains({0.5, 2.5, 1}));
}

TEST(BoxRegion, MeetsSegmentsThatCrossOrTouchIt)
{
    const auto region = make_region(box({0, 0, 0}, {1, 1, 1}), Scene());
    EXPECT_TRUE(region->meets({-1, 0.5, 0.5}, {2, 0.5, 0.5}));    // across
    EXPECT_TRUE(region->meets({0.5, 0.5, 0.5}, {9, 9, 9}));       // leaves
    EXPECT_TRUE(region->meets({0.2, 0.5, 0.5}, {0.3, 0.5, 0.5})); // inside
    EXPECT_TRUE(region->meets({-1, 1, 0}, {1, -1, 0}));           // touches an edge
    EXPECT_TRUE(region->meets({1, 1, 1}, {1, 1, 1}));             // a corner, zero length
    EXPECT_FALSE(region->meets({2, 1, 1}, {2, 1, 1}));
    EXPECT_FALSE(region->meets({-2, 0.5, 0.5}, {-1, 0.5, 0.5})); // ends in front
    EXPECT_TRUE(region->meets({0, 2, 0.5}, {2, 0, 0.5}));
    EXPECT_FALSE(region->meets({0, 2, 0.5}, {2, 1e-15, 0.5})); // past an edge
}

TEST(BoxRegion, IsInTheFrameOfTheFile)
{
    Scene scene;
    scene.offset = {5e5, 4.6e6, 100};
    const auto region = make_region(box({500001, 4600002, 103}, {500002, 4600003, 104}), scene);
    EXPECT_EQ(region->bounds().min(), Vector3d(1, 2, 3));
    EXPECT_EQ(region->bounds().max(), Vector3d(2, 3, 4));
    EXPECT_TRUE(region->contains({1.5, 2.5, 3.5}));
}

/// A scene with a known region of interest: points on the x axis from -1 to 1, and a distant
/// point.
Scene row_and_far_point()
{
    std::vector<MadePoint> points = {{{1000, 0, 0}, {0, 1}}};
    for (int i = -100; i <= 100; ++i) {
        points.push_back({{0.01 * i, 0, 0}, {0, 1}});
    }
    return make_scene({{0, 0, 10}, {1, 0, 10}}, points);
}

TEST(BallRegion, IsTheRegionOfInterest)
{
    const Scene scene = row_and_far_point();
    const Ball ball = region_of_interest(scene);
    const auto region = make_region({.kind = RegionChoice::Kind::looked_at}, scene);
    EXPECT_LT((region->bounds().center() - ball.center).norm(), 1e-12);
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, -1)}) {
        EXPECT_TRUE(region->contains(ball.center + 0.999 * ball.radius * axis));
        EXPECT_FALSE(region->contains(ball.center + 1.001 * ball.radius * axis));
    }
    EXPECT_FALSE(region->contains(scene.positions[0]));
    std::size_t held = 0;
    for (const Vector3d& position : scene.positions) {
        held += region->contains(position) ? 1 : 0;
    }
    EXPECT_EQ(held, 190U); // at least 94 % of 202, including the point on the boundary
}

TEST(BallRegion, MeetsSegmentsCloserThanItsRadius)
{
    const Scene scene = row_and_far_point();
    const Ball ball = region_of_interest(scene);
    const auto region = make_region({.kind = RegionChoice::Kind::looked_at}, scene);
    const auto at = [&](double x, double y) -> Vector3d {
        return ball.center + ball.radius * Vector3d(x, y, 0);
    };
    EXPECT_TRUE(region->meets(at(-3, 0.999), at(2, 0.999)));
    EXPECT_FALSE(region->meets(at(-3, 1.001), at(2, 1.001)));
    EXPECT_FALSE(region->meets(at(-3, 0), at(-1.001, 0))); // ends in front
    EXPECT_FALSE(region->meets(at(1.001, 0), at(3, 0)));   // begins behind
    EXPECT_TRUE(region->meets(at(0.5, 0), at(0.5, 0)));
}

} // namespace
} // namespace vcarve::region_test
