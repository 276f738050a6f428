#include "model/views.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace vcarve::views_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A scene of views with the given rotations, without points.
Scene turned(const std::vector<Quaterniond>& poses)
{
    Scene scene = make_scene(std::vector<Vector3d>(poses.size(), Vector3d::Zero()), {});
    for (std::size_t i = 0; i < poses.size(); ++i) {
        scene.views[i].cam_from_world = poses[i];
    }
    return scene;
}

Quaterniond around(const Vector3d& axis, double degrees)
{
    return Quaterniond(AngleAxisd(degrees * std::numbers::pi / 180.0, axis));
}

TEST(UpOf, IsTheMeanUpwardDirectionOfCameras)
{
    EXPECT_LT((up_of(turned({Quaterniond::Identity()})) - Vector3d(0, -1, 0)).norm(), 1e-12);
    const Scene tilted = turned({around(Vector3d::UnitX(), 30), around(Vector3d::UnitX(), -30)});
    EXPECT_LT((up_of(tilted) - Vector3d(0, -1, 0)).norm(), 1e-12);
}

TEST(UpOf, IsTheBackwardDirectionIfUpwardDirectionsCancelOut)
{
    const Scene down = turned({Quaterniond::Identity(), around(Vector3d::UnitZ(), 180)});
    EXPECT_LT((up_of(down) - Vector3d(0, 0, -1)).norm(), 1e-12);
}

TEST(UpOf, IsZForLaserScans)
{
    Scene scan = turned({around(Vector3d::UnitX(), 50)});
    for (Camera& camera : scan.cameras) {
        camera.measures_range = true;
    }
    EXPECT_EQ(up_of(scan), Vector3d::UnitZ());
}

TEST(LookOneWay, IsTrueForCamerasWithinAFewDegrees)
{
    const auto fan = [](double degrees) {
        return turned({around(Vector3d::UnitX(), degrees), around(Vector3d::UnitX(), -degrees)});
    };
    EXPECT_TRUE(look_in_one_direction(fan(10)));
    EXPECT_FALSE(look_in_one_direction(fan(20)));
    Scene scan = fan(0);
    for (Camera& camera : scan.cameras) {
        camera.measures_range = true;
    }
    EXPECT_FALSE(look_in_one_direction(scan)) << "scanners look in all directions";
}

TEST(PixelGrid, HasNearlySquareCells)
{
    Camera camera;
    camera.width_px = 400;
    camera.height_px = 200;
    const std::vector<Eigen::Vector2d> pixels = pixel_grid(camera, 8);
    const std::vector<Eigen::Vector2d> expected = {{50, 50},  {150, 50},  {250, 50},  {350, 50},
                                                   {50, 150}, {150, 150}, {250, 150}, {350, 150}};
    EXPECT_EQ(pixels, expected);
    EXPECT_EQ(pixel_grid(camera, 1).size(), 1U);
    camera.height_px = 0;
    EXPECT_TRUE(pixel_grid(camera, 8).empty());
}

Matrix3d covariance(const Scene& scene)
{
    return covariance_of_a_pixel(scene, 0, std::vector<double>(scene.cameras.size(), 100.0));
}

TEST(PixelCovariance, IsTheInverseOfTheInformationOfRays)
{
    // A pixel of the first view covers .1 perpendicular to x, of the second .2 perpendicular to y.
    const Scene scene = make_scene({{10, 0, 0}, {0, 20, 0}}, {{{0, 0, 0}, {0, 1}}});
    const Matrix3d expected = Vector3d(1.0 / 25, 1.0 / 100, 1.0 / 125).asDiagonal();
    EXPECT_TRUE(covariance(scene).isApprox(expected, 1e-12)) << covariance(scene);
}

TEST(PixelCovariance, IsZeroIfRaysDoNotCross)
{
    const Scene scene = make_scene({{10, 0, 0}, {20, 0, 0}}, {{{0, 0, 0}, {0, 1}}});
    EXPECT_EQ(covariance(scene), Matrix3d(Matrix3d::Zero()));
}

TEST(PixelCovariance, IncludesTheRangeErrorOfScanners)
{
    Scene scene = make_scene({{10, 0, 0}}, {{{0, 0, 0}, {0}}});
    for (Camera& camera : scene.cameras) {
        camera.measures_range = true;
    }
    EXPECT_TRUE(covariance(scene).isApprox(0.01 * Matrix3d::Identity(), 1e-12));
}

TEST(PixelCovariance, DoesNotDependOnOrderOfViews)
{
    const std::vector<Vector3d> centers = {{10, 1, 0.3}, {0.7, 20, 3}, {-3, 0.1, 7}};
    const Scene scene = make_scene(centers, {{{0.1, 0.2, 0.3}, {0, 1, 2}}});
    const Scene other =
        make_scene({centers[2], centers[0], centers[1]}, {{{0.1, 0.2, 0.3}, {0, 1, 2}}});
    EXPECT_EQ(covariance(scene), covariance(other));
}

} // namespace
} // namespace vcarve::views_test
