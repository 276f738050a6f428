#include "io/input/find_input.h"
#include "support/ball_model.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <utility>

namespace vcarve::find_input_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

namespace {

const fs::path kWorkspace = fixtures_folder() / "formats/dense_little";

/// A folder with a dense workspace `dense`.
class FindInput : public ::testing::Test {
  protected:
    FindInput() { folder.copy(kWorkspace, "dense"); }

    std::string refused(const fs::path& input, const PointsOptions& options) const
    {
        return refusal<InputError>([&] { find_input(input, options); });
    }
    std::string misused(const fs::path& input, const PointsOptions& options) const
    {
        return refusal<UsageError>([&] { find_input(input, options); });
    }
    std::string taken() const
    {
        return "points are read from " + fused.string() + ", with views of " +
               (dense / "sparse").string();
    }

    TemporaryFolder folder;
    fs::path dense = folder / "dense";
    fs::path fused = dense / "fused.ply";
    fs::path visibility = dense / "fused.ply.vis";
};

TEST_F(FindInput, SelectsAndNotesTheCloudOfADenseWorkspace)
{
    const FoundInput found = find_input(dense, {});
    ASSERT_TRUE(found.dense);
    EXPECT_EQ(found.model.folder, dense / "sparse");
    EXPECT_EQ(found.dense->model, dense / "sparse");
    EXPECT_EQ(found.dense->format, ModelFormat::binary);
    EXPECT_EQ(found.dense->cloud, fused);
    EXPECT_EQ(found.dense->visibility, visibility);
    EXPECT_THAT(found.notes, ElementsAre(taken() + "; --points sparse selects the sparse points"));
}

TEST_F(FindInput, AcceptsTheModelOfADenseWorkspace)
{
    const FoundInput found = find_input(dense / "sparse", {});
    EXPECT_FALSE(found.dense);
    EXPECT_EQ(found.model.folder, dense / "sparse");
    EXPECT_THAT(found.notes, IsEmpty());
}

TEST_F(FindInput, AcceptsTheCloudOfADenseWorkspace)
{
    const FoundInput found = find_input(fused, {});
    ASSERT_TRUE(found.dense);
    EXPECT_EQ(found.dense->model, dense / "sparse");
    EXPECT_EQ(found.dense->cloud, fused);
    EXPECT_THAT(found.notes, ElementsAre(taken()));
}

TEST_F(FindInput, RefusesMeshes)
{
    const std::string mesh =
        folder.write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                 "property float y\nproperty float z\nelement face 1\n"
                                 "property list uchar int vertex_indices\nend_header\n"
                                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(refused(mesh, {}), mesh +
                                     ": found a mesh of 1 faces, but a model or point cloud is "
                                     "expected; colmap-vcarve compare MODEL " +
                                     mesh + " measures meshes");
    const std::string other = folder.write("mesh.obj", "v 0 0 0\n");
    EXPECT_EQ(refused(other, {}), other + ": is a mesh; expected a model or a point cloud");
}

TEST_F(FindInput, ReportsTheFormatOfUnsupportedClouds)
{
    EXPECT_EQ(refused(dense, {.points = "a/scan.las"}),
              "a/scan.las: scans of this format are not supported; run: pdal translate a/scan.las "
              "a/scan.las.ply");
}

TEST_F(FindInput, SelectsFilesByOptions)
{
    EXPECT_FALSE(find_input(dense, {.points = "sparse"}).dense);
    EXPECT_EQ(find_input(dense, {.points = "dense"}).dense->cloud, fused);
    folder.write("other.ply", "");
    folder.write("other.ply.vis", "");
    folder.write("mine.vis", "");
    const auto other = find_input(dense, {.points = folder / "other.ply"});
    EXPECT_EQ(other.dense->cloud, folder / "other.ply");
    EXPECT_EQ(other.dense->visibility, folder / "other.ply.vis");
    const auto mine = find_input(dense, {.points = {}, .visibility = folder / "mine.vis"});
    EXPECT_EQ(mine.dense->cloud, fused);
    EXPECT_EQ(mine.dense->visibility, folder / "mine.vis");
}

TEST_F(FindInput, IgnoresAndNotesACloudWithoutViews)
{
    fs::remove(visibility);
    const FoundInput found = find_input(dense, {});
    EXPECT_FALSE(found.dense);
    EXPECT_THAT(found.notes,
                ElementsAre("sparse points are used and " + fused.string() +
                            " is ignored, because " + visibility.string() +
                            " with its views is missing; --rays nearest needs no views"));
}

TEST_F(FindInput, NeedsNoViewsForRaysNearest)
{
    fs::remove(visibility);
    for (const auto& [input, points] :
         {std::pair{dense, ""}, std::pair{dense, "dense"}, std::pair{fused, ""}}) {
        const FoundInput found =
            find_input(input, {.points = points, .visibility = {}, .rays = RaysFrom::nearest});
        ASSERT_TRUE(found.dense);
        EXPECT_EQ(found.dense->cloud, fused);
        EXPECT_TRUE(found.dense->visibility.empty());
        EXPECT_THAT(found.notes,
                    ElementsAre(::testing::StartsWith(
                        "points are read from " + fused.string() +
                        "; no file has their views, so they get the nearest views of " +
                        (dense / "sparse").string() + " with an unobstructed line to them")));
    }
}

TEST_F(FindInput, NotesAnUnusedDenseWorkspace)
{
    folder.copy(dense / "sparse", "sparse/0");
    FoundInput found = find_input(folder.path(), {});
    EXPECT_FALSE(found.dense);
    EXPECT_EQ(found.model.folder, folder.path() / "sparse/0");
    EXPECT_THAT(found.notes, ElementsAre("sparse points are used; the input " + dense.string() +
                                         " selects the points of " + fused.string()));
    fs::rename(dense, folder / "other");
    EXPECT_THAT(find_input(folder.path(), {}).notes, IsEmpty());
}

TEST_F(FindInput, RefusesPipes)
{
    const std::string pipe = folder / "pipe.ply";
    ::mkfifo(pipe.c_str(), 0600);
    EXPECT_EQ(refused(dense / "sparse", {.points = pipe}),
              pipe +
                  ": found something that is not a file; expected dense points for the views of " +
                  (dense / "sparse").string());
    EXPECT_THAT(
        refused(dense, {.points = fused, .visibility = pipe}),
        ::testing::StartsWith(pipe + ": found something that is not a file; expected the views"));
    EXPECT_THAT(
        refused(dense, {.points = pipe, .scanner = {{0, 0, 0}}}),
        ::testing::StartsWith(pipe + ": found something that is not a file; expected a PLY"));
}

TEST_F(FindInput, RefusesMissingCloudsOrViews)
{
    EXPECT_EQ(refused(dense / "sparse", {.points = "dense"}),
              (dense / "sparse/fused.ply").string() +
                  ": the file does not exist; expected dense points for the views of " +
                  (dense / "sparse").string());
    fs::remove(visibility);
    const std::string missing =
        visibility.string() + ": the file does not exist; expected the views of the points of " +
        fused.string() +
        ", as written by COLMAP's stereo_fusion (--visibility selects another file, "
        "--rays nearest needs none)";
    EXPECT_EQ(refused(dense, {.points = "dense"}), missing);
    EXPECT_EQ(refused(fused, {}), missing);
}

TEST_F(FindInput, RefusesContradictoryOptions)
{
    EXPECT_EQ(misused(fused, {.points = "sparse"}),
              "--points sparse selects the points of a model, "
              "but " +
                  fused.string() + " is a point cloud");
    EXPECT_EQ(misused(dense, {.points = "sparse", .visibility = "a.vis"}),
              "--visibility a.vis is for the points of a PLY file, but the sparse points of " +
                  (dense / "sparse").string() + " are used");
    EXPECT_EQ(misused(dense, {.points = {}, .visibility = "a.vis", .rays = RaysFrom::nearest}),
              "--rays nearest reads no file, so it cannot be combined with --visibility a.vis");
}

TEST_F(FindInput, AppliesRaysNearestToSparsePoints)
{
    const FoundInput found =
        find_input(dense, {.points = "sparse", .visibility = {}, .rays = RaysFrom::nearest});
    EXPECT_FALSE(found.dense);
    EXPECT_EQ(found.rays, RaysFrom::nearest);
}

TEST_F(FindInput, NeedsNoModelPointsWithACloud)
{
    fs::remove(dense / "sparse/points3D.bin");
    EXPECT_EQ(find_input(dense, {}).dense->cloud, fused);
    EXPECT_EQ(find_input(fused, {}).dense->cloud, fused);
    EXPECT_EQ(find_input(dense / "sparse", {.points = fused}).dense->cloud, fused);
    EXPECT_THAT(refused(dense / "sparse", {}), ::testing::HasSubstr("without points3D.bin"));
}

TEST_F(FindInput, UsesPoints3dPlyIfTheModelHasNoPoints)
{
    const fs::path sparse = dense / "sparse";
    fs::copy(fused, sparse / "points3D.ply");
    EXPECT_FALSE(find_input(sparse, {}).dense) << "points3D.bin has points";
    for (const bool is_empty : {true, false}) {
        fs::remove(sparse / "points3D.bin");
        if (is_empty) folder.write("dense/sparse/points3D.bin", std::string(8, '\0'));
        const FoundInput found = find_input(sparse, {});
        ASSERT_TRUE(found.dense);
        EXPECT_EQ(found.dense->cloud, sparse / "points3D.ply");
        EXPECT_TRUE(found.dense->visibility.empty());
        EXPECT_THAT(found.notes, ElementsAre(::testing::HasSubstr("the nearest views of")));
    }
    fs::copy(visibility, sparse / "points3D.ply.vis");
    EXPECT_EQ(find_input(sparse, {}).dense->visibility, sparse / "points3D.ply.vis");
    fs::remove(sparse / "points3D.ply.vis");
    EXPECT_THAT(refused(sparse, {.rays = RaysFrom::file}),
                ::testing::HasSubstr("points3D.ply.vis"));
}

TEST_F(FindInput, NotesTruncatedPointsReplacedByPoints3dPly)
{
    const fs::path sparse = dense / "sparse";
    const std::string bytes = bytes_of(sparse / "points3D.bin");
    fs::copy(fused, sparse / "points3D.ply");
    folder.write("dense/sparse/points3D.bin", bytes.substr(0, 60));
    const FoundInput found = find_input(sparse, {});
    EXPECT_EQ(found.dense->cloud, sparse / "points3D.ply");
    EXPECT_THAT(found.notes,
                Contains(AllOf(::testing::StartsWith((sparse / "points3D.bin").string() +
                                                     ": byte 0: found a count of "),
                               ::testing::HasSubstr("but the rest of the file can hold 1 at most"),
                               ::testing::EndsWith("; copy it again to use its points"))));
}

TEST_F(FindInput, ExplainsHowToConvertOtherFormats)
{
    folder.write("splats/cameras.json", R"([{"id": 0, "img_name": "a"}])");
    EXPECT_THAT(refused(folder / "splats", {}), ::testing::HasSubstr("of 3D Gaussian splatting"));
    folder.write("opensfm/reconstruction.json", R"([{"cameras": {}, "shots": {}}])");
    EXPECT_THAT(refused(folder / "opensfm", {}), ::testing::HasSubstr("opensfm export_colmap"));
    folder.write("openmvg/sfm_data.json", R"({"sfm_data_version": "0.3"})");
    EXPECT_THAT(refused(folder / "openmvg", {}),
                ::testing::HasSubstr("openMVG_main_openMVG2Colmap"));
    for (const char* const name : {"a.sfm", "b.xml", "c.splat", "d.spz"}) {
        EXPECT_THAT(
            refused(folder.write(name, "x"), {}),
            ::testing::AnyOf(::testing::HasSubstr("and give "), ::testing::HasSubstr("--points")))
            << name;
    }
}

/// A dense workspace with a scan.
class FindScan : public FindInput {
  protected:
    /// Copies the scan of a fixture to the workspace.
    void take(const char* format)
    {
        fs::copy(fixtures_folder() / "formats" / format / "scan.ply", scan);
    }
    std::string taken_scan() const
    {
        return "points are read from " + scan.string() + " with the scanner ";
    }

