#include "stereo/patch.h"
#include "support/stereo_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

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

TEST(MatchedView, HasANegativeCostIfASampleTouchesAPixelWithoutGray)
{
    const std::vector<StereoView> views = five_views(kSlope);
    GrayImage image = views[1].image;
    const MatchedView matched(views[0], views[1], image, views[1].camera);
    Patch patch;
    ASSERT_TRUE(patch.set(views[0].image, 70, 50));
    const Vector3f ray = views[0].camera.ray(70.0F, 50.0F);
    const PixelPlane plane = {3.0F, -Vector3f::UnitZ()}; // the center moves by 15 pixels
    const auto cost = [&] { return matched.cost(patch, ray, views[0].camera.focal_px, plane); };
    const float clear = cost();
    ASSERT_GE(clear, 0.0F);
    const auto cost_without = [&](int x, int y) {
        float& pixel = image.pixels[static_cast<std::size_t>(y) * image.width_px + x];
        const float gray = std::exchange(pixel, kNoGray);
        const float result = cost();
        pixel = gray;
        return result;
    };
    EXPECT_LT(cost_without(55, 50), 0.0F); // the center
    EXPECT_LT(cost_without(51, 46), 0.0F); // between samples in a corner
    EXPECT_EQ(cost_without(49, 50), clear);
    EXPECT_EQ(cost_without(55, 57), clear);
}

TEST(GrayImage, HasNoGrayInItsHalfIfOneOfFourPixelsHasNone)
{
    const GrayImage half = halved(GrayImage{4, 2, {10, 20, 1, kNoGray, 30, 40, 2, 3}});
    EXPECT_EQ(half.pixels[0], 25.0F);
    EXPECT_TRUE(std::isnan(half.pixels[1]));
}

constexpr int kWidth = 640;
constexpr int kHeight = 479;

/// A footprint whose reach ends at a border of the image, up to two roundings beside it.
Footprint borderline(int border, std::mt19937& random)
{
    std::uniform_real_distribution<float> slope(-1.5F, 1.5F);
    std::uniform_int_distribution<int> roundings(-2, 2);
    Footprint at = {300.0F, 200.0F, slope(random), slope(random), slope(random), slope(random)};
    const float reach_x = 4.5F * (std::abs(at.xx) + std::abs(at.xy));
    const float reach_y = 4.5F * (std::abs(at.yx) + std::abs(at.yy));
    float& moved = border % 2 == 0 ? at.x : at.y;
    moved = border % 2 == 0 ? reach_x : reach_y;
    if (border == 2) moved = static_cast<float>(kWidth - 1) - reach_x;
    if (border == 3) moved = static_cast<float>(kHeight - 1) - reach_y;
    for (int step = roundings(random); step != 0; step += step < 0 ? 1 : -1) {
        moved = std::nextafter(moved, step < 0 ? 0.0F : 1e9F);
    }
    return at;
}

bool are_all_samples_inside(const Footprint& at)
{
    bool result = true;
    for (int k = 0; k < Patch::kSide * Patch::kSide; ++k) {
        const float right = Patch::kStepPx * static_cast<float>(k % Patch::kSide - 3);
        const float down = Patch::kStepPx * static_cast<float>(k / Patch::kSide - 3);
        const float x = at.x_at(right, down);
        const float y = at.y_at(right, down);
        result &= x >= 0.0F && y >= 0.0F && static_cast<int>(x) + 1 < kWidth &&
                  static_cast<int>(y) + 1 < kHeight;
    }
    return result;
}

TEST(Footprint, IsInsideIfAndOnlyIfAllRoundedSamplesAre)
{
    std::mt19937 random(3);
    int wrong = 0;
    int inside = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Footprint at = borderline(i % 4, random);
        const bool expected = are_all_samples_inside(at);
        inside += expected ? 1 : 0;
        wrong += at.is_inside(kWidth, kHeight) != expected ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(inside, 5'000);
    EXPECT_LT(inside, 15'000);
}

TEST(Patch, IsRejectedIfASampleTouchesAPixelWithoutGray)
{
    GrayImage image = five_views(kSlope)[0].image;
    Patch patch;
    ASSERT_TRUE(patch.set(image, 70, 50));
    image.pixels[static_cast<std::size_t>(51) * image.width_px + 72] = kNoGray; // between samples
    EXPECT_FALSE(patch.set(image, 70, 50));
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
