#include "io/dense/dense_scene.h"
#include "io/input/read_model.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <utility>
#include <vector>

namespace vcarve::dense_scene_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3f;
using ::testing::ElementsAre;

const fs::path kFixtures = fixtures_folder();

Scene read(const fs::path& folder)
{
    Log silent;
    return read_model(folder, silent);
}

DenseFiles files_of(const char* format)
{
    const fs::path folder = kFixtures / "formats" / format;
    return {folder / "sparse", ModelFormat::binary, folder / "fused.ply", folder / "fused.ply.vis"};
}

TEST(DenseScene, HasTheViewsOfTheModelAndThePointsOfTheCloud)
{
    const Scene scene = read_dense_scene(files_of("dense_little"));
    expect_well_formed(scene);
    const Scene sparse = read(kFixtures / "formats/rich_bin");
    ASSERT_EQ(scene.views.size(), 3U);
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        EXPECT_EQ(scene.views[i].id, sparse.views[i].id); // ascending
        EXPECT_EQ(scene.views[i].center, sparse.views[i].center);
        EXPECT_EQ(scene.views[i].camera, sparse.views[i].camera);
    }
    EXPECT_THAT(scene.positions, ElementsAre(Vector3d(0.5, 0.25, 4.0), Vector3d(-0.125, 3.0, 5.0),
                                             Vector3d(1.5, -2.0, 6.0)));
    EXPECT_THAT(scene.colors,
                ElementsAre(Color{200, 150, 100}, Color{0, 128, 255}, Color{1, 2, 3}));
    EXPECT_TRUE(scene.is_dense);
    EXPECT_THAT(scene.errors_px, ElementsAre(-1.0, -1.0, -1.0));
    EXPECT_THAT(scene.point_ids, ElementsAre(0, 1, 2));
    // The indices refer to images 40, 7 and 100000, in file order.
    EXPECT_THAT(scene.tracks.begins, ElementsAre(0, 2, 4, 5));
    EXPECT_THAT(scene.tracks.views, ElementsAre(1, 2, 0, 2, 1));
}

TEST(DenseScene, HasNormalsOfUnitLengthOrZero)
{
    const Scene scene = read_dense_scene(files_of("dense_little"));
    EXPECT_THAT(scene.normals,
                ElementsAre(Vector3f(0, 0, -1), Vector3f(0, 0.6F, -0.8F), Vector3f(0, 0, 0)));
}

TEST(DenseScene, IsBlackAndWithoutNormalsIfTheCloudHasNoAttributes)
{
    const Scene scene = read_dense_scene(files_of("dense_bare"));
    expect_well_formed(scene);
    EXPECT_TRUE(scene.normals.empty());
    EXPECT_THAT(scene.colors, ::testing::Each(Color{0, 0, 0}));
}

TEST(DenseScene, ReportsItsSizeBeforeReading)
{
    const auto size = dense_size_before_reading(files_of("dense_little"));
    ASSERT_TRUE(size);
    EXPECT_EQ(size->points, 3U);
    EXPECT_EQ(size->views, 3U);
    EXPECT_EQ(size->rays, 6U); // including a repeated one
    EXPECT_TRUE(size->has_normals);
    EXPECT_FALSE(dense_size_before_reading(files_of("dense_bare"))->has_normals);
    DenseFiles other = files_of("dense_little");
    other.visibility = kFixtures / "broken_dense/vis_no_points/fused.ply.vis";
    EXPECT_FALSE(dense_size_before_reading(other));
}

/// A folder in fixtures/broken_dense, and the error message after its path.
using Refusal = std::pair<const char*, std::string>;

std::vector<Refusal> refusals()
{
    const std::string remedy = " points; for a cropped or thinned cloud, use --rays nearest "
                               "(--crop reconstructs a region of the whole cloud)";
    const auto cloud_of = [](const char* name) {
        return (kFixtures / "broken_dense" / name / "fused.ply").string();
    };
    return {
        {"no_model", ": no COLMAP model found; searched this folder, sparse and their subfolders "
                     "for cameras, images and points3D (all .bin or all .txt); found fused.ply"},
        {"ply_ascii_ends", "/fused.ply: vertex 2 of 3: the file ends there"},
        {"ply_ascii_word", "/fused.ply: vertex 0 of 3: found \"0,25\", expected a number"},
        {"ply_count_huge", "/fused.ply: the header declares 1000000000000000000 entries \"vertex\" "
                           "of at least 27 bytes, but only 81 bytes follow"},
        {"ply_empty", "/fused.ply: the first line is not \"ply\", so this is no PLY file"},
        {"ply_header_open", "/fused.ply: the PLY header has no line end_header"},
        {"ply_list_long", "/fused.ply: vertex 2 of 3: the list \"samples\" has length 9, but only "
                          "4 bytes follow"},
        {"ply_no_vertices", "/fused.ply: has no element \"vertex\""},
        {"ply_no_z", "/fused.ply: the vertices lack one of the properties x, y and z"},
        {"ply_truncated", "/fused.ply: the header declares 3 entries \"vertex\" of at least 27 "
                          "bytes, but only 76 bytes follow"},
        {"vis_count_huge", "/fused.ply.vis: byte 0: found a count of 1152921504606846976 points, "
                           "but the rest of the file can hold 9 at most"},
        {"vis_count_less", "/fused.ply.vis: has the views of 2 points, but " +
                               cloud_of("vis_count_less") + " has 3" + remedy},
        {"vis_count_more", "/fused.ply.vis: has the views of 4 points, but " +
                               cloud_of("vis_count_more") + " has 3" + remedy},
        {"vis_empty", "/fused.ply.vis: the file is empty"},
        {"vis_image_unknown", "/fused.ply.vis: point 1 of 3 has image 3, but the model has "
                              "3 images, counted from 0"},
        {"vis_no_points", "/fused.ply.vis: has the views of 0 points, but " +
                              cloud_of("vis_no_points") + " has 3" + remedy},
        {"vis_track_huge", "/fused.ply.vis: byte 8: found a count of 2147483648 views of point 0, "
                           "but the rest of the file can hold 8 at most"},
        {"vis_trailing", "/fused.ply.vis: byte 44: expected the end of the file after the views of "
                         "the last point, found more bytes: 4"},
        {"vis_truncated", "/fused.ply.vis: byte 36: found a count of 1 views of point 2, but the "
                          "rest of the file can hold 0 at most"},
        {"vis_truncated_between",
         "/fused.ply.vis: byte 36: the file ends inside the number of views of a point (bytes "
         "expected: 4, found: 0)"},
    };
}

TEST(DenseScene, RefusesBrokenFilesWithOneSentence)
{
    for (const auto& [name, sentence] : refusals()) {
        const fs::path folder = kFixtures / "broken_dense" / name;
        EXPECT_EQ(refusal<InputError>([&] { read(folder); }), folder.string() + sentence);
    }
}

TEST(DenseScene, TestsCoverEveryBrokenFixture)
{
    const auto folders = std::distance(fs::directory_iterator(kFixtures / "broken_dense"), {});
    EXPECT_EQ(static_cast<std::size_t>(folders), refusals().size());
}

TEST(DenseScene, MayHaveSparsePoints)
{
    DenseFiles files = files_of("dense_little");
    files.visibility.clear();
    EXPECT_TRUE(read_dense_scene(files).is_dense);
    EXPECT_TRUE(dense_size_before_reading(files)->is_dense);
    files.are_sparse = true;
    EXPECT_FALSE(read_dense_scene(files).is_dense);
    EXPECT_FALSE(dense_size_before_reading(files)->is_dense);
}

} // namespace
} // namespace vcarve::dense_scene_test
