#include "steps/1_points/spatial_sort.h"
#include "steps/2_planes/added_points.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve::added_points_test {
namespace {

using Eigen::Vector3d;
using namespace flat_scenes;

/// On creases alone.
const AddedPointOptions kOnCreases = {.border_gap = 0.0, .textureless_step = 0.0};

std::int64_t num_added(Scene scene, const AddedPointOptions& options = kOnCreases)
{
    return add_points(scene, options).added;
}

TEST(AddPoints, LeavesTheModelsPointsAsTheyAre)
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

TEST(AddPoints, GivesThemTheColourAndTheErrorOfPointsBesideThem)
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

TEST(AddPoints, AddsThemToDenseClouds)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    const std::int64_t of_model = num_added(scene);
    scene.is_dense = true;
    EXPECT_EQ(num_added(scene), of_model);
}

TEST(AddPoints, AddsNoneToScans)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    scene.cameras.front().measures_range = true;
    EXPECT_EQ(num_added(scene), 0);
}

TEST(AddPoints, AddsNoneWherePointsAre)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    const std::int64_t first = add_points(scene, kOnCreases).added;
    EXPECT_GT(first, 20);
    EXPECT_LE(num_added(scene), first / 10);
}

TEST(AddPoints, AddsTheSameForAnyNumberOfThreads)
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

} // namespace
} // namespace vcarve::added_points_test
