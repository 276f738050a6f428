#include "io/colmap/colmap_model.h"
#include "io/colmap/find_model.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace vcarve::colmap_model_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using ::testing::ElementsAre;

namespace {

const fs::path kFixtures = fixtures_folder();

Scene read_fixture(const std::string& name)
{
    const FoundModel found = find_model(kFixtures / name);
    return read_colmap_model(found.folder, found.format);
}

TEST(ColmapModel, ReadsAllRecordsOfTheFiles)
{
    const Scene scene = read_fixture("formats/rich_bin");
    expect_well_formed(scene);

    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].id, 3U);
    EXPECT_EQ(scene.cameras[0].model, 1);
    EXPECT_EQ(scene.cameras[1].id, 12U);
    EXPECT_EQ(scene.cameras[1].model, 2);
    EXPECT_EQ(scene.cameras[1].width_px, 640U);
    EXPECT_EQ(scene.cameras[1].height_px, 480U);
    EXPECT_THAT(scene.cameras[1].params, ElementsAre(700.0, 320.5, 240.25, -0.0125));

    ASSERT_EQ(scene.views.size(), 3U);
    EXPECT_EQ(scene.views[0].id, 7U);
    EXPECT_EQ(scene.views[0].camera, 0U);
    EXPECT_EQ(scene.views[0].name, "K\xC3\xB6ln \xE5\xAF\xBA 7.png");
    EXPECT_EQ(scene.views[1].id, 40U);
    EXPECT_EQ(scene.views[1].camera, 1U);
    EXPECT_EQ(scene.views[1].name, "left room/IMG 0001.jpg");
    EXPECT_EQ(scene.views[2].id, 100000U);
    EXPECT_EQ(scene.views[2].camera, 1U);
    EXPECT_EQ(scene.views[2].name, "c.jpg");

    EXPECT_THAT(scene.positions,
                ElementsAre(Vector3d(0.1, 1.0 / 3.0, -2e-7),
                            Vector3d(1e6 + 0.1, std::numeric_limits<double>::denorm_min(), 4.6e6),
                            Vector3d(1, 2, 3)));
    EXPECT_THAT(scene.colors,
                ElementsAre(Color{0, 128, 255}, Color{255, 255, 255}, Color{1, 2, 3}));
    EXPECT_THAT(scene.errors_px, ElementsAre(0.5, -1.0, 0.0));
    EXPECT_THAT(scene.point_ids, ElementsAre(900U, 2U, 18446744073709551614U));
    // The first track has images 100000, 7, 40 and again 7
    EXPECT_THAT(scene.tracks.begins, ElementsAre(0U, 3U, 4U, 4U));
    EXPECT_THAT(scene.tracks.views, ElementsAre(0U, 1U, 2U, 1U));
    EXPECT_EQ(scene.offset, Vector3d::Zero());
}

TEST(ColmapModel, KeepsPosesExact)
{
    const Scene scene = read_fixture("formats/rich_bin");
    ASSERT_EQ(scene.views.size(), 3U);
    // This quaternion is the identity with length 2
    EXPECT_EQ(scene.views[0].cam_from_world.coeffs(), Eigen::Vector4d(0, 0, 0, 1));
    EXPECT_EQ(scene.views[0].center, Vector3d(-1, -2, -3));
    // 120 degrees about (1, -1, 1): x goes to z, y to -x, z to -y
    Eigen::Matrix3d rotation;
    rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    EXPECT_TRUE(scene.views[1].cam_from_world.toRotationMatrix().isApprox(rotation, 1e-15));
    EXPECT_TRUE(scene.views[1].center.isApprox(Vector3d(-3, 0.1, -2.5), 1e-15));
    // Cosine -0.28 and sine 0.96 about y
    EXPECT_TRUE(scene.views[2].center.isApprox(Vector3d(4.8e6, 0, 1.4e6), 1e-15));
}

TEST(ColmapModel, IsTheSameInEitherFormat)
{
    const Scene binary = read_fixture("formats/rich_bin");
    expect_equal_scenes(binary, read_fixture("formats/rich_txt"));
    expect_equal_scenes(binary, read_fixture("formats/rich_txt_by_hand"));
}

TEST(ColmapModel, IsTheSameInPartsOfAnySize)
{
    for (const char* const name : {"scene", "formats/rich_bin"}) {
        const FoundModel found = find_model(kFixtures / name);
        const Scene whole = read_colmap_model(found.folder, found.format);
        for (const std::size_t most : {std::size_t{1}, std::size_t{7}, whole.num_points()}) {
            Scene joined;
            const auto take = [&](const Scene& part) {
                EXPECT_LE(part.num_points(), most);
                append_points(part, joined, [](std::size_t) { return true; });
            };
            const Scene frame = read_colmap_parts(found.folder, found.format, most, take);
            EXPECT_EQ(frame.num_points(), 0U);
            joined.cameras = frame.cameras;
            joined.views = frame.views;
            expect_equal_scenes(joined, whole);
        }
    }
}

