#include "steps/1_points/denoise.h"
#include "support/made_cells.h"
#include "support/noisy_ground.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::denoise_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

using testing::add;
using testing::flat;
using testing::ground;
using testing::kFocalPx;
using testing::kHalfBaseline;
using testing::kHeight;
using testing::kUpOfAPixel;
using testing::rms;
using testing::two_views;

TEST(DenoisePoints, FlattensAPlaneAndMeasuresItsNoise)
{
    Scene scene = ground(0.4, flat);
    const double before = rms(scene.positions);
    const DenoiseReport report = denoise_points(scene, {});
    EXPECT_LT(rms(scene.positions), 0.45 * before);
    EXPECT_NEAR(report.noise_px, 0.4, 0.06);
    EXPECT_EQ(report.moved, static_cast<std::int64_t>(scene.num_points()));
}

TEST(DenoisePoints, NeedsNoSecondViewForMeasuredRanges)
{
    Scene scene = ground(0.4, flat);
    Scene scanned = scene;
    scanned.cameras[0].measures_range = true;
    scanned.tracks = {};
    for (std::uint32_t i = 0; i < scene.num_points(); ++i) {
        scanned.tracks.push_back(std::array<std::uint32_t, 1>{0});
    }
    Scene photographed = scanned;
    photographed.cameras[0].measures_range = false;
    const double before = rms(scene.positions);
    EXPECT_GT(denoise_points(scanned, {}).moved, 2000);
    EXPECT_LT(rms(scanned.positions), 0.5 * before);
    EXPECT_EQ(denoise_points(photographed, {}).moved, 0);
}

TEST(DenoisePoints, KeepsAScanWhoseNoiseIsSmallForItsSpacing)
{
    // The 24th nearest point is about 2.8 spacings away.
    const double spacing = 1.0 / 50.0;
    const double pixel = kHeight / kFocalPx; // of a range, too
    for (const double share : {0.02, 0.05}) {
        Scene scanned = ground(share * 2.8 * spacing / kUpOfAPixel, flat);
        scanned.cameras[0].measures_range = true;
        scanned.tracks = {};
        for (std::uint32_t i = 0; i < scanned.num_points(); ++i) {
            scanned.tracks.push_back(std::array<std::uint32_t, 1>{0});
        }
        const DenoiseReport report = denoise_points(scanned, {});
        EXPECT_GT(report.noise_px, 0.5 * share * 2.8 * spacing / pixel);
        EXPECT_EQ(report.moved > 0, share > 0.03) << share;
    }
}

TEST(DenoisePoints, UsesTheNormalsOfTheCloud)
{
    Scene scene = ground(0.4, flat);
    Scene known = scene;
    known.normals.assign(known.num_points(), Vector3f::UnitZ());
    denoise_points(scene, {});
    denoise_points(known, {});
    EXPECT_LT(rms(known.positions), 0.9 * rms(scene.positions)) << "fitted normals are noisy";
    EXPECT_EQ(known.normals, std::vector<Vector3f>(known.num_points(), Vector3f::UnitZ()));
}

TEST(DenoisePoints, FitsMissingNormals)
{
    Scene scene = ground(0.4, flat);
    Scene unknown = scene;
    unknown.normals.assign(unknown.num_points(), Vector3f::Zero());
    denoise_points(scene, {});
    denoise_points(unknown, {});
    EXPECT_EQ(unknown.positions, scene.positions);
}

TEST(DenoisePoints, KeepsEdges)
{
    // A roof: averaging that ignores normals cuts off its ridge.
    const auto roof = [](double x, double) { return -std::abs(x); };
    Scene scene = ground(0.2, roof);
    const double before = rms(scene.positions, roof);
    denoise_points(scene, {});
    EXPECT_LT(rms(scene.positions, roof), 0.6 * before);
    double lowered = 0.0;
    double near_ridge = 0.0;
    for (const Vector3d& position : scene.positions) {
        if (std::abs(position.x()) > 0.02) continue;
        lowered += roof(position.x(), position.y()) - position.z();
        near_ridge += 1.0;
    }
    EXPECT_LT(lowered / near_ridge, 0.35 * before);
}

TEST(DenoisePoints, KeepsExactPoints)
{
    Scene scene = ground(0.0, flat);
    const Scene before = scene;
    const DenoiseReport report = denoise_points(scene, {});
    EXPECT_EQ(report.moved, 0);
    EXPECT_EQ(report.noise_px, 0.0);
    EXPECT_EQ(scene.positions, before.positions);
}

TEST(DenoisePoints, KeepsPointsWhoseRaysDoNotCross)
{
    Scene scene = ground(0.4, flat);
    const Scene before = scene;
    scene.tracks = {};
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (i == 1235) {
            scene.tracks.push_back(std::array<std::uint32_t, 1>{0});
        } else {
            scene.tracks.push_back(std::array<std::uint32_t, 2>{0, 1});
        }
    }
    const DenoiseReport report = denoise_points(scene, {});
    EXPECT_EQ(report.moved, static_cast<std::int64_t>(scene.num_points()) - 1);
    EXPECT_EQ(scene.positions[1235], before.positions[1235]);
}

