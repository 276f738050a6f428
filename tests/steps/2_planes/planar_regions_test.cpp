#include "steps/1_points/arrange.h"
#include "steps/2_planes/planar_regions.h"
#include "support/noisy_ground.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace vcarve::planar_regions_test {
namespace {

using Eigen::Vector3d;
using vcarve::testing::normal_number;

const std::vector<Vector3d> kCenters = {{0, 0, -6}, {1, 0, -6}, {0, 0, 6}, {1, 0, 6}};
const std::vector<std::uint32_t> kBefore = {0, 1};
const std::vector<std::uint32_t> kBehind = {2, 3};

/// A wall across z, with points this spacing apart and at most `noise` off it.
std::vector<MadePoint> wall(double z, double spacing, const std::vector<std::uint32_t>& views,
                            double noise = 0.0)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> off(-1.0, 1.0);
    std::vector<MadePoint> points;
    for (double x = -1.0; x < 1.0; x += spacing) {
        for (double y = -1.0; y < 1.0; y += spacing) {
            points.push_back({{x + 0.2 * spacing * off(random), y + 0.2 * spacing * off(random),
                               z + noise * off(random)},
                              views});
        }
    }
    return points;
}

PlanarRegions regions_of(const Scene& scene)
{
    return planar_regions(scene, {});
}

Scene sorted(std::vector<MadePoint> points, const std::vector<MadePoint>& more = {})
{
    points.insert(points.end(), more.begin(), more.end());
    return spatial_sort(make_scene(kCenters, points));
}

TEST(PlanarRegions, ContainAllPointsOfAWall)
{
    const Scene scene = sorted(wall(0.5, 0.1, kBefore));
    const PlanarRegions found = regions_of(scene);
    ASSERT_EQ(found.regions.size(), 1U);
    const PlanarRegion& region = found.regions[0];
    EXPECT_EQ(region.points.size(), scene.num_points());
    EXPECT_TRUE(std::ranges::is_sorted(region.points));
    EXPECT_NEAR(region.plane.center.z(), 0.5, 1e-12);
    EXPECT_NEAR(region.plane.normal.z(), -1.0, 1e-12) << "towards the views";
    EXPECT_NEAR(region.spacing, 0.1, 0.015);
    ASSERT_EQ(found.spacings.size(), scene.num_points());
}

TEST(PlanarRegions, ContainPointsSeenFromOneSide)
{
    // A thin board, whose sides are closer than its points
    const Scene scene = sorted(wall(-0.005, 0.1, kBefore), wall(0.005, 0.1, kBehind));
    const PlanarRegions found = regions_of(scene);
    ASSERT_EQ(found.regions.size(), 2U);
    for (const PlanarRegion& region : found.regions) {
        const double side = region.plane.normal.z();
        EXPECT_NEAR(std::abs(side), 1.0, 1e-9);
        for (const std::uint32_t point : region.points) {
            EXPECT_EQ(scene.tracks[point][0], side < 0.0 ? 0U : 2U);
        }
    }
}

TEST(PlanarRegions, ExcludePointsOffTheirPlane)
{
    // Half a spacing in front, like a picture on a wall
    const auto picture = wall(0.0, 0.1, kBefore);
    std::vector<MadePoint> points;
    for (MadePoint point : picture) {
        const bool is_picture = std::abs(point.position.x()) < 0.4;
        if (is_picture) point.position.z() = -0.05;
        points.push_back(point);
    }
    const Scene scene = sorted(points);
    const PlanarRegions found = regions_of(scene);
    ASSERT_GE(found.regions.size(), 2U);
    for (const PlanarRegion& region : found.regions) {
        const double z = scene.positions[region.points[0]].z();
        for (const std::uint32_t point : region.points) {
            EXPECT_EQ(scene.positions[point].z(), z);
        }
    }
}

TEST(PlanarRegions, MayBeSlightlyRough)
{
    const auto largest = [](double noise, bool is_dense = false) {
        Scene scene = sorted(wall(0.0, 0.1, kBefore, noise));
        scene.is_dense = is_dense;
        std::size_t most = 0;
        for (const PlanarRegion& region : regions_of(scene).regions) {
            most = std::max(most, region.points.size());
        }
        return static_cast<double>(most) / static_cast<double>(scene.num_points());
    };
    EXPECT_EQ(largest(0.005), 1.0);
    EXPECT_LT(largest(0.08), 0.5);
    EXPECT_LT(largest(0.03), 0.7);
    EXPECT_GT(largest(0.03, true), 0.98) << "dense clouds may have more noise";
}

TEST(PlanarRegions, HaveAtLeastTwelvePoints)
{
    std::vector<MadePoint> points;
    for (int i = 0; i < 13; ++i) {
        const double angle = 2.4 * i;
        points.push_back(
            {{std::sqrt(i) * std::cos(angle), std::sqrt(i) * std::sin(angle), 0.0}, kBefore});
    }
    EXPECT_EQ(regions_of(sorted(points)).regions.size(), 1U);
    points.back().position.z() = 3.0;
    points[11].position.z() = -3.0;
    EXPECT_TRUE(regions_of(sorted(points)).regions.empty());
    points.resize(12);
    EXPECT_TRUE(regions_of(sorted(points)).regions.empty());
}

/// The fraction of points that belong to regions.
double share_in_regions(const Scene& scene)
{
    const PlanarRegions found = regions_of(scene);
    const auto out = std::ranges::count(found.region_of, PlanarRegions::kNone);
    return 1.0 - static_cast<double>(out) / static_cast<double>(scene.num_points());
}

