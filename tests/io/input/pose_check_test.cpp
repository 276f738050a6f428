#include "io/colmap/colmap_model.h"
#include "io/input/pose_check.h"
#include "support/ball_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::pose_check_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A ball off the middle, whose views stand around it and are rolled, so that no pose is its own
/// inverse.
Scene ball_of_views()
{
    const TemporaryFolder folder;
    write_ball_model(folder.path(), 150, {7, -5, 3});
    Scene scene = read_colmap_model(folder.path(), ModelFormat::text);
    for (View& view : scene.views) {
        view.cam_from_world =
            Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()) * view.cam_from_world;
    }
    return scene;
}

/// What a reader makes of the inverse of a pose.
void turn_round(View& view)
{
    view.center = -(view.cam_from_world * view.center);
    view.cam_from_world = view.cam_from_world.conjugate();
}

TEST(WarningOfPoses, IsEmptyWhereImagesShowWhatTheySaw)
{
    Scene scene = ball_of_views();
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
    turn_round(scene.views[2]); // one of six
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
}

TEST(WarningOfPoses, KnowsPosesThatAreInverse)
{
    Scene scene = ball_of_views();
    for (View& view : scene.views) {
        turn_round(view);
    }
    EXPECT_THAT(warning_of_poses(scene, "a/images.txt"),
                HasSubstr("a/images.txt seems to hold camera-to-world"));
}

TEST(WarningOfPoses, KnowsPosesAndPointsOfTwoFrames)
{
    Scene scene = ball_of_views();
    for (Eigen::Vector3d& position : scene.positions) {
        position += Eigen::Vector3d(40, 30, 20);
    }
    EXPECT_THAT(warning_of_poses(scene, "images.bin"),
                ::testing::AllOf(StartsWith("100 % of the sights are of points that do not show"),
                                 HasSubstr("do not seem to belong together")));
}

TEST(WarningOfPoses, AsksAllImagesWhereThereAreNoSights)
{
    Scene scene = ball_of_views();
    scene.tracks = {};
    scene.tracks.begins.assign(scene.num_points() + 1, 0);
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
    for (View& view : scene.views) {
        turn_round(view);
    }
    EXPECT_THAT(warning_of_poses(scene, "images.txt"),
                StartsWith("few points show in the images, but do with the inverse poses"));
    scene.positions.assign(scene.num_points(), {90, 90, 90});
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
}

TEST(WarningOfPoses, IsEmptyWhereTheLensIsNotKnown)
{
    Scene scene = ball_of_views();
    for (View& view : scene.views) {
        turn_round(view);
    }
    scene.cameras.front().model = -1;
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
}

TEST(WarningOfFrames, IsGivenWhereMostPointsShowInNoImage)
{
    Scene scene = ball_of_views();
    EXPECT_THAT(warning_of_frames(scene, "a.ply", "transforms.json"), IsEmpty());
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (i % 3 != 0) scene.positions[i] *= 1000.0;
    }
    EXPECT_EQ(warning_of_frames(scene, "a.ply", "transforms.json"),
              "67 % of the points of a.ply show in no image of transforms.json: they seem to stand "
              "in another frame than the poses, so the surface will be wrong");
    EXPECT_THAT(warning_of_frames({}, "a.ply", "transforms.json"), IsEmpty());
}

} // namespace
} // namespace vcarve::pose_check_test
