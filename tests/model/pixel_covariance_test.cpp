#include "model/pixel_covariance.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <vector>

namespace vcarve::pixel_covariance_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d covariance(const Scene& scene)
{
    return covariance_of_a_pixel(scene, 0, std::vector<double>(scene.cameras.size(), 100.0));
}

TEST(PixelCovariance, IsTheInverseOfWhatTheSightsSay)
{
    // Pixels of .1 across x from the first view, of .2 across y from the second.
    const Scene scene = make_scene({{10, 0, 0}, {0, 20, 0}}, {{{0, 0, 0}, {0, 1}}});
    const Matrix3d expected = Vector3d(1.0 / 25, 1.0 / 100, 1.0 / 125).asDiagonal();
    EXPECT_TRUE(covariance(scene).isApprox(expected, 1e-12)) << covariance(scene);
}

TEST(PixelCovariance, IsZeroWhereSightsDoNotCross)
{
    const Scene scene = make_scene({{10, 0, 0}, {20, 0, 0}}, {{{0, 0, 0}, {0, 1}}});
    EXPECT_EQ(covariance(scene), Matrix3d(Matrix3d::Zero()));
}

TEST(PixelCovariance, OfAScannerIsThatOfAPixelInRangeToo)
{
    Scene scene = make_scene({{10, 0, 0}}, {{{0, 0, 0}, {0}}});
    for (Camera& camera : scene.cameras) {
        camera.measures_range = true;
    }
    EXPECT_TRUE(covariance(scene).isApprox(0.01 * Matrix3d::Identity(), 1e-12));
}

TEST(PixelCovariance, DoesNotDependOnTheOrderOfViews)
{
    const std::vector<Vector3d> centers = {{10, 1, 0.3}, {0.7, 20, 3}, {-3, 0.1, 7}};
    const Scene scene = make_scene(centers, {{{0.1, 0.2, 0.3}, {0, 1, 2}}});
    const Scene other =
        make_scene({centers[2], centers[0], centers[1]}, {{{0.1, 0.2, 0.3}, {0, 1, 2}}});
    EXPECT_EQ(covariance(scene), covariance(other));
}

} // namespace
} // namespace vcarve::pixel_covariance_test