TEST(DenoisePoints, DoesNotPullOutliersToTheSurface)
{
    Scene scene = ground(0.2, flat);
    scene.normals.assign(scene.num_points(), Vector3f::UnitZ());
    const std::size_t outlier = 1234;
    const std::size_t far_outlier = 2000;
    scene.positions[outlier].z() += 1.5 * kUpOfAPixel;
    scene.positions[far_outlier].z() += 12.0 * kUpOfAPixel;
    const Vector3d before = scene.positions[outlier];
    const Vector3d far_before = scene.positions[far_outlier];
    const DenoiseReport report = denoise_points(scene, {.denoise = 3.0});
    const double way = before.z() - scene.positions[outlier].z();
    EXPECT_GT(way, 0.0);
    EXPECT_LE(way, 3.0 * report.noise_px * kUpOfAPixel);
    EXPECT_EQ(scene.positions[far_outlier], far_before);
}

TEST(DenoisePoints, MovesPointsInTheDirectionOfUncertainty)
{
    // The views are far above the ground, so points are uncertain in z. They move along z even on
    // a steep slope, not along its normal.
    const auto slope = [](double x, double) { return 2.0 * x; };
    Scene scene = ground(0.3, slope);
    const Scene before = scene;
    denoise_points(scene, {});
    double up = 0.0;
    double across = 0.0;
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const Vector3d way = scene.positions[i] - before.positions[i];
        up += std::abs(way.z());
        across += way.head<2>().norm();
    }
    EXPECT_GT(up, 4.0 * across);
}

TEST(DenoisePoints, KeepsTwoSidesOfABoardApart)
{
    // Two surfaces closer to each other than the noise, seen from above and below.
    constexpr double kThickness = 0.01;
    Scene scene = two_views();
    scene.views.push_back(
        {.id = 3, .camera = 0, .name = "low left", .center = {-kHalfBaseline, 0.0, -kHeight}});
    scene.views.push_back(
        {.id = 4, .camera = 0, .name = "low right", .center = {kHalfBaseline, 0.0, -kHeight}});
    const Scene above = ground(0.2, flat);
    const std::array<std::uint32_t, 2> low = {2, 3};
    for (const Vector3d& position : above.positions) {
        add(scene, position);
        scene.normals.emplace_back(Vector3f::UnitZ());
    }
    for (const Vector3d& position : above.positions) {
        scene.positions.emplace_back(position.x() + 0.01, position.y(), -kThickness - position.z());
        scene.colors.push_back({0, 0, 0});
        scene.errors_px.push_back(-1.0);
        scene.point_ids.push_back(scene.num_points() - 1);
        scene.tracks.push_back(low);
        scene.normals.emplace_back(-Vector3f::UnitZ());
    }
    denoise_points(scene, {});
    double upper = 0.0;
    double lower = 0.0;
    for (std::size_t i = 0; i < above.num_points(); ++i) {
        upper += scene.positions[i].z() / static_cast<double>(above.num_points());
        lower +=
            scene.positions[above.num_points() + i].z() / static_cast<double>(above.num_points());
    }
    EXPECT_NEAR(upper, 0.0, 0.1 * kThickness);
    EXPECT_NEAR(lower, -kThickness, 0.1 * kThickness);
}

TEST(DenoisePoints, ReturnsTheSameForAnyThreadCountAndScale)
{
    const Scene scene = ground(0.4, [](double x, double y) { return 0.2 * std::sin(9.0 * x) * y; });
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] {
            Scene copy = scene;
            denoise_points(copy, {});
            return copy.positions;
        });
    };
    const std::vector<Vector3d> one = by(1);
    EXPECT_NE(one, scene.positions);
    EXPECT_EQ(one, by(2));
    EXPECT_EQ(one, by(3));
    Scene larger = moved(scene, 1024.0, Eigen::Quaterniond::Identity(), Vector3d::Zero());
    denoise_points(larger, {});
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_LT((larger.positions[i] - 1024.0 * one[i]).norm(), 1e-9 * 1024.0);
    }
}

TEST(DenoisePoints, DoesNotMoveTooFewPoints)
{
    for (std::size_t count = 0; count < 6; ++count) {
        Scene scene = two_views();
        for (std::size_t i = 0; i < count; ++i) {
            add(scene, {0.1 * static_cast<double>(i * i), 0.1 * static_cast<double>(i), 0.0});
        }
        const Scene before = scene;
        denoise_points(scene, {});
        EXPECT_EQ(scene.positions, before.positions) << "they are coplanar";
    }
}

TEST(KeepApart, MovesCoincidentPointsBack)
{
    const std::vector<Vector3d> before = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    // The first two points coincide. The first, moved back, then coincides with the fourth.
    std::vector<Vector3d> positions = {{5, 0, 0}, {5, 0, 0}, {4, 0, 0}, {0, 0, 0}};
    keep_apart(positions, before);
    EXPECT_EQ(positions, (std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {4, 0, 0}, {3, 0, 0}}));
}

} // namespace
} // namespace vcarve::denoise_test