    fs::path scan = dense / "scan.ply";
};

TEST_F(FindScan, PrefersScannerPositionsOfPointsToViews)
{
    take("scan_origin");
    const fs::path views = folder.write("dense/scan.ply.vis", "");
    const FoundInput found = find_input(scan, {});
    ASSERT_TRUE(found.scan);
    EXPECT_EQ(found.scan->cloud, scan);
    EXPECT_FALSE(found.scan->scanner);
    const std::string by_each = "position of each point; ";
    EXPECT_THAT(found.notes, ElementsAre(taken_scan() + by_each + views.string() +
                                         " is ignored (--visibility selects it)"));
    const FoundInput beside = find_input(dense, {.points = scan});
    EXPECT_TRUE(beside.scan);
    EXPECT_THAT(beside.notes, ElementsAre(taken_scan() + by_each + "the views of " +
                                          (dense / "sparse").string() + " are ignored"));
}

TEST_F(FindScan, UsesViewsIfOptionsSelectThem)
{
    take("scan_origin");
    const FoundInput nearest =
        find_input(scan, {.points = {}, .visibility = {}, .rays = RaysFrom::nearest});
    EXPECT_FALSE(nearest.scan);
    EXPECT_TRUE(nearest.dense);
    EXPECT_EQ(find_input(scan, {.points = {}, .visibility = visibility}).dense->visibility,
              visibility);
}

TEST_F(FindScan, UsesPclsCameraWithoutAVisibilityFile)
{
    take("scan_camera");
    const FoundInput found = find_input(scan, {});
    EXPECT_TRUE(found.scan);
    EXPECT_THAT(found.notes, ElementsAre(taken_scan() + "position of its element camera"));
    folder.write("dense/scan.ply.vis", "");
    EXPECT_TRUE(find_input(scan, {}).dense);
}

TEST_F(FindScan, UsesTheScannerOption)
{
    take("scan_camera");
    const FoundInput found = find_input(scan, {.scanner = Eigen::Vector3d(1, 2.5, -3)});
    EXPECT_EQ(found.scan->scanner, Eigen::Vector3d(1, 2.5, -3));
    EXPECT_THAT(found.notes, ElementsAre(taken_scan() + "at 1, 2.5, -3"));
    EXPECT_TRUE(find_input(dense, {.points = "dense", .scanner = Eigen::Vector3d::Zero()}).scan);
}

TEST_F(FindScan, RefusesContradictoryScannerOptions)
{
    take("scan_origin");
    const Eigen::Vector3d place(1, 2.5, -3);
    EXPECT_EQ(misused(scan, {.scanner = place}),
              "--scanner 1,2.5,-3 is one position for all points, but " + scan.string() +
                  " has a scanner position for each point");
    EXPECT_EQ(
        misused(scan,
                {.points = {}, .visibility = {}, .rays = RaysFrom::nearest, .scanner = place}),
        "--scanner 1,2.5,-3 gives the scanner position, so it cannot be combined with "
        "--rays nearest");
    EXPECT_EQ(misused(scan, {.points = {}, .visibility = "a.vis", .scanner = place}),
              "--scanner 1,2.5,-3 gives the scanner position, so it cannot be combined with "
              "--visibility a.vis");
    EXPECT_EQ(misused(dense / "sparse", {.scanner = place}),
              "--scanner 1,2.5,-3 is for the points of a PLY file, but the sparse points of " +
                  (dense / "sparse").string() + " are used");
    EXPECT_EQ(refused(dense, {.points = "none.ply", .scanner = place}),
              "none.ply: the file does not exist; expected a PLY file of scanned points");
}

/// A transforms.json of nerfstudio without images; these tests do not read its poses.
const std::string kTransforms = R"({"frames": [{}]})";

TEST_F(FindInput, ReadsTransformsWithPointsAndNearestViews)
{
    const fs::path json = folder.write("nerf/transforms.json", kTransforms);
    const fs::path cloud = folder.write("nerf/sparse_pc.ply", "ply\n");
    const fs::path other = folder.write("other.ply", "ply\n");
    EXPECT_TRUE(find_input(json, {}).takes_nearest_views());
    for (const fs::path& input : {json, folder / "nerf"}) {
        const FoundInput found = find_input(input, {});
        ASSERT_TRUE(found.dense);
        EXPECT_EQ(found.model.folder, json);
        EXPECT_EQ(found.dense->model, json);
        EXPECT_EQ(found.dense->format, ModelFormat::transforms);
        EXPECT_EQ(found.dense->cloud, cloud);
        EXPECT_EQ(found.dense->visibility, fs::path());
        EXPECT_THAT(found.notes,
                    ElementsAre("points are read from " + cloud.string() +
                                "; no file has their views, so they get the nearest views of " +
                                json.string() + " with an unobstructed line to them"));
        EXPECT_TRUE(found.dense->are_sparse);
        EXPECT_EQ(find_input(input, {.points = other}).dense->cloud, other);
        EXPECT_FALSE(find_input(input, {.points = other}).dense->are_sparse);
    }
}

TEST_F(FindInput, RefusesTransformsWithoutPoints)
{
    const fs::path json = folder.write("ngp/transforms.json", kTransforms);
    EXPECT_EQ(refused(folder / "ngp", {}),
              json.string() + ": has no ply_file_path, and its folder has no sparse_pc.ply or "
                              "points3D.ply; select a PLY file in the frame of the poses with "
                              "--points FILE");
    EXPECT_THAT(refused(json, {.points = folder / "nothing.ply"}),
                ::testing::HasSubstr("nothing.ply: the file does not exist"));
    EXPECT_THAT(refused(json, {.points = "dense"}),
                ::testing::HasSubstr("ngp/fused.ply: the file does not exist"));
}

TEST_F(FindInput, PrefersModelsWithTracksToTransforms)
{
    folder.copy(fixtures_folder() / "formats/rich_bin", "nerf/colmap/sparse/0");
    const fs::path json = folder.write("nerf/transforms.json", kTransforms);
    folder.write("nerf/sparse_pc.ply", "ply\n");
    EXPECT_EQ(find_input(folder / "nerf", {}).model.folder, folder / "nerf/colmap/sparse/0");
    EXPECT_EQ(find_input(json, {}).model.folder, json);
}

TEST_F(FindInput, UsesTheListsOfACloudWithoutAVisibilityFile)
{
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                               "property float y\nproperty float z\n"
                               "property list uchar uint view_indices\nend_header\n";
    const fs::path cloud = folder.write("dense/scene_dense.ply", header);
    for (const auto& [input, points] : {std::pair(cloud, ""), std::pair(dense, cloud.c_str())}) {
        const FoundInput found = find_input(input, {.points = points});
        ASSERT_TRUE(found.dense);
        EXPECT_TRUE(found.dense->takes_lists);
        EXPECT_EQ(found.dense->visibility, fs::path());
        EXPECT_THAT(found.notes,
                    ElementsAre("points are read from " + cloud.string() + ", with the views of " +
                                (dense / "sparse").string() + " in their lists view_indices"));
    }
    EXPECT_FALSE(find_input(cloud, {.rays = RaysFrom::nearest}).dense->takes_lists);
    EXPECT_EQ(find_input(cloud, {.visibility = visibility}).dense->visibility, visibility);
    folder.write("dense/scene_dense.ply.vis", "");
    EXPECT_FALSE(find_input(cloud, {}).dense->takes_lists);
}

} // namespace

