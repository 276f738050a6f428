#include "steps/1_points/thin.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vcarve::thin_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Two views 10 and 20 above the ground, whose pixels are 0.1 and 0.2 wide there.
Scene two_views()
{
    Scene scene;
    scene.cameras = {
        {.id = 1, .model = 0, .width_px = 200, .height_px = 200, .params = {100.0, 100.0, 100.0}}};
    scene.views = {{.id = 1, .camera = 0, .name = "low", .center = {0.0, 0.0, 10.0}},
                   {.id = 2, .camera = 0, .name = "high", .center = {0.0, 0.0, 20.0}}};
    return scene;
}

void add(Scene& scene, const Vector3d& position, const std::vector<std::uint32_t>& views)
{
    scene.positions.push_back(position);
    scene.colors.push_back({static_cast<std::uint8_t>(10 * scene.num_points()), 0, 0});
    scene.errors_px.push_back(-1.0);
    scene.point_ids.push_back(scene.num_points() - 1);
    scene.tracks.push_back(views);
}

/// The position of a point in the frame of the input scene.
Vector3d place(const Scene& thin, std::size_t point)
{
    return thin.positions[point] + thin.offset;
}

std::vector<std::uint32_t> track(const Scene& scene, std::size_t point)
{
    const auto views = scene.tracks[point];
    return {views.begin(), views.end()};
}

TEST(ThinPoints, MergesPointsWithinAPixelAndKeepsTheirRays)
{
    Scene scene = two_views();
    add(scene, {0.01, 0.01, 0.0}, {0});
    add(scene, {0.51, 0.01, 0.0}, {0});
    add(scene, {0.03, 0.02, 0.0}, {0, 1});
    const Scene thin = thin_points(scene, {.merge_px = 1.0});
    ASSERT_EQ(thin.num_points(), 2U);
    EXPECT_EQ(thin.point_ids, (std::vector<std::uint64_t>{1, 2}))
        << "the point with more views leads";
    EXPECT_TRUE(place(thin, 0).isApprox(scene.positions[1]));
    EXPECT_TRUE(place(thin, 1).isApprox(Vector3d(0.02, 0.015, 0.0)));
    EXPECT_EQ(thin.colors[1], (Color{20, 0, 0}));
    EXPECT_EQ(track(thin, 0), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(track(thin, 1), (std::vector<std::uint32_t>{0, 1}));
}

TEST(ThinPoints, KeepsTwoSidesOfABoardApart)
{
    Scene scene = two_views();
    for (const double z : {0.01, 0.03, 0.02, 0.04}) {
        add(scene, {0.01, 0.01, z}, {0, 1});
    }
    const Vector3f up = Vector3f::UnitZ();
    scene.normals = {up, -up, up, -up};
    const Scene thin = thin_points(scene, {.merge_px = 1.0});
    ASSERT_EQ(thin.num_points(), 2U);
    EXPECT_EQ(thin.normals[0], up);
    EXPECT_EQ(thin.normals[1], Vector3f(-up));
    EXPECT_NEAR(place(thin, 0).z(), 0.015, 1e-15);
    EXPECT_NEAR(place(thin, 1).z(), 0.035, 1e-15);
}

TEST(ThinPoints, KeepsSidesOfAnEdgeApartButMergesAcrossABend)
{
    constexpr double kPi = 3.14159265358979323846;
    const auto merged_at = [&](double degrees) {
        Scene scene = two_views();
        add(scene, {0.01, 0.01, 0.01}, {0, 1});
        add(scene, {0.01, 0.01, 0.03}, {0, 1});
        const Vector3d turned(std::sin(degrees * kPi / 180.0), 0.0,
                              std::cos(degrees * kPi / 180.0));
        scene.normals = {Vector3f::UnitZ(), turned.cast<float>()};
        return thin_points(scene, {.merge_px = 1.0}).num_points();
    };
    EXPECT_EQ(merged_at(55.0), 1U);
    EXPECT_EQ(merged_at(65.0), 2U);
}

TEST(ThinPoints, MergesPointsWithUnknownNormals)
{
    Scene scene = two_views();
    add(scene, {0.01, 0.01, 0.01}, {0, 1});
    add(scene, {0.01, 0.01, 0.03}, {0, 1});
    scene.normals = {Vector3f::UnitZ(), Vector3f::Zero()};
    EXPECT_EQ(thin_points(scene, {.merge_px = 1.0}).num_points(), 1U);
}

TEST(ThinPoints, MergesCoarsePointsIntoFineOnes)
{
    // One point is seen by the near view, and one in the next fine cube only by the far view. More
    // points make the footprint of the near view the median.
    Scene scene = two_views();
    add(scene, {0.17, 0.01, 0.01}, {1});
    add(scene, {0.01, 0.01, 0.01}, {0});
    for (int i = 10; i < 20; ++i) {
        add(scene, {0.4 * i, 0.0, 0.0}, {0});
    }
    const Scene thin = thin_points(scene, {.merge_px = 1.0});
    ASSERT_EQ(thin.num_points(), 11U);
    EXPECT_EQ(thin.point_ids[0], 1U) << "the fine point leads";
    EXPECT_EQ(track(thin, 0), (std::vector<std::uint32_t>{0, 1}));
}

TEST(ThinPoints, MergesAcrossBordersOfCubes)
{
    Scene scene = two_views();
    add(scene, {0.999 * 0.1, 0.01, 0.0}, {0});
    add(scene, {1.001 * 0.1, 0.01, 0.0}, {1, 0});
    EXPECT_EQ(thin_points(scene, {.merge_px = 1.0}).num_points(), 1U);
}

TEST(ThinPoints, KeepsPointsOutsideTheCubesOrWithoutViews)
{
    Scene scene = two_views();
    add(scene, {0.01, 0.01, 0.0}, {0});
    add(scene, {0.02, 0.01, 0.0}, {0});
    add(scene, {0.02, 0.02, 0.0}, {0});
    for (const double far : {1e9, std::nan("")}) {
        add(scene, {far, 0.0, 0.0}, {0});
        add(scene, {far, 0.0, 0.0}, {1});
    }
    add(scene, {0.01, 0.01, 0.0}, {});
    EXPECT_EQ(thin_points(scene, {.merge_px = 1.0}).num_points(), 6U);
}

/// A wavy surface of many points, each seen by one or both views.
Scene wavy_sheet(int count)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    std::uniform_int_distribution<int> seen(1, 3);
    Scene scene = two_views();
    for (int i = 0; i < count; ++i) {
        const double x = place(random);
        const double y = place(random);
        std::vector<std::uint32_t> views;
        const int by = seen(random);
        if (by % 2 == 1) views.push_back(0);
        if (by / 2 == 1) views.push_back(1);
        add(scene, {x, y, 0.3 * std::sin(x) * y}, views);
    }
    return scene;
}

