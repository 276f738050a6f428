#include "io/dense/scanner_views.h"
#include "model/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vcarve::scanner_views_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

/// `side` x `side` points a tenth apart in the plane z = 10.
std::vector<Vector3d> wall(int side)
{
    std::vector<Vector3d> points;
    for (int i = 0; i < side * side; ++i) {
        points.emplace_back(0.1 * (i % side - side / 2), 0.1 * (i / side - side / 2), 10.0);
    }
    return points;
}

Scene with_scanners(const std::vector<Vector3d>& points, const std::vector<Vector3d>& scanners)
{
    Scene scene;
    scene.positions = points;
    add_scanner_views(scanners, scene);
    return scene;
}

TEST(ScannerViews, StandWhereTheScannersStoodInTheOrderOfThePoints)
{
    const Scene scene = with_scanners({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}},
                                      {{5, 0, 0}, {-1, 0, 0}, {5, 0, 0}, {-1, 0, -0.0}});
    ASSERT_EQ(scene.views.size(), 2U);
    EXPECT_EQ(scene.views[0].center, Vector3d(5, 0, 0));
    EXPECT_EQ(scene.views[1].center, Vector3d(-1, 0, 0));
    EXPECT_EQ(scene.views[0].name, "scanner 1");
    EXPECT_EQ(scene.views[1].id, 2U);
    EXPECT_THAT(scene.tracks.begins, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(scene.tracks.views, ElementsAre(0, 1, 0, 1));
}

TEST(ScannerViews, SeeNoPointThatIsNotFinite)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Scene scene = with_scanners({{nan, 0, 1}, {0, 0, 2}}, {{nan, nan, nan}, {1, 0, 0}});
    ASSERT_EQ(scene.views.size(), 1U);
    EXPECT_EQ(scene.views[0].center, Vector3d(1, 0, 0));
    EXPECT_THAT(scene.tracks.begins, ElementsAre(0, 0, 1));
    EXPECT_TRUE(with_scanners({{nan, 0, 1}}, {{0, 0, 0}}).views.empty());
    EXPECT_TRUE(with_scanners({}, {}).views.empty());
}

TEST(ScannerViews, ShowAllThatIsAroundThem)
{
    const Scene scene = with_scanners(wall(9), {Vector3d::Zero()});
    for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, -1)}) {
        EXPECT_TRUE(view_shows(scene.views[0], scene.cameras[0], way));
    }
}

TEST(ScannerViews, HavePixelsAQuarterAsWideAsPointsStandApart)
{
    // Eight others lie around within sqrt 2 tenths, so that each has pi / 4 hundredths.
    const Scene scene = with_scanners(wall(101), {Vector3d::Zero()});
    const double pixel_rad = 1.0 / mean_focals_px(scene.cameras)[0];
    // Farther points at the border of the wall stand nearer to each other in angle.
    EXPECT_NEAR(pixel_rad, 0.25 * 0.01 * std::sqrt(std::numbers::pi / 4.0), 0.001);
    const Scene larger = [] {
        std::vector<Vector3d> points = wall(101);
        for (Vector3d& point : points) {
            point *= 1024.0;
        }
        return with_scanners(points, {Vector3d::Zero()});
    }();
    EXPECT_EQ(larger.cameras[0].width_px, scene.cameras[0].width_px);
}

TEST(ScannerViews, AreStationsOfAFiftiethOfTheRangeWhereEveryPointHasItsOwnScanner)
{
    // Carried along x for one unit, with ranges of 10: cubes are 0.2 wide.
    const std::size_t count = 2 * kMostStations;
    std::vector<Vector3d> points;
    std::vector<Vector3d> scanners;
    for (std::size_t i = 0; i < count; ++i) {
        scanners.emplace_back(static_cast<double>(i) / static_cast<double>(count), 0.0, 0.0);
        points.push_back(scanners.back() + Vector3d(0, 0, 10));
    }
    const Scene scene = with_scanners(points, scanners);
    ASSERT_EQ(scene.views.size(), 5U);
    for (std::size_t i = 0; i < count; i += 97) {
        const Vector3d& station = scene.views[scene.tracks[i][0]].center;
        EXPECT_LE((station - scanners[i]).norm(), 0.2);
        EXPECT_THAT(scanners, ::testing::Contains(station));
    }
}

TEST(ScannerViews, KeepEveryPlaceUpToSoMany)
{
    std::vector<Vector3d> scanners;
    for (std::size_t i = 0; i < kMostStations; ++i) {
        scanners.emplace_back(1e-6 * static_cast<double>(i), 0, 0);
    }
    const std::vector<Vector3d> points(scanners.size(), Vector3d(0, 0, 10));
    EXPECT_EQ(with_scanners(points, scanners).views.size(), kMostStations);
}

TEST(ScannerViews, AreNeverMoreThanSoManyHoweverFarTheScannerWent)
{
    std::vector<Vector3d> scanners;
    for (std::size_t i = 0; i < 2 * kMostStations; ++i) {
        scanners.emplace_back(static_cast<double>(i), 0, 0);
    }
    std::vector<Vector3d> points = scanners; // the ranges are zero
    EXPECT_LE(with_scanners(points, scanners).views.size(), kMostStations);
    for (Vector3d& point : points) {
        point.z() += 0.5;
    }
    const Scene scene = with_scanners(points, scanners);
    EXPECT_LE(scene.views.size(), kMostStations);
    EXPECT_GE(scene.views.size(), kMostStations / 3);
}

} // namespace
} // namespace vcarve::scanner_views_test