namespace {

TEST(InputFiles, IncludeTheModelAndItsProject)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "sparse/0", 12);
    folder.write("sparse/0/rigs.txt", "");
    folder.write("sparse/0/mesh.ply", "");
    folder.write("images/left/1.jpg", "");
    const auto files = input_files(folder.path(), find_input(folder.path(), {}));
    EXPECT_THAT(files, AllOf(Contains(folder / "sparse/0/cameras.txt"),
                             Contains(folder / "sparse/0/rigs.txt"),
                             Contains(folder / "images/left/1.jpg"),
                             Not(Contains(folder / "sparse/0/mesh.ply"))));
}

TEST(InputFiles, IncludeTheCloudAndItsViews)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "sparse", 12);
    const auto scan = folder.write("far/scan.ply", "");
    const auto views = folder.write("far/scan.ply.vis", "");
    const PointsOptions options = {.points = scan, .rays = RaysFrom::nearest};
    EXPECT_THAT(input_files(folder / "sparse", find_input(folder / "sparse", options)),
                AllOf(Contains(scan), Contains(views)));
}

TEST(InputFiles, IncludeTransformsAndTheirPoints)
{
    const TemporaryFolder folder;
    const auto json = folder.write("t/poses.json", R"({"frames": [{}]})");
    const auto points = folder.write("points.ply", "");
    EXPECT_THAT(input_files(json, find_input(json, {.points = points})),
                AllOf(Contains(json), Contains(points)));
}

TEST(IsImageOfViews, ComparesTheEndOfThePath)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "sparse", 12);
    const FoundInput found = find_input(folder / "sparse", {});
    EXPECT_TRUE(is_image_of_views(folder.write("shots/-y.jpg", ""), found));
    EXPECT_FALSE(is_image_of_views(folder.write("shots/a-y.jpg", ""), found));
    std::filesystem::create_symlink(folder / "shots/-y.jpg", folder / "link.jpg");
    EXPECT_TRUE(is_image_of_views(folder / "link.jpg", found));
}

} // namespace

} // namespace
} // namespace vcarve::find_input_test