TEST(ThinPoints, KeepsAllViewsOfEveryPointNearIt)
{
    const Scene scene = wavy_sheet(5000);
    const Scene thin = thin_points(scene, {.merge_px = 1.0});
    EXPECT_LT(thin.num_points(), 2500U);
    // The diagonal of the largest cube for a footprint of 0.2, plus half a side.
    const double reach = 0.2 * (std::sqrt(3.0) + 0.5);
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const auto views = scene.tracks[i];
        bool found = false;
        for (std::size_t k = 0; k < thin.num_points() && !found; ++k) {
            found = (place(thin, k) - scene.positions[i]).norm() < reach &&
                    std::ranges::includes(thin.tracks[k], views);
        }
        EXPECT_TRUE(found) << "point " << i;
    }
}

TEST(ThinPoints, MergesPartsOfASceneWithAnOffset)
{
    Scene scene = wavy_sheet(3000);
    scene.offset = Vector3d(5.0, -7.0, 100.0);
    const Scene whole = thin_points(scene, {.merge_px = 1.0});
    PartsOfScene parts(scene);
    const Scene thin = thin_points(parts, {.merge_px = 1.0}, {}, 1000);
    // Each merged point is near a point of the whole surface.
    for (std::size_t i = 0; i < thin.num_points(); ++i) {
        double nearest = 1e9;
        for (std::size_t k = 0; k < whole.num_points(); ++k) {
            nearest = std::min(nearest, (place(thin, i) - place(whole, k)).norm());
        }
        EXPECT_LT(nearest, 0.5) << i;
    }
}

TEST(ThinPoints, ReturnsTheSameForAnyThreadCountAndScale)
{
    const Scene scene = wavy_sheet(3000);
    const auto by = [&](int threads) {
        return testing::with_threads(
            threads, [&] { return thin_points(scene, {.merge_px = 1.0}).positions; });
    };
    const std::vector<Vector3d> one = by(1);
    EXPECT_EQ(one, by(2));
    EXPECT_EQ(one, by(3));
    const Scene larger = moved(scene, 1024.0, Eigen::Quaterniond::Identity(), Vector3d::Zero());
    const Scene thin = thin_points(larger, {.merge_px = 1.0});
    ASSERT_EQ(thin.num_points(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(thin.positions[i], Vector3d(1024.0 * one[i]));
    }
}

} // namespace
} // namespace vcarve::thin_test
