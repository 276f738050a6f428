#include "steps/1_points/stray_points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vcarve::stray_points_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const std::vector<Vector3d> kCenters = {{0, 0, 4}, {0.5, 0, 4}, {0, 0.5, 4}};
const std::vector<std::uint32_t> kTwo = {0, 1};
const std::vector<std::uint32_t> kThree = {0, 1, 2};

/// A square grid of points across the viewing direction, with `half` points on each side of the
/// center.
std::vector<MadePoint> grid(int half, double spacing, double z,
                            const std::vector<std::uint32_t>& views)
{
    std::vector<MadePoint> points;
    for (int i = -half; i <= half; ++i) {
        for (int j = -half; j <= half; ++j) {
            points.push_back({Vector3d(spacing * i, spacing * j, z), views});
        }
    }
    return points;
}

/// A wall in front of the views, and other points.
Scene wall_and(const std::vector<MadePoint>& others)
{
    std::vector<MadePoint> points = grid(20, 0.05, 0.0, kThree);
    points.insert(points.begin() + 7, others.begin(), others.end());
    return make_scene(kCenters, points);
}

std::int64_t num_stray(Scene scene, const FilterOptions& options = {})
{
    return drop_stray_points(scene, options);
}

TEST(StrayPoints, AreIsolatedPointsOfTwoViews)
{
    Scene scene = wall_and({{{0.1, 0, 2}, kTwo}});
    const Scene clean = wall_and({});
    EXPECT_EQ(drop_stray_points(scene, {}), 1);
    EXPECT_EQ(scene.positions, clean.positions);
    EXPECT_EQ(scene.tracks.views, clean.tracks.views);
    EXPECT_EQ(scene.tracks.begins, clean.tracks.begins);
    EXPECT_EQ(scene.point_ids[6], 7U);
    EXPECT_EQ(scene.point_ids[7], 9U);
    EXPECT_EQ(scene.errors_px.size(), scene.num_points());
    EXPECT_EQ(scene.colors.size(), scene.num_points());
}

TEST(StrayPoints, AreKeptIfThreeViewsAgree)
{
    EXPECT_EQ(num_stray(wall_and({{{0.1, 0, 2}, kThree}})), 0);
}

TEST(StrayPoints, AreKeptIfCloseToOthers)
{
    // The isolation is 8 and 21 times that of the wall's points.
    EXPECT_EQ(num_stray(wall_and({{{0.01, 0.01, 0.35}, kTwo}})), 0);
    EXPECT_EQ(num_stray(wall_and({{{0.01, 0.01, 0.85}, kTwo}})), 1);
}

TEST(StrayPoints, HaveALowerLimitIfTheirErrorIsLarge)
{
    Scene scene = wall_and({{{0.01, 0.01, 0.55}, kTwo}}); // 13 times
    EXPECT_EQ(num_stray(scene), 0);
    scene.errors_px[7] = 2.0;
    EXPECT_EQ(num_stray(scene), 1);
    // One error in twenty is as large
    for (std::size_t i = 100; i < 300; ++i) {
        scene.errors_px[i] = 2.0;
    }
    EXPECT_EQ(num_stray(scene), 0);
    scene.errors_px.assign(scene.num_points(), -1.0); // unknown
    EXPECT_EQ(num_stray(scene), 0);
    scene.errors_px[7] = 0.5; // the largest of the known errors
    EXPECT_EQ(num_stray(scene), 0);
}

TEST(StrayPoints, HaveAHigherLimitIfTheirErrorIsSmall)
{
    Scene scene = wall_and({{{0.01, 0.01, 0.85}, kTwo}}); // 21 times
    scene.errors_px[7] = 0.49;
    EXPECT_EQ(num_stray(scene), 0);
    Scene farther = wall_and({{{0.01, 0.01, 1.4}, kTwo}}); // 43 times
    farther.errors_px[7] = 0.49;
    EXPECT_EQ(num_stray(farther), 1);
}

TEST(StrayPoints, AreKeptInACrowd)
{
    std::vector<MadePoint> crowd;
    for (int i = 0; i < 4; ++i) {
        crowd.push_back({{0.1 + 0.02 * i, 0, 2}, kTwo});
    }
    EXPECT_EQ(num_stray(wall_and(crowd)), 4);
    crowd.push_back({{0.1, 0.02, 2}, kTwo});
    EXPECT_EQ(num_stray(wall_and(crowd)), 0);
}

TEST(StrayPoints, DoNotIncludeABackgroundAsDenseInTheImages)
{
    EXPECT_EQ(num_stray(wall_and(grid(2, 5.0, -396.0, kTwo))), 0);
    // Closer to the views, the same points are far apart in the images.
    EXPECT_EQ(num_stray(wall_and(grid(2, 5.0, -4.0, kTwo))), 25);
}

TEST(StrayPoints, AreKeptIfAScannerMeasuredThem)
{
    Scene scene = wall_and({{{0.1, 0, 2}, {1}}});
    EXPECT_EQ(num_stray(scene), 1);
    scene.cameras.push_back(scene.cameras[0]);
    scene.cameras[1].measures_range = true;
    scene.views[1].camera = 1;
    EXPECT_EQ(num_stray(scene), 0);
}

TEST(StrayPoints, AreKeptIfDisabledOrIfPointsAreFew)
{
    FilterOptions options;
    options.stray_spacing = 0.0;
    EXPECT_EQ(num_stray(wall_and({{{0.1, 0, 2}, kTwo}}), options), 0);
    std::vector<MadePoint> few;
    for (int i = 0; i < 4; ++i) {
        few.push_back({{std::pow(10.0, i), 0, 0}, kTwo});
        EXPECT_EQ(num_stray(make_scene(kCenters, few)), 0);
    }
}

TEST(StrayPoints, IncludeAPointAtACameraCenter)
{
    EXPECT_EQ(num_stray(wall_and({{kCenters[0], kTwo}})), 1);
}

TEST(StrayPoints, DoNotDependOnTheUnit)
{
    std::vector<MadePoint> stray;
    for (int i = 0; i < 40; ++i) {
        stray.push_back({{0.3 * std::cos(i), 0.3 * std::sin(i), 3.9 - 0.05 * i}, kTwo});
    }
    const Scene scene = wall_and(stray);
    const std::int64_t count = num_stray(scene);
    EXPECT_GT(count, 10);
    for (int i = 1; i < 20; ++i) {
        const double scale = std::pow(1.37, i);
        EXPECT_EQ(num_stray(moved(scene, scale, Quaterniond::Identity(), Vector3d::Zero())), count);
    }
}

} // namespace
} // namespace vcarve::stray_points_test
