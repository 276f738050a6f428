#include "stereo/patch_match.h"
#include "support/stereo_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vcarve::patch_match_test {
namespace {

using Eigen::Vector3d;

DepthMap matched(const std::vector<StereoView>& views, const DepthPrior& prior)
{
    std::vector<const StereoView*> sources;
    for (std::size_t i = 1; i < views.size(); ++i) {
        sources.push_back(&views[i]);
    }
    return match_view(views[0], sources, prior);
}

/// Completeness and accuracy of a depth map.
struct Quality {
    double measured = 0.0; ///< fraction of the pixels
    double right = 0.0;    ///< fraction of the measured pixels within 0.5 % of the depth
};

Quality quality(const DepthMap& map, const StereoView& view, const SurfaceAlong& surface)
{
    constexpr int kBorder = 5;
    Quality quality;
    int pixels = 0;
    for (int y = kBorder; y < map.height_px - kBorder; ++y) {
        for (int x = kBorder; x < map.width_px - kBorder; ++x) {
            const Vector3d ray =
                view.camera.ray(static_cast<float>(2 * x), static_cast<float>(2 * y))
                    .cast<double>();
            const double depth = surface(view.center, ray);
            if (depth == 0.0) continue;
            ++pixels;
            const std::size_t pixel = map.index(x, y);
            if (map.costs[pixel] >= DepthMap::kNoCost) continue;
            quality.measured += 1.0;
            if (std::abs(map.planes[pixel].depth / depth - 1.0) < 0.005) quality.right += 1.0;
        }
    }
    quality.right /= quality.measured;
    quality.measured /= pixels;
    return quality;
}

TEST(MatchView, MeasuresASlantedPlaneWithoutAPrior)
{
    const SurfaceAlong plane = plane_along(Vector3d(0.3, -0.2, 1.0).normalized(), 3.0);
    const std::vector<StereoView> views = five_views(plane);
    const Quality found = quality(matched(views, {2.0F, 5.0F, {}}), views[0], plane);
    EXPECT_GT(found.measured, 0.95);
    EXPECT_GT(found.right, 0.95);
}

TEST(MatchView, MeasuresASphere)
{
    const SurfaceAlong sphere = [](const Vector3d& from, const Vector3d& along) {
        const Vector3d center(0.0, 0.0, 3.0);
        const double a = along.squaredNorm();
        const double b = along.dot(from - center);
        const double discriminant = b * b - a * ((from - center).squaredNorm() - 1.0);
        return discriminant > 0.0 ? (-b - std::sqrt(discriminant)) / a : 0.0;
    };
    const std::vector<StereoView> views = five_views(sphere);
    const Quality found = quality(matched(views, {1.5F, 4.0F, {}}), views[0], sphere);
    EXPECT_GT(found.measured, 0.75);
    EXPECT_GT(found.right, 0.75);
}

TEST(MatchView, KeepsAStepSharp)
{
    const SurfaceAlong step = [](const Vector3d& from, const Vector3d& along) {
        const double near = (2.0 - from.z()) / along.z();
        return from.x() + near * along.x() < 0.0 ? near : (3.0 - from.z()) / along.z();
    };
    const std::vector<StereoView> views = five_views(step);
    const Quality found = quality(matched(views, {1.5F, 4.0F, {}}), views[0], step);
    EXPECT_GT(found.measured, 0.85);
    EXPECT_GT(found.right, 0.95);
}

TEST(MatchView, StartsFromTheSurfaceOfThePrior)
{
    const SurfaceAlong plane = plane_along(Vector3d::UnitZ(), 3.0);
    const std::vector<StereoView> views = five_views(plane);
    // The range of random depths misses the plane.
    DepthPrior prior = {10.0F, 11.0F, {}};
    prior.surface.assign(80UL * 60UL, {3.02F, -Eigen::Vector3f::UnitZ()});
    const Quality found = quality(matched(views, prior), views[0], plane);
    EXPECT_GT(found.measured, 0.95);
    EXPECT_GT(found.right, 0.95);
}

TEST(MatchView, MarksPixelsWithoutTextureAsPlain)
{
    const SurfaceAlong nothing = [](const Vector3d&, const Vector3d&) { return 0.0; };
    const std::vector<StereoView> views = five_views(nothing);
    const DepthMap map = matched(views, {2.0F, 5.0F, {}});
    EXPECT_EQ(map.costs[map.index(40, 30)], DepthMap::kPlain);
    EXPECT_EQ(std::ranges::count_if(map.costs, [](float c) { return c < DepthMap::kNoCost; }), 0);
}

} // namespace
} // namespace vcarve::patch_match_test
