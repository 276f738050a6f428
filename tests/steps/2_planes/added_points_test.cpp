#include "geometry/predicates.h"
#include "steps/1_points/arrange.h"
#include "steps/2_planes/added_points.h"
#include "support/flat_scenes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace vcarve::added_points_test {
namespace {

using Eigen::Vector3d;

using namespace flat_scenes;

/// Adds points only on creases.
const AddedPointOptions kOnCreases = {.border_gap = 0.0, .textureless_step = 0.0};

std::int64_t num_added(Scene scene, const AddedPointOptions& options = kOnCreases)
{
    return add_points(scene, options).added;
}

TEST(AddPoints, KeepsExistingPoints)
{
    const Scene before = together({wall(0.35), ground(0.35)});
    Scene scene = before;
    add_points(scene, kOnCreases);
    EXPECT_EQ(spatial_sort(scene).positions, scene.positions);
    std::size_t kept = 0;
    for (std::size_t old = 0; old < before.num_points(); ++old) {
        const auto at = std::ranges::find(scene.point_ids, before.point_ids[old]);
        ASSERT_NE(at, scene.point_ids.end());
        const auto now = static_cast<std::size_t>(at - scene.point_ids.begin());
        kept += scene.positions[now] == before.positions[old] &&
                scene.colors[now] == before.colors[old];
    }
    EXPECT_EQ(kept, before.num_points());
}

TEST(AddPoints, UsesTheColorAndErrorOfPointsBesideThem)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const bool is_left = scene.positions[i].x() < 0.0;
        scene.colors[i] = is_left ? Color{255, 0, 0} : Color{0, 255, 0};
        scene.errors_px[i] = is_left ? 0.25 : 0.75;
    }
    add_points(scene, kOnCreases);
    for (const std::size_t i : points_of_kind(scene, PointKind::crease)) {
        if (std::abs(scene.positions[i].x()) < 3 * kSpacing) continue;
        const bool is_left = scene.positions[i].x() < 0.0;
        EXPECT_EQ(scene.colors[i], (is_left ? Color{255, 0, 0} : Color{0, 255, 0}));
        EXPECT_EQ(scene.errors_px[i], is_left ? 0.25 : 0.75);
    }
}

TEST(AddPoints, AddsPointsToDenseClouds)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    const std::int64_t of_model = num_added(scene);
    scene.is_dense = true;
    EXPECT_EQ(num_added(scene), of_model);
}

TEST(AddPoints, AddsNoPointsToScans)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    scene.cameras.front().measures_range = true;
    EXPECT_EQ(num_added(scene), 0);
}

TEST(AddPoints, AddsFewPointsInASecondRun)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    const std::int64_t first = add_points(scene, kOnCreases).added;
    EXPECT_GT(first, 20);
    EXPECT_LE(num_added(scene), first / 10);
}

TEST(AddPoints, AddsTheSamePointsForAnyThreadCount)
{
    Scene several = together({wall(0.35), ground(0.35)});
    Scene one = several;
    add_points(several, {});
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    add_points(one, {});
    EXPECT_EQ(one.positions, several.positions);
    EXPECT_EQ(one.tracks.views, several.tracks.views);
    EXPECT_EQ(one.point_ids, several.point_ids);
}

using namespace flat_scenes;

/// A wall in the plane z = 0, without points around its center.
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

/// The accepted candidates on the largest planar region of a scene.
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

TEST(Accept, AcceptsAGapOfARegionWithTheViewsOfTheNearestPoints)
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

TEST(Accept, RejectsCandidatesAtPoints)
{
    const Scene scene = together({wall_with_gap()});
    const Vector3d& at = scene.positions[scene.num_points() / 2];
    EXPECT_TRUE(accepted(scene, {on_wall(at.x() + 0.2 * kSpacing, at.y())}).empty());
}

TEST(Accept, RejectsCandidatesAmongPointsOfOtherObjects)
{
    std::vector<MadePoint> thing;
    for (int i = 0; i < 4; ++i) {
        thing.push_back({{0.1 * (i % 2), 0.1 * (i / 2), -0.06 - 0.01 * i}, kAll});
    }
    const Candidate amid = on_wall(0.05, 0.05);
    EXPECT_TRUE(accepted(together({wall_with_gap(), thing}), {amid}).empty());
    thing.pop_back(); // five of eight belong to the wall
    EXPECT_EQ(accepted(together({wall_with_gap(), thing}), {amid}).size(), 1U);
}

TEST(Accept, RequiresTwoViews)
{
    EXPECT_TRUE(accepted(together({wall_with_gap({1})}), {on_wall(0, 0)}).empty());
    EXPECT_EQ(accepted(together({wall_with_gap({0, 1})}), {on_wall(0, 0)}).size(), 1U);
}

