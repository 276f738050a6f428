#include "steps/1_points/arrange.h"
#include "steps/4_visibility/inferred_rays.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vcarve::inferred_rays_test {
namespace {

using Eigen::Vector3d;
using Views = std::vector<std::uint32_t>;

/// Six views side by side at z = -5 that look along z.
Scene views_below()
{
    Scene scene;
    scene.is_dense = true;
    scene.cameras.push_back(square_camera());
    for (std::uint32_t i = 0; i < 6; ++i) {
        scene.views.push_back({.id = i + 1, .camera = 0, .name = "", .center = {0.1 * i, 0, -5}});
    }
    return scene;
}

void add(Scene& scene, const Vector3d& position, const Views& views)
{
    scene.positions.push_back(position);
    scene.colors.push_back({0, 0, 0});
    scene.errors_px.push_back(-1.0);
    scene.point_ids.push_back(scene.num_points() - 1);
    scene.tracks.push_back(views);
}

/// Adds a wall normal to z, with points a tenth apart from x = -2 to `end`. The views `seldom` see
/// every seventh point, and the views `mostly` the others.
void add_wall(Scene& scene, double z, double end, const Views& mostly, const Views& seldom)
{
    int number = 0;
    for (double x = -2.0; x < end; x += 0.1) {
        for (double y = -2.0; y < 2.0; y += 0.1) {
            add(scene, {x, y, z}, ++number % 7 == 0 ? seldom : mostly);
        }
    }
}

std::size_t num_inferred(const Scene& scene)
{
    return inferred_rays(scene).views.size();
}

TEST(InferredRays, AddsViewsThatSawNeighboringPoints)
{
    Scene scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1, 3}, {0});
    scene = spatial_sort(std::move(scene));
    const Tracks inferred = inferred_rays(scene);
    ASSERT_EQ(inferred.size(), scene.num_points());
    for (std::size_t i = 0; i < inferred.size(); ++i) {
        const Views row(inferred[i].begin(), inferred[i].end());
        EXPECT_EQ(row, scene.tracks[i].size() == 1 ? Views({1, 3}) : Views());
    }
}

TEST(InferredRays, AddsViewsToPointsWithFewerThanFive)
{
    Scene scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4});
    EXPECT_EQ(num_inferred(spatial_sort(scene)), 0U);
    scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3});
    EXPECT_GT(num_inferred(spatial_sort(scene)), 100U);
}

TEST(InferredRays, RejectsViewsBehindThePoint)
{
    Scene scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1}, {0});
    scene.normals.assign(scene.num_points(), Eigen::Vector3f(0, 0, 1));
    EXPECT_EQ(num_inferred(spatial_sort(scene)), 0U);
    scene.normals.assign(scene.num_points(), Eigen::Vector3f(0, 0, -1));
    EXPECT_GT(num_inferred(spatial_sort(scene)), 100U);
}

TEST(InferredRays, RejectsViewsThatSawANearerPoint)
{
    // View 0 saw the front wall, and the back wall beyond the end of the front wall.
    Scene scene = views_below();
    add_wall(scene, 0.0, 0.0, {0}, {0});
    const std::size_t front = scene.num_points();
    add_wall(scene, 1.0, 2.0, {1}, {1});
    for (std::size_t i = front; i < scene.num_points(); ++i) {
        if (scene.positions[i].x() > 0.0) scene.tracks.views[i] = 0; // each track has one view
    }
    scene = spatial_sort(std::move(scene));
    const Tracks inferred = inferred_rays(scene);
    std::size_t beside = 0;
    for (std::size_t i = 0; i < inferred.size(); ++i) {
        if (scene.positions[i].z() == 0.0 || inferred[i].empty() || inferred[i][0] != 0) continue;
        EXPECT_GT(scene.positions[i].x(), -0.05) << "behind the front wall";
        ++beside;
    }
    EXPECT_LT(beside, 200U);
}

TEST(InferredRays, RejectsViewsThatSawOnlyFartherPoints)
{
    Scene scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1}, {0, 1});
    for (const double x : {-0.5, 0.0, 0.5}) {
        add(scene, {x, 0.3, -1.0}, {2}); // in front of the wall
    }
    scene = spatial_sort(std::move(scene));
    const Tracks inferred = inferred_rays(scene);
    for (std::size_t i = 0; i < inferred.size(); ++i) {
        EXPECT_TRUE(scene.positions[i].z() > -0.5 || inferred[i].empty());
    }
}

TEST(InferredRays, IgnoresScanners)
{
    Scene scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1}, {0});
    scene.cameras[0].measures_range = true;
    EXPECT_EQ(num_inferred(spatial_sort(scene)), 0U);
}

TEST(InferredRays, IgnoresCamerasWithoutImagesAndAcceptsEmptyScenes)
{
    Scene scene = views_below();
    EXPECT_EQ(inferred_rays(scene).size(), 0U);
    add_wall(scene, 0.0, 2.0, {0, 1}, {0});
    scene.cameras[0].width_px = 0;
    EXPECT_EQ(num_inferred(spatial_sort(scene)), 0U);
}

TEST(InferredRays, DoesNotDependOnTheThreadCount)
{
    Scene scene = views_below();
    add_wall(scene, 0.0, 2.0, {0, 1, 3}, {0});
    scene = spatial_sort(std::move(scene));
    const Tracks several = inferred_rays(scene);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Tracks one = inferred_rays(scene);
    EXPECT_EQ(one.begins, several.begins);
    EXPECT_EQ(one.views, several.views);
}

} // namespace
} // namespace vcarve::inferred_rays_test
