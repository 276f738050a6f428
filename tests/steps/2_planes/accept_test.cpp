#include "steps/2_planes/accept.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vcarve::accept_test {
namespace {

using Eigen::Vector3d;
using namespace flat_scenes;

/// A wall across z without points around its middle.
std::vector<MadePoint> wall_with_gap(const Views& views = kAll)
{
    std::vector<MadePoint> points = flat({-1.0, -1.0}, {1.0, 1.0}, views,
                                         [](double u, double v) { return Vector3d(u, v, 0.0); });
    std::erase_if(points, [](const MadePoint& point) { return point.position.norm() < 0.25; });
    return points;
}

Candidate on_wall(double x, double y)
{
    return {.position = {x, y, 0.0}, .kind = PointKind::border, .step = kSpacing};
}

/// What is accepted on the largest planar region of a scene.
std::vector<AcceptedPoint> accepted(const Scene& scene, std::vector<Candidate> candidates)
{
    const PlanarRegions planes = planar_regions(scene, {});
    EXPECT_FALSE(planes.regions.empty());
    const auto largest = std::ranges::max_element(
        planes.regions, {}, [](const PlanarRegion& region) { return region.points.size(); });
    const auto number = static_cast<std::uint32_t>(largest - planes.regions.begin());
    for (Candidate& candidate : candidates) {
        candidate.regions = {number, number};
    }
    return accept(scene, planes, std::move(candidates), {});
}

TEST(Accept, TakesAPlaceAmidItsRegionWithTheViewsOfTheNearestPoints)
{
    const Scene scene = together({wall_with_gap()});
    const std::vector<AcceptedPoint> points = accepted(scene, {on_wall(0.02, 0.03)});
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].track, kAll);
    std::vector<std::uint32_t> nearest(scene.num_points());
    for (std::uint32_t i = 0; i < nearest.size(); ++i) {
        nearest[i] = i;
    }
    std::ranges::sort(nearest, {}, [&](std::uint32_t i) {
        return (scene.positions[i] - points[0].candidate.position).norm();
    });
    nearest.resize(2);
    EXPECT_EQ(points[0].beside, nearest);
}

TEST(Accept, TakesNoPlaceAtAPoint)
{
    const Scene scene = together({wall_with_gap()});
    const Vector3d& at = scene.positions[scene.num_points() / 2];
    EXPECT_TRUE(accepted(scene, {on_wall(at.x() + 0.2 * kSpacing, at.y())}).empty());
}

TEST(Accept, TakesNoPlaceAmidOtherThings)
{
    std::vector<MadePoint> thing;
    for (int i = 0; i < 4; ++i) {
        thing.push_back({{0.1 * (i % 2), 0.1 * (i / 2), -0.06 - 0.01 * i}, kAll});
    }
    const Candidate amid = on_wall(0.05, 0.05);
    EXPECT_TRUE(accepted(together({wall_with_gap(), thing}), {amid}).empty());
    thing.pop_back(); // five of eight are the wall's
    EXPECT_EQ(accepted(together({wall_with_gap(), thing}), {amid}).size(), 1U);
}

TEST(Accept, NeedsTwoViews)
{
    EXPECT_TRUE(accepted(together({wall_with_gap({1})}), {on_wall(0, 0)}).empty());
    EXPECT_EQ(accepted(together({wall_with_gap({0, 1})}), {on_wall(0, 0)}).size(), 1U);
}

TEST(Accept, AsksNoViewBehindThePlane)
{
    std::vector<Vector3d> centers = kCenters;
    centers.emplace_back(0.0, 0.0, 1.0);
    const Scene scene = together({wall_with_gap({0, 1, 2, 3})}, centers);
    const std::vector<AcceptedPoint> points = accepted(scene, {on_wall(0, 0)});
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].track, kAll);
}

TEST(Accept, TakesNoPlaceThroughWhoseSurfaceAsManySightsPassAsSeeIt)
{
    Candidate candidate = on_wall(0, 0);
    candidate.surface = {{Vector3d(-0.2, -0.2, 0), Vector3d(0.2, -0.2, 0), Vector3d(0, 0.3, 0)}};
    // A point right behind the place, at which the views look through the surface.
    const auto num_accepted = [&](const Views& views) {
        return accepted(together({wall_with_gap(), {{{0, 0, 0.5}, views}}}), {candidate}).size();
    };
    EXPECT_EQ(num_accepted({0, 1}), 1U);
    EXPECT_EQ(num_accepted({0, 1, 2}), 0U);
    candidate.surface.clear();
    EXPECT_EQ(num_accepted({0, 1, 2}), 1U);
}

TEST(Accept, TakesTheFirstOfPlacesThatAreCloseToEachOther)
{
    const Scene scene = together({wall_with_gap()});
    const std::vector<AcceptedPoint> points =
        accepted(scene, {on_wall(0, 0), on_wall(0.04, 0), on_wall(0.08, 0)});
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].candidate.position.x(), 0.0);
    EXPECT_EQ(points[1].candidate.position.x(), 0.08);
}

} // namespace
} // namespace vcarve::accept_test