TEST(ColmapModel, ReadsEveryCameraModelOfColmap)
{
    const std::vector<std::size_t> num_params{3, 4,  4,  5, 8, 8, 12, 5, 4,
                                              5, 12, 16, 4, 5, 3, 4,  6, 2};
    const Scene scene = read_fixture("formats/cameras_bin");
    ASSERT_EQ(scene.cameras.size(), num_params.size());
    for (std::size_t i = 0; i < num_params.size(); ++i) {
        EXPECT_EQ(scene.cameras[i].model, static_cast<int>(i));
        ASSERT_EQ(scene.cameras[i].params.size(), num_params[i]);
        EXPECT_EQ(scene.cameras[i].params[1], 100.0 * static_cast<double>(i) + 1.5);
    }
    expect_equal_scenes(scene, read_fixture("formats/cameras_txt"));
}

TEST(ColmapModel, KeepsACameraOfAnUnknownModelInText)
{
    const Scene scene = read_fixture("formats/camera_unknown_txt");
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].model, -1);
    EXPECT_THAT(scene.cameras[0].params, ElementsAre(1, 2, 3, 4, 5, 6, 7));
}

TEST(ColmapModel, ReadsLinesOfMegabytes)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "formats/rich_txt", "model");
    std::string points2d;
    for (int i = 0; i < 200'000; ++i) {
        points2d += "123.456 654.321 -1 ";
    }
    std::string track;
    for (int i = 0; i < 200'000; ++i) {
        track += i % 2 == 0 ? " 1 0" : " 2 7";
    }
    folder.write("model/images.txt",
                 "1 1 0 0 0 0 0 0 3 a\n" + points2d + "\n2 1 0 0 0 0 0 0 3 b\n");
    folder.write("model/points3D.txt", "1 0 0 0 0 0 0 1" + track + "\n");
    const Scene scene = read_colmap_model(folder.path() / "model", ModelFormat::text);
    EXPECT_EQ(scene.views.size(), 2U);
    EXPECT_THAT(scene.tracks.views, ElementsAre(0U, 1U));
}

TEST(ColmapModel, ReadsAnErrorOfNanAsUnknown)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "formats/rich_txt", "model");
    folder.write("model/points3D.txt", "1 0 0 0 0 0 0 nan\n2 0 0 0 0 0 0 inf\n");
    const Scene scene = read_colmap_model(folder.path() / "model", ModelFormat::text);
    EXPECT_THAT(scene.errors_px, ElementsAre(-1.0, std::numeric_limits<double>::infinity()));
}

TEST(ColmapModel, DropsRaysOfMissingImagesAndCountsThemUnlessPlaceholders)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "formats/rich_txt", "model"); // its images are 7, 40 and 100000
    folder.write("model/points3D.txt", "1 0 0 0 0 0 0 1 7 0 9 3 40 -1\n"
                                       "2 0 0 1 0 0 0 1 0 0\n"
                                       "3 0 1 0 0 0 0 1 -1 -1\n"
                                       "4 0 1 1 0 0 0 1 9 0 41 5\n");
    DroppedRays dropped;
    const Scene scene = read_colmap_model(folder.path() / "model", ModelFormat::text, {}, &dropped);
    expect_well_formed(scene);
    EXPECT_THAT(scene.tracks.begins, ElementsAre(0U, 2U, 2U, 2U, 2U));
    EXPECT_THAT(scene.tracks.views, ElementsAre(0U, 1U));
    EXPECT_EQ(dropped.rays, 3U);
    EXPECT_THAT(dropped.images, ElementsAre(9U, 41U));
}

TEST(ColmapModel, ReadsTracksOfImagesInEitherFormat)
{
    for (const char* name : {"scene/sparse/0", "scene/sparse_txt"}) {
        const FoundModel found = find_model(kFixtures / name);
        const Scene scene = read_colmap_model(found.folder, found.format);
        const Tracks tracks = read_tracks_of_images(found.folder, found.format, scene);
        EXPECT_EQ(tracks.begins, scene.tracks.begins) << name;
        EXPECT_EQ(tracks.views, scene.tracks.views) << name;
    }
}