TEST(Accept, IgnoresViewsBehindThePlane)
{
    std::vector<Vector3d> centers = kCenters;
    centers.emplace_back(0.0, 0.0, 1.0);
    const Scene scene = together({wall_with_gap({0, 1, 2, 3})}, centers);
    const std::vector<AcceptedPoint> points = accepted(scene, {on_wall(0, 0)});
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].track, kAll);
}

TEST(Accept, RejectsCandidatesWithAsManyRaysThroughTheirSurfaceAsViews)
{
    Candidate candidate = on_wall(0, 0);
    candidate.surface = {{Vector3d(-0.2, -0.2, 0), Vector3d(0.2, -0.2, 0), Vector3d(0, 0.3, 0)}};
    // Views see a point right behind the candidate through the surface.
    const auto num_accepted = [&](const Views& views) {
        return accepted(together({wall_with_gap(), {{{0, 0, 0.5}, views}}}), {candidate}).size();
    };
    EXPECT_EQ(num_accepted({0, 1}), 1U);
    EXPECT_EQ(num_accepted({0, 1, 2}), 0U);
    candidate.surface.clear();
    EXPECT_EQ(num_accepted({0, 1, 2}), 1U);
}

TEST(Accept, AcceptsTheFirstOfCloseCandidates)
{
    const Scene scene = together({wall_with_gap()});
    const std::vector<AcceptedPoint> points =
        accepted(scene, {on_wall(0, 0), on_wall(0.04, 0), on_wall(0.08, 0)});
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].candidate.position.x(), 0.0);
    EXPECT_EQ(points[1].candidate.position.x(), 0.08);
}

using Triangle = std::array<Vector3d, 3>;
using Counts = std::vector<std::uint32_t>;

/// A triangle around the z axis, at height `z`.
Triangle across(double z)
{
    return {Vector3d(-1.0, -1.0, z), Vector3d(2.0, -1.0, z), Vector3d(-1.0, 2.0, z)};
}

/// Points at height 0 near the axis, seen by a view at height 10.
Scene upward(int points)
{
    std::vector<MadePoint> made;
    for (int i = 0; i < points; ++i) {
        made.push_back({{0.01 * i, 0.0, 0.0}, {0}});
    }
    return make_scene({{0.0, 0.0, 10.0}}, made);
}

Counts count(const Scene& scene, const std::vector<Triangle>& triangles, double margin)
{
    return rays_through(scene, triangles, std::vector<double>(scene.num_points(), margin), {});
}

TEST(RaysThrough, AreCountedIfTheyMeetTheTriangle)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const auto anywhere = [&] {
        const double x = place(random);
        const double y = place(random);
        return Vector3d(x, y, place(random));
    };
    std::vector<MadePoint> points(200);
    for (MadePoint& point : points) {
        point = {anywhere(), {0, 1, 2}};
    }
    const Scene scene = make_scene({anywhere(), anywhere(), anywhere()}, points);
    std::vector<Triangle> triangles(20);
    for (Triangle& triangle : triangles) {
        triangle = {anywhere(), anywhere(), anywhere()};
    }
    Counts expected(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t point = 0; point < scene.num_points(); ++point) {
            for (const View& view : scene.views) {
                expected[i] +=
                    meets_triangle(scene.positions[point], view.center, triangles[i]) ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(count(scene, triangles, 0.0), expected);
    EXPECT_GT(*std::ranges::max_element(expected), 20U);
}

TEST(RaysThrough, OmitTheMarginAtTheirPoints)
{
    const std::vector<Triangle> triangles = {across(0.5), across(1.5), across(4.5), across(5.5)};
    EXPECT_EQ(count(upward(3), triangles, 1.0), Counts({0, 3, 3, 3}));
    // at most half of the ray
    EXPECT_EQ(count(upward(3), triangles, 100.0), Counts({0, 0, 0, 3}));
}

TEST(RaysThrough, AreCountedFromOneInThreeInADenseCloud)
{
    Scene scene = upward(7);
    scene.is_dense = true;
    EXPECT_EQ(count(scene, {across(5.0)}, 0.0), Counts({9})) << "rays of the points 0, 3 and 6";
}

TEST(RaysThrough, DoNotIncludeAPointAtItsView)
{
    const Scene scene = make_scene({{0.0, 0.0, 0.0}}, {{{0.0, 0.0, 0.0}, {0}}});
    EXPECT_EQ(count(scene, {across(0.0)}, 0.0), Counts({0}));
    EXPECT_EQ(count(scene, {}, 0.0), Counts());
}

} // namespace
} // namespace vcarve::added_points_test
