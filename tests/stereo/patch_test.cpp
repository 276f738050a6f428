#include "stereo/patch.h"
#include "support/stereo_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::patch_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

float bilinear(const GrayImage& image, double x, double y)
{
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const double right = x - column;
    const double down = y - row;
    return static_cast<float>(
        (1 - down) * ((1 - right) * image.at(column, row) + right * image.at(column + 1, row)) +
        down * ((1 - right) * image.at(column, row + 1) + right * image.at(column + 1, row + 1)));
}

/// The cost by its definition: projects every sample to the plane and to the source.
double exact_cost(const StereoView& reference, const StereoView& source, const Patch& patch,
                  const Eigen::Vector2d& center, const PixelPlane& plane)
{
    const Vector3d normal = plane.normal.cast<double>();
    const auto ray = [&](double x, double y) -> Vector3d {
        return reference.camera.ray(static_cast<float>(x), static_cast<float>(y)).cast<double>();
    };
    const double distance = plane.depth * normal.dot(ray(center.x(), center.y()));
    double sum = 0.0;
    double square = 0.0;
    double product = 0.0;
    for (int k = 0; k < Patch::kSide * Patch::kSide; ++k) {
        const Vector3d towards =
            ray(center.x() + Patch::kStepPx * (k % Patch::kSide - Patch::kRadius),
                center.y() + Patch::kStepPx * (k / Patch::kSide - Patch::kRadius));
        const Vector3d place =
            reference.center + distance / normal.dot(towards) * towards - source.center;
        const double value = bilinear(
            source.image,
            source.camera.focal_px * place.x() / place.z() + source.camera.principal_px.x(),
            source.camera.focal_px * place.y() / place.z() + source.camera.principal_px.y());
        sum += patch.weights()[k] * value;
        square += patch.weights()[k] * value * value;
        product += patch.differences()[k] * value;
    }
    return 1.0 - product / (std::sqrt(square - sum * sum) * patch.deviation());
}

const SurfaceAlong kSlope = plane_along(Vector3d(0.3, -0.2, 1.0).normalized(), 3.0);

TEST(MatchedView, AgreesWithWarpingEachSample)
{
    const std::vector<StereoView> views = five_views(kSlope);
    const MatchedView matched(views[0], views[1], views[1].image, views[1].camera);
    Patch patch;
    ASSERT_TRUE(patch.set(views[0].image, 70, 50));
    ASSERT_GT(patch.deviation(), 5.0F);
    const Vector3f ray = views[0].camera.ray(70.0F, 50.0F);
    for (const float depth : {2.8F, 3.2F, 3.5F}) {
        for (const Vector3f& normal : {Vector3f(-0.3F, 0.2F, -1.0F), Vector3f(0.2F, 0.1F, -1.0F)}) {
            const PixelPlane plane = {depth, normal.normalized()};
            EXPECT_NEAR(matched.cost(patch, ray, views[0].camera.focal_px, plane),
                        exact_cost(views[0], views[1], patch, {70.0, 50.0}, plane), 0.02);
        }
    }
}

TEST(MatchedView, HasTheLeastCostOnTheTruePlane)
{
    const std::vector<StereoView> views = five_views(kSlope);
    const MatchedView matched(views[0], views[1], views[1].image, views[1].camera);
    Patch patch;
    ASSERT_TRUE(patch.set(views[0].image, 70, 50));
    const Vector3f ray = views[0].camera.ray(70.0F, 50.0F);
    const auto depth = static_cast<float>(kSlope(Vector3d::Zero(), ray.cast<double>()));
    const Vector3f normal = Vector3f(-0.3F, 0.2F, -1.0F).normalized();
    const auto cost = [&](float factor) {
        return matched.cost(patch, ray, views[0].camera.focal_px, {factor * depth, normal});
    };
    EXPECT_LT(cost(1.0F), 0.02F);
    EXPECT_GT(cost(1.2F), 0.3F);
    EXPECT_GT(cost(0.8F), 0.3F);
}

TEST(MatchedView, HasANegativeCostIfTheSourceDoesNotShowThePatch)
{
    const std::vector<StereoView> views = five_views(kSlope);
    const MatchedView matched(views[0], views[1], views[1].image, views[1].camera);
    Patch patch;
    ASSERT_TRUE(patch.set(views[0].image, 70, 50));
    const Vector3f ray = views[0].camera.ray(70.0F, 50.0F);
    EXPECT_LT(matched.cost(patch, ray, 150.0F, {0.4F, -Vector3f::UnitZ()}), 0.0F);
}

TEST(Patch, IsRejectedAtTheImageBorder)
{
    const StereoView view = five_views(kSlope)[0];
    Patch patch;
    EXPECT_FALSE(patch.set(view.image, 4, 60));
    EXPECT_TRUE(patch.set(view.image, 5, 60));
}

TEST(Patch, HasNoDeviationIfItsCenterIsBesideAnEdge)
{
    GrayImage image{40, 40, std::vector<float>(1600, 100.0F)};
    for (int y = 0; y < 40; ++y) {
        for (int x = 24; x < 40; ++x) {
            image.pixels[static_cast<std::size_t>(40 * y + x)] = 140.0F;
        }
    }
    Patch patch;
    ASSERT_TRUE(patch.set(image, 20, 20));
    EXPECT_EQ(patch.deviation(), 0.0F);
    ASSERT_TRUE(patch.set(image, 23, 20));
    EXPECT_GT(patch.deviation(), 5.0F);
}

} // namespace
} // namespace vcarve::patch_test