TEST(ColmapModel, ReadsRepeatedRaysOnceAndSkipsMissingPoints)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "formats/rich_txt", "model");
    folder.write("model/images.txt", "9 1 0 0 0 0 0 0 3 a\n1 1 5 2 2 5 3 3 -1 4 4 77 5 5 6\n"
                                     "4 1 0 0 0 0 0 0 3 b\n1 1 6\n");
    folder.write("model/points3D.txt", "6 0 0 0 0 0 0 1\n5 0 0 1 0 0 0 1\n8 1 0 1 0 0 0 1\n");
    const Scene scene = read_colmap_model(folder.path() / "model", ModelFormat::text);
    const Tracks tracks = read_tracks_of_images(folder.path() / "model", ModelFormat::text, scene);
    EXPECT_THAT(tracks.begins, ElementsAre(0U, 2U, 3U, 3U));
    EXPECT_THAT(tracks.views, ElementsAre(0U, 1U, 1U)); // sorted by id, so image 4 is view 0
}

TEST(ColmapModel, ReadsEveryDegenerateFixture)
{
    struct Sizes {
        const char* name;
        std::size_t views, points, rays;
    };
    const std::vector<Sizes> expected{
        {"collinear_points", 4, 8, 32},
        {"coplanar_points", 4, 16, 64},
        {"duplicated_positions", 4, 16, 40},
        {"four_points", 4, 4, 16},
        {"huge_position", 4, 9, 36},
        {"identical_points", 4, 8, 32},
        {"infinite_position", 4, 9, 36},
        {"lattice", 4, 64, 256},
        {"nan_position", 4, 9, 36},
        {"no_points", 4, 0, 0},
        {"no_tracks", 4, 8, 0},
        {"no_views", 0, 0, 0},
        {"one_view", 1, 8, 8},
        {"point_behind_camera", 4, 9, 34},
        {"point_seen_from_where_it_is", 5, 8, 40},
        {"three_points", 4, 3, 12},
        {"view_on_point", 5, 8, 39},
    };
    for (const Sizes& sizes : expected) {
        SCOPED_TRACE(sizes.name);
        const Scene scene = read_fixture(std::string("degenerate/") + sizes.name);
        expect_well_formed(scene);
        EXPECT_EQ(scene.views.size(), sizes.views);
        EXPECT_EQ(scene.num_points(), sizes.points);
        EXPECT_EQ(scene.num_rays(), sizes.rays);
    }
    const auto folders = std::distance(fs::directory_iterator(kFixtures / "degenerate"), {});
    EXPECT_EQ(static_cast<std::size_t>(folders), expected.size());
}

TEST(ColmapModel, PutsAViewExactlyOnACoincidentPoint)
{
    const Scene scene = read_fixture("degenerate/view_on_point");
    EXPECT_EQ(scene.views[4].center, scene.positions[0]);
}

} // namespace

namespace {

std::string count_bytes(char count)
{
    return std::string(1, count) + std::string(7, '\0');
}

class SizeBeforeReading : public ::testing::Test {
  protected:
    /// Of a folder whose files begin with these counts, followed by zeros.
    std::optional<SceneSize> size_of_files(char views, char points, std::size_t rest_bytes)
    {
        folder.write("images.bin", count_bytes(views));
        folder.write("points3D.bin", count_bytes(points) + std::string(rest_bytes, '\0'));
        return size_before_reading(folder.path(), ModelFormat::binary);
    }

    TemporaryFolder folder;
};

TEST_F(SizeBeforeReading, CountsPointsViewsAndTheRemainingBytesAsRays)
{
    const auto size = size_of_files(3, 2, 2 * 51 + 5 * 8);
    ASSERT_TRUE(size);
    EXPECT_EQ(size->points, 2U);
    EXPECT_EQ(size->views, 3U);
    EXPECT_EQ(size->rays, 5U);
}

TEST_F(SizeBeforeReading, IsEmptyForFilesTooShortForTheirCount)
{
    EXPECT_FALSE(size_of_files(3, 2, 2 * 51 - 1));
    EXPECT_TRUE(size_of_files(3, 2, 2 * 51));
    folder.write("points3D.bin", std::string(16, '\xff'));
    EXPECT_FALSE(size_before_reading(folder.path(), ModelFormat::binary));
}

TEST_F(SizeBeforeReading, IsEmptyForTextAndMissingFiles)
{
    EXPECT_FALSE(size_before_reading(folder.path(), ModelFormat::binary));
    EXPECT_TRUE(size_of_files(3, 2, 2 * 51));
    EXPECT_FALSE(size_before_reading(folder.path(), ModelFormat::text));
}

} // namespace

} // namespace
} // namespace vcarve::colmap_model_test
