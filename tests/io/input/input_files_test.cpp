#include "io/input/input_files.h"
#include "support/ball_model.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::input_files_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Not;

TEST(InputFiles, AreThoseOfTheModelAndOfTheProjectAround)
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

TEST(InputFiles, AreTheCloudAndItsViews)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "sparse", 12);
    const auto scan = folder.write("far/scan.ply", "");
    const auto views = folder.write("far/scan.ply.vis", "");
    const PointsOptions options = {.points = scan, .sights = SightsFrom::nearest};
    EXPECT_THAT(input_files(folder / "sparse", find_input(folder / "sparse", options)),
                AllOf(Contains(scan), Contains(views)));
}

TEST(InputFiles, AreTransformsAndTheirPoints)
{
    const TemporaryFolder folder;
    const auto json = folder.write("t/poses.json", R"({"frames": [{}]})");
    const auto points = folder.write("points.ply", "");
    EXPECT_THAT(input_files(json, find_input(json, {.points = points})),
                AllOf(Contains(json), Contains(points)));
}

TEST(IsImageOfViews, GoesByTheEndOfThePath)
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
} // namespace vcarve::input_files_test
