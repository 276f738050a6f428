#include "io/dense/nearest_grid.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::nearest_grid_test {
namespace {

using Eigen::Vector3d;

/// A view at the origin that looks along z, and a unit square of points at distance 5.
Scene square_before_a_view()
{
    Scene scene = make_scene({Vector3d::Zero()}, {});
    for (int i = 0; i < 400; ++i) {
        const int row = i / 20;
        scene.positions.emplace_back(0.05 * (i % 20) - 0.5, 0.05 * row - 0.5, 5.0);
    }
    return scene;
}

TEST(NearestGrid, SeesPointsInTheImageThatAreNotClearlyBehindAnother)
{
    const Scene scene = square_before_a_view();
    NearestGrid grid(scene.views[0], scene, scene.positions, 1);
    EXPECT_TRUE(grid.sees({0.0, 0.0, 6.0})); // the grid is empty
    for (const Vector3d& position : scene.positions) {
        grid.add(position);
    }
    EXPECT_TRUE(grid.sees({0.0, 0.0, 4.0}));
    EXPECT_TRUE(grid.sees({0.0, 0.0, 5.01}));
    EXPECT_FALSE(grid.sees({0.0, 0.0, 8.0}));
    EXPECT_FALSE(grid.sees({0.0, 0.0, -4.0}));
    EXPECT_FALSE(grid.sees({50.0, 0.0, 5.0}));
}

TEST(NearestGrid, HasSquaresOfAFewPointSpacings)
{
    const Scene scene = square_before_a_view();
    const NearestGrid grid(scene.views[0], scene, scene.positions, 1);
    const double apart = 0.05 / 5.0;
    EXPECT_GT(grid.square_angle(), 2.0 * apart);
    EXPECT_LT(grid.square_angle(), 8.0 * apart);
    // A sample of a quarter of the points gives about the same spacing.
    const NearestGrid from_few(scene.views[0], scene, scene.positions, 4);
    EXPECT_NEAR(from_few.square_angle(), grid.square_angle(), 0.5 * grid.square_angle());
}

TEST(ProjectInto, ReturnsThePixelAndTheDistance)
{
    const Scene scene = square_before_a_view();
    const auto shown = project_into(scene.views[0], scene.cameras[0], {0.3, 0.4, 5.0});
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->place_px, Eigen::Vector2d(320.0 + 500.0 * 0.06, 240.0 + 500.0 * 0.08));
    EXPECT_NEAR(shown->distance, std::sqrt(25.25), 1e-6);
    EXPECT_FALSE(project_into(scene.views[0], scene.cameras[0], {0.0, 0.0, -5.0}));
}

} // namespace
} // namespace vcarve::nearest_grid_test