/// Points of a unit ball at distance height() from its center, seen from outside.
template <typename Height>
Scene round_thing(std::size_t count, const Height& height)
{
    const std::vector<Vector3d> centers = {{6, 0, 0},  {-6, 0, 0}, {0, 6, 0},
                                           {0, -6, 0}, {0, 0, 6},  {0, 0, -6}};
    std::vector<MadePoint> points(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 2.0 * random_number(3, 2 * i) - 1.0;
        const double turn = 2.0 * std::acos(-1.0) * random_number(3, 2 * i + 1);
        const double radius = std::sqrt(1.0 - z * z);
        const Vector3d out(radius * std::cos(turn), radius * std::sin(turn), z);
        points[i].position = height(i, out) * out;
        for (std::uint32_t view = 0; view < centers.size(); ++view) {
            if (out.dot(centers[view]) > 2.0) points[i].views.push_back(view);
        }
    }
    return spatial_sort(make_scene(centers, points));
}

TEST(PlanarRegions, AreNotSlicesOfNoise)
{
    // The noise is a third of the spacing of .025.
    const Scene rough = round_thing(20'000, [](std::size_t i, const Vector3d& /*out*/) {
        return 1.0 + 0.008 * normal_number(i);
    });
    EXPECT_LT(share_in_regions(rough), 0.01);
}

TEST(PlanarRegions, AreFoundBesideRoughObjects)
{
    // A rough ball behind a wall.
    std::vector<MadePoint> ball;
    for (std::size_t i = 0; i < 4000; ++i) {
        const Vector3d at(normal_number(3 * i), normal_number(3 * i + 1), normal_number(3 * i + 2));
        ball.push_back({Vector3d(0, 0, 3) + 0.3 * at, kBefore});
    }
    const Scene scene = sorted(wall(0.5, 0.1, kBefore), ball);
    const PlanarRegions found = regions_of(scene);
    ASSERT_FALSE(found.regions.empty());
    EXPECT_NEAR(static_cast<double>(found.regions[0].points.size()), 441.0, 5.0);
    EXPECT_LT(share_in_regions(scene), 0.12);
}

TEST(PlanarRegions, FindTheirNearestPoints)
{
    const Scene scene = sorted(wall(0.5, 0.1, kBefore));
    const PlanarRegions found = regions_of(scene);
    ASSERT_EQ(found.regions.size(), 1U);
    const PlanarRegion& region = found.regions[0];
    for (const Vector3d& place : {Vector3d(0.03, 0.02, 0.5), Vector3d(2, 1, 0)}) {
        std::vector<std::uint32_t> expected = region.points;
        const auto distance = [&](std::uint32_t i) { return (scene.positions[i] - place).norm(); };
        std::ranges::sort(expected, {}, distance);
        expected.resize(3);
        EXPECT_EQ(region.nearest(place, 3), expected);
        const double least = distance(expected[0]);
        EXPECT_TRUE(region.has_point_near(place, 1.001 * least));
        EXPECT_FALSE(region.has_point_near(place, 0.999 * least));
    }
}

TEST(PlanarRegions, FindAllEquallyNearPoints)
{
    std::vector<MadePoint> points;
    for (int i = 0; i < 100; ++i) {
        points.push_back({{0.1 * (i % 10), 0.1 * (i / 10), 0.5}, kBefore});
    }
    const PlanarRegions found = regions_of(sorted(points));
    ASSERT_EQ(found.regions.size(), 1U);
    EXPECT_EQ(found.regions[0].nearest({0.45, 0.45, 0.5}, 2).size(), 4U);
    EXPECT_EQ(found.regions[0].nearest({0.4, 0.4, 0.5}, 1).size(), 1U);
}

TEST(PlanarRegions, ShareNoPoints)
{
    const Scene scene = bumpy_sphere(2000, 8);
    const Scene ordered = spatial_sort(scene);
    std::vector<int> taken(ordered.num_points(), 0);
    for (const PlanarRegion& region : regions_of(ordered).regions) {
        EXPECT_GE(region.points.size(), 12U);
        for (const std::uint32_t point : region.points) {
            EXPECT_EQ(taken[point]++, 0);
        }
    }
}

/// Many small walls, some of which intersect, among random points.
Scene crossing_walls()
{
    std::vector<MadePoint> points = wall(0.5, 0.05, kBefore, 0.004);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        const Vector3d middle(anywhere(random), anywhere(random), anywhere(random));
        const Eigen::AngleAxisd turn(0.5 * anywhere(random), Vector3d::UnitX());
        for (const MadePoint& point : wall(0.0, 0.25, kBefore, 0.01)) {
            points.push_back({middle + 0.3 * (turn * point.position), kBefore});
        }
    }
    for (int i = 0; i < 1000; ++i) {
        points.push_back({{anywhere(random), anywhere(random), anywhere(random)}, kBefore});
    }
    return sorted(std::move(points));
}

TEST(PlanarRegions, AreTheSameForAnyThreadCount)
{
    const Scene scene = crossing_walls();
    const auto found_by = [&](int threads) {
        std::optional<PlanarRegions> found;
        tbb::task_arena(threads).execute([&] { found.emplace(regions_of(scene)); });
        return found->region_of;
    };
    const std::vector<std::uint32_t> by_one = found_by(1);
    EXPECT_GT(std::ranges::count_if(
                  by_one, [](std::uint32_t r) { return r != PlanarRegions::kNone && r > 4; }),
              100);
    for (const int threads : {2, 3, 16}) {
        EXPECT_EQ(found_by(threads), by_one) << threads;
    }
}

} // namespace
} // namespace vcarve::planar_regions_test
