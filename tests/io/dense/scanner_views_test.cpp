#include "io/dense/scanner_views.h"
#include "io/input/read_model.h"
#include "model/camera.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace vcarve::scanner_views_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using ::testing::ElementsAre;

namespace {

/// `side` x `side` points in the plane z = 10, with a spacing of 0.1.
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

TEST(ScannerViews, HaveTheScannerPositionsInTheOrderOfThePoints)
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

TEST(ScannerViews, ShowAllDirections)
{
    const Scene scene = with_scanners(wall(9), {Vector3d::Zero()});
    for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, -1)}) {
        EXPECT_TRUE(view_shows(scene.views[0], scene.cameras[0], way));
    }
}

TEST(ScannerViews, HavePixelsOfAQuarterOfThePointSpacing)
{
    // Eight neighbors are within 0.1 sqrt 2, so the area per point is 0.01 pi / 4.
    const Scene scene = with_scanners(wall(101), {Vector3d::Zero()});
    const double pixel_rad = 1.0 / mean_focals_px(scene.cameras)[0];
    // Points at the border of the wall are farther away, so their angular spacing is smaller.
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

TEST(ScannerViews, AreStationsOfAFiftiethOfTheRangeForMovingScanners)
{
    // The scanner moves one unit along x with ranges of 10, so cubes are 0.2 wide.
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

TEST(ScannerViews, KeepEveryPositionUpToTheMaximum)
{
    std::vector<Vector3d> scanners;
    for (std::size_t i = 0; i < kMostStations; ++i) {
        scanners.emplace_back(1e-6 * static_cast<double>(i), 0, 0);
    }
    const std::vector<Vector3d> points(scanners.size(), Vector3d(0, 0, 10));
    EXPECT_EQ(with_scanners(points, scanners).views.size(), kMostStations);
}

TEST(ScannerViews, AreNeverMoreThanTheMaximumHoweverFarTheScannerMoves)
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

namespace {

const fs::path kFixtures = fixtures_folder();

ScanFile scan_of(const char* format)
{
    return {kFixtures / "formats" / format / "scan.ply", std::nullopt};
}

std::vector<Vector3d> places_of(const Scene& scene)
{
    std::vector<Vector3d> places;
    for (const View& view : scene.views) {
        places.push_back(view.center);
    }
    return places;
}

TEST(ScanScene, ReadsScannersInAllFormatsAndPropertyNames)
{
    for (const char* name : {"scan_origin", "scan_origin_big_lists", "scan_scanner_ascii"}) {
        SCOPED_TRACE(name);
        const Scene scene = read_scan_scene(scan_of(name));
        expect_well_formed(scene);
        EXPECT_THAT(places_of(scene), ElementsAre(Vector3d(0, 0, 1), Vector3d(8, 0, 1)));
        EXPECT_THAT(scene.positions, ElementsAre(Vector3d(2, 0.5, 1), Vector3d(2, -0.5, 1.25),
                                                 Vector3d(6, 0.5, 0.75), Vector3d(2, 0, 3)));
        EXPECT_THAT(scene.tracks.views, ElementsAre(0, 0, 1, 0));
        EXPECT_THAT(scene.errors_px, ::testing::Each(-1.0));
        EXPECT_EQ(scene.views[1].name, "scanner 2");
        EXPECT_TRUE(scene.cameras[scene.views[1].camera].measures_range);
    }
}

TEST(ScanScene, ReadsTheOneScannerOfPclsCamera)
{
    for (const char* name : {"scan_camera", "scan_camera_ascii_first", "scan_camera_big"}) {
        SCOPED_TRACE(name);
        const Scene scene = read_scan_scene(scan_of(name));
        EXPECT_THAT(places_of(scene), ElementsAre(Vector3d(0, 0, 1)));
        EXPECT_THAT(scene.tracks.views, ElementsAre(0, 0, 0, 0));
        EXPECT_EQ(scene.positions[3], Vector3d(2, 0, 3));
    }
}

TEST(ScanScene, PrefersTheGivenScannerToPclsCamera)
{
    ScanFile file = scan_of("scan_camera");
    file.scanner = Vector3d(5, 6, 7);
    EXPECT_THAT(places_of(read_scan_scene(file)), ElementsAre(Vector3d(5, 6, 7)));
}

TEST(ScanScene, AddsTheOffsetOfTheFileToItsScanners)
{
    const TemporaryFolder folder;
    const std::string vertices = "element vertex 1\nproperty float x\nproperty float y\n"
                                 "property float z\n";
    const std::string begin = "ply\nformat ascii 1.0\ncomment offset 1000 0 0\n" + vertices;
    ScanFile file{folder.write("given.ply", begin + "end_header\n1 2 3\n"), Vector3d(0, 0, 1)};
    EXPECT_THAT(places_of(read_scan_scene(file)), ElementsAre(Vector3d(1000, 0, 1)));
    file = {folder.write("each.ply", begin + "property float x_origin\nproperty float y_origin\n"
                                             "property float z_origin\nend_header\n1 2 3 0 0 1\n"),
            std::nullopt};
    EXPECT_THAT(places_of(read_scan_scene(file)), ElementsAre(Vector3d(1000, 0, 1)));
}

TEST(ScanScene, ReportsItsSizeBeforeReading)
{
    const auto size = scan_size_before_reading(scan_of("scan_origin"));
    ASSERT_TRUE(size);
    EXPECT_EQ(size->points, 4U);
    EXPECT_EQ(size->rays, 4U);
    EXPECT_TRUE(size->is_dense);
}

TEST(ScanScene, IsRefusedWithoutAScannerPosition)
{
    const ScanFile file{kFixtures / "formats/dense_bare/fused.ply", std::nullopt};
    EXPECT_EQ(refusal<InputError>([&] { read_scan_scene(file); }),
              file.cloud.string() +
                  ": the file has no scanner position; give it with --scanner x,y,z");
}

/// A folder in fixtures/broken_scans, and the error message after the path of its scan.ply.
const std::vector<std::pair<const char*, const char*>> kRefusals = {
    {"camera_ends", ": the header declares 1 entries \"camera\" of at least 20 bytes, but only 14 "
                    "bytes follow"},
    {"camera_infinite",
     ": camera 0 of 1: its scanner position is (0, inf, 1), expected finite numbers"},
    {"camera_twice", ": has 2 entries \"camera\", expected one with the scanner position"},
    {"camera_x_only", ": the camera has only view_px, expected the scanner position as view_px, "
                      "view_py and view_pz"},
    {"origin_infinite",
     ": vertex 2 of 4: its scanner position is (8, 0, -inf), expected finite numbers"},
    {"origin_nan", ": vertex 2 of 4: its scanner position is (nan, 0, 1), expected finite numbers"},
    {"origin_without_z", ": the vertices have only x_origin and y_origin, expected the scanner "
                         "position as x_origin, y_origin and z_origin"},
    {"scanner_y_only", ": the vertices have only scanner_y, expected the scanner position as "
                       "scanner_x, scanner_y and scanner_z"},
    {"vertices_end", ": the header declares 4 entries \"vertex\" of at least 24 bytes, but only 92 "
                     "bytes follow"},
};

TEST(ScanScene, RefusesBrokenFilesWithOneSentence)
{
    for (const auto& [name, sentence] : kRefusals) {
        const fs::path path = kFixtures / "broken_scans" / name / "scan.ply";
        Log silent;
        EXPECT_EQ(refusal<InputError>([&] { read_model(path, silent); }), path.string() + sentence);
    }
}

TEST(ScanScene, TestsCoverEveryBrokenFixture)
{
    const auto folders = std::distance(fs::directory_iterator(kFixtures / "broken_scans"), {});
    EXPECT_EQ(static_cast<std::size_t>(folders), kRefusals.size());
}

} // namespace

} // namespace
} // namespace vcarve::scanner_views_test
