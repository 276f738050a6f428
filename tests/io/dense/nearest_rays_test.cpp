#include "io/dense/nearest_grid.h"
#include "io/dense/nearest_rays.h"
#include "support/scene_checks.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace vcarve::nearest_rays_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Adds a grid of 41 x 41 points, 4 x 4 units wide, at height z.
void add_square(Scene& scene, double z)
{
    for (int row = 0; row <= 40; ++row) {
        for (int column = 0; column <= 40; ++column) {
            scene.positions.emplace_back(0.1 * column - 2.0, 0.1 * row - 2.0, z);
        }
    }
}

/// Two squares, at heights 0 and 1, and views that look at them from below and from above.
Scene two_squares()
{
    Scene scene;
    scene.is_dense = true;
    scene.cameras.push_back(square_camera());
    const Eigen::Quaterniond up = Eigen::Quaterniond::Identity();
    const Eigen::Quaterniond down(0, 1, 0, 0);
    scene.views.push_back(
        {.id = 1, .camera = 0, .name = "", .cam_from_world = up, .center = {0, 0, -5}});
    scene.views.push_back(
        {.id = 2, .camera = 0, .name = "", .cam_from_world = down, .center = {0, 0, 6}});
    scene.views.push_back(
        {.id = 3, .camera = 0, .name = "", .cam_from_world = down, .center = {0.2, 0, 6.5}});
    add_square(scene, 0.0);
    add_square(scene, 1.0);
    return scene;
}

std::vector<std::uint32_t> row(const Tracks& tracks, std::size_t point)
{
    return {tracks[point].begin(), tracks[point].end()};
}

/// The same rule by brute force: every view has a grid of all points.
std::vector<std::uint32_t>
rays_by_asking_all(const Scene& scene, const std::vector<NearestGrid>& grids, const Vector3d& place)
{
    std::vector<std::uint32_t> order(scene.views.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(
        order, {}, [&](std::uint32_t view) { return (scene.views[view].center - place).norm(); });
    std::vector<std::uint32_t> row;
    std::size_t shown = 0;
    for (const std::uint32_t view : order) {
        if (!project_into(scene.views[view], scene.cameras[0], place)) continue;
        if (++shown > 32 || row.size() == kMostNearestViews) break;
        if (grids[view].sees(place)) row.push_back(view);
    }
    std::ranges::sort(row);
    return row;
}

std::vector<NearestGrid> grids_of_all_points(const Scene& scene)
{
    std::vector<NearestGrid> grids;
    for (const View& view : scene.views) {
        grids.emplace_back(view, scene, scene.positions, 1);
        for (const Vector3d& position : scene.positions) {
            grids.back().add(position);
        }
    }
    return grids;
}

/// A bumpy sphere, and views around it that look at it or past it.
Scene ball_among_views(std::size_t num_views)
{
    Scene scene = bumpy_sphere(3000, 5);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto anywhere = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
    scene.views.resize(1);
    scene.views.resize(num_views, scene.views.front());
    for (View& view : scene.views) {
        view.center = (3.0 + std::abs(normal(random))) * anywhere().normalized();
        const Vector3d ahead = anywhere() - view.center;
        view.cam_from_world = Eigen::Quaterniond::FromTwoVectors(ahead, Vector3d::UnitZ());
    }
    return scene;
}

TEST(NearestRays, MatchThoseOfBruteForce)
{
    for (const std::size_t num_views : {5U, 60U, 500U}) {
        const Scene scene = ball_among_views(num_views);
        const std::vector<NearestGrid> grids = grids_of_all_points(scene);
        const Tracks tracks = nearest_rays(scene);
        for (std::size_t i = 0; i < scene.num_points(); ++i) {
            ASSERT_EQ(row(tracks, i), rays_by_asking_all(scene, grids, scene.positions[i]))
                << i << " of " << num_views << " views";
        }
    }
}

TEST(NearestRays, DoNotPassThroughAnotherSurface)
{
    const Scene scene = two_squares();
    const Tracks tracks = nearest_rays(scene);
    ASSERT_EQ(tracks.size(), 2U * 41 * 41);
    // Points near the rim of the rear square are visible beside the front square.
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (scene.positions[i].head<2>().cwiseAbs().maxCoeff() > 1.5) continue;
        if (scene.positions[i].z() == 0.0) {
            EXPECT_THAT(row(tracks, i), ElementsAre(0)) << i;
        } else {
            EXPECT_THAT(row(tracks, i), ElementsAre(1, 2)) << i;
        }
    }
}

TEST(NearestRays, PassFewerGapsOfSparsePoints)
{
    // The upper square is half way to its views. It keeps every second row and column.
    Scene scene = two_squares();
    scene.positions.clear();
    add_square(scene, 0.0);
    add_square(scene, 3.0);
    std::vector<Vector3d> left;
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const std::size_t row = i % 1681 / 41;
        const std::size_t column = i % 41;
        if (i < 1681 || (row % 2 == 0 && column % 2 == 0)) left.push_back(scene.positions[i]);
    }
    scene.positions = left;
    const auto seen_through = [&](bool is_dense) {
        scene.is_dense = is_dense;
        const Tracks tracks = nearest_rays(scene);
        int count = 0;
        for (std::size_t i = 0; i < 1681; ++i) {
            count += tracks[i].size() > 1 ? 1 : 0;
        }
        return count;
    };
    EXPECT_LT(seen_through(false), seen_through(true) / 2);
}

TEST(NearestRays, ReachAllPointsOfAnObliqueSurface)
{
    Scene scene = two_squares();
    scene.positions.clear();
    add_square(scene, 0.0);
    const Eigen::AngleAxisd turn(60.0 / 180.0 * M_PI, Vector3d::UnitX());
    for (Vector3d& position : scene.positions) {
        position = turn * position;
    }
    const Tracks tracks = nearest_rays(scene);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        EXPECT_THAT(row(tracks, i), ElementsAre(0, 1, 2)) << i;
    }
}

TEST(NearestRays, BelongToViewsWithThePointInTheImage)
{
    Scene scene = two_squares();
    scene.positions = {{0, 0, 0}, {0, 0, 5.5}, {40, 0, 0}, {0, 0, 7}};
    const Tracks tracks = nearest_rays(scene);
    EXPECT_THAT(row(tracks, 2), IsEmpty());
    EXPECT_THAT(row(tracks, 3), ElementsAre(0)); // behind the two views that look down
}

TEST(NearestRays, BelongToTheNearestViews)
{
    Scene scene = two_squares();
    scene.positions = {{0, 0, 0}};
    scene.views.resize(1);
    for (std::uint32_t i = 1; i < 12; ++i) {
        scene.views.push_back(scene.views.front());
        scene.views.back().id = i + 1;
        scene.views.back().center = {0, 0, i % 2 == 0 ? -5.0 - i : -5.0 + 0.1 * i};
    }
    // Distances are 5 - 0.1 i for odd i, 5 + i for even i. Views 1 3 5 7 9 11 0 2 are nearest.
    EXPECT_THAT(row(nearest_rays(scene), 0), ElementsAre(0, 1, 2, 3, 5, 7, 9, 11));
}

TEST(NearestRays, SkipPointsThatAreNotFiniteAndCamerasWithoutSize)
{
    Scene scene = two_squares();
    scene.positions = {{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
    EXPECT_THAT(row(nearest_rays(scene), 1), IsEmpty());
    scene.cameras.front().width_px = 0;
    EXPECT_THAT(nearest_rays(scene).views, IsEmpty());
    // An absurd image size does not allocate memory of that size.
    scene.cameras.front().width_px = std::uint64_t{1} << 62;
    EXPECT_EQ(nearest_rays(scene).size(), 2U);
    scene.views.clear();
    EXPECT_EQ(nearest_rays(scene).size(), 2U);
}

} // namespace
} // namespace vcarve::nearest_rays_test
