#include "io/colmap/colmap_model.h"
#include "io/input/complete_rays.h"
#include "support/ball_model.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace vcarve::complete_rays_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

namespace {

/// A model of a ball with modified tracks.
class CompleteRays : public ::testing::Test {
  protected:
    CompleteRays()
    {
        write_ball_model(folder.path(), kPoints);
        whole = read();
    }
    Scene read() const { return read_colmap_model(folder.path(), ModelFormat::text); }

    /// Replaces the track of point i by kept(i).
    template <typename Kept>
    void rewrite_tracks(const Kept& kept) const
    {
        std::istringstream points(bytes_of(folder / "points3D.txt"));
        std::string line;
        std::string text;
        for (std::size_t i = 0; std::getline(points, line); ++i) {
            std::istringstream words(line);
            std::string word;
            for (int field = 0; field < 8 && words >> word; ++field) {
                text += word + " ";
            }
            text += std::string(kept(i)) + "\n";
        }
        folder.write("points3D.txt", text);
    }
    /// Writes the rays to the 2D points of the images.
    void write_points2d() const
    {
        std::istringstream images(bytes_of(folder / "images.txt"));
        std::string line;
        std::string text;
        for (std::uint32_t view = 0; std::getline(images, line); ++view) {
            text += line + "\n";
            std::getline(images, line);
            for (std::size_t i = 0; i < whole.num_points(); ++i) {
                const auto row = whole.tracks[i];
                const bool sees = std::ranges::count(row, view) > 0;
                text += "1.5 2 " + (sees ? std::to_string(whole.point_ids[i]) : "-1") + " ";
            }
            text += "\n";
        }
        folder.write("images.txt", text);
    }

    std::vector<std::string> complete(RaysFrom from = RaysFrom::automatic)
    {
        FoundInput found = {.model = {folder.path(), ModelFormat::text, {}},
                            .dense = {},
                            .scan = {},
                            .notes = {},
                            .rays = from};
        DroppedRays dropped;
        scene = read_colmap_model(folder.path(), ModelFormat::text, {}, &dropped);
        return complete_rays(found, dropped, scene);
    }

    static constexpr int kPoints = 700;
    TemporaryFolder folder;
    Scene whole;
    Scene scene;
};

TEST_F(CompleteRays, KeepsGoodTracks)
{
    EXPECT_THAT(complete(), IsEmpty());
    EXPECT_EQ(scene.tracks.views, whole.tracks.views);
    // Fewer than half of the points have no track.
    rewrite_tracks([](std::size_t i) { return i % 5 < 2 ? "" : "1 0 3 0"; });
    EXPECT_THAT(complete(), IsEmpty());
    EXPECT_THAT(scene.tracks[0], IsEmpty());
}

TEST_F(CompleteRays, UsesThe2dPointsOfImages)
{
    write_points2d();
    for (const char* const track : {"", "0 0", "-1 -1"}) {
        rewrite_tracks([&](std::size_t /*point*/) { return track; });
        EXPECT_THAT(complete(),
                    ElementsAre(HasSubstr("the 2D points of " + (folder / "images.txt").string() +
                                          " supply views of ")));
        EXPECT_EQ(scene.tracks.begins, whole.tracks.begins) << track;
        EXPECT_EQ(scene.tracks.views, whole.tracks.views) << track;
    }
}

TEST_F(CompleteRays, UsesTheNearestViewsWithoutOtherSources)
{
    rewrite_tracks([](std::size_t /*point*/) { return ""; });
    EXPECT_THAT(complete(),
                ElementsAre(HasSubstr("700 of 700 points have fewer than two views, so they get")));
    std::size_t true_rays = 0;
    for (std::size_t i = 0; i < whole.num_points(); ++i) {
        for (const std::uint32_t view : scene.tracks[i]) {
            true_rays += whole.positions[i].dot(whole.views[view].center) > 1.0 ? 1 : 0;
        }
    }
    EXPECT_GT(scene.num_rays(), whole.num_rays() * 3 / 4);
    EXPECT_GT(true_rays, scene.num_rays() * 3 / 4) << "the ball occludes its other side";
}

TEST_F(CompleteRays, KeepsKnownViews)
{
    rewrite_tracks([](std::size_t i) { return i % 9 == 0 ? "2 0 6 0" : "4 0"; });
    EXPECT_THAT(complete(), ElementsAre(HasSubstr("622 of 700 points have fewer")));
    EXPECT_GT(scene.num_rays(), 2 * scene.num_points());
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (i % 9 == 0) {
            EXPECT_THAT(scene.tracks[i], ElementsAre(1U, 5U));
        } else {
            EXPECT_EQ(std::ranges::count(scene.tracks[i], 3U), 1);
        }
    }
}

TEST_F(CompleteRays, FollowsTheRaysOption)
{
    EXPECT_THAT(complete(RaysFrom::nearest), ElementsAre(HasSubstr("the nearest views")));
    EXPECT_NE(scene.tracks.views, whole.tracks.views);
    rewrite_tracks([](std::size_t /*point*/) { return "5 0"; });
    EXPECT_THAT(complete(RaysFrom::file), IsEmpty());
    EXPECT_EQ(scene.num_rays(), scene.num_points());
}

TEST_F(CompleteRays, NotesDroppedRays)
{
    rewrite_tracks([](std::size_t i) { return i == 3 ? "1 0 2 0 11 0" : "1 0 2 0 0 0"; });
    EXPECT_THAT(complete(), ElementsAre("dropped 1 ray to 1 image missing in " +
                                        (folder / "images.txt").string() + " (11)"));
    rewrite_tracks([](std::size_t /*point*/) { return "1 0 12 0 3 0 13 0"; });
    EXPECT_THAT(complete(), ElementsAre(HasSubstr("dropped 1,400 rays to 2 images")));
}

} // namespace

namespace {

Scene three_points()
{
    Scene scene = make_scene({{0, 0, 9}, {3, 0, 9}},
                             {{{1, 0, 0}, {0, 1}}, {{2, 0, 0}, {0, 1}}, {{0, 1, 0}, {0, 1}}});
    scene.colors = {{7, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    scene.errors_px = {0.0, 0.3, 0.0};
    return scene;
}

TEST(ForgetUnknownValues, KeepsKnownValues)
{
    Scene scene = three_points();
    EXPECT_THAT(forget_unknown_values(scene), IsEmpty());
    EXPECT_THAT(scene.errors_px, ElementsAre(0.0, 0.3, 0.0));
}

TEST(ForgetUnknownValues, TreatsAllZeroErrorsAsUnknown)
{
    Scene scene = three_points();
    scene.errors_px.assign(3, 0.0);
    EXPECT_THAT(forget_unknown_values(scene), ElementsAre(HasSubstr("error of every point is 0")));
    EXPECT_THAT(scene.errors_px, Each(-1.0));
}

TEST(ForgetUnknownValues, NotesMissingColors)
{
    Scene scene = three_points();
    scene.colors.assign(3, {0, 0, 0});
    EXPECT_THAT(forget_unknown_values(scene), ElementsAre(HasSubstr("the points have no colors")));
}

TEST(ForgetUnknownValues, ReturnsNoNotesWithoutPoints)
{
    Scene scene;
    EXPECT_THAT(forget_unknown_values(scene), IsEmpty());
}

} // namespace

namespace {

/// An off-center ball with views around it, which are rolled so that no pose is its own inverse.
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

/// Replaces a pose by what a reader gets from its inverse.
void turn_round(View& view)
{
    view.center = -(view.cam_from_world * view.center);
    view.cam_from_world = view.cam_from_world.conjugate();
}

TEST(WarningOfPoses, IsEmptyIfPosesAreCorrect)
{
    Scene scene = ball_of_views();
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
    turn_round(scene.views[2]); // one of six views
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
}

TEST(WarningOfPoses, DetectsInversePoses)
{
    Scene scene = ball_of_views();
    for (View& view : scene.views) {
        turn_round(view);
    }
    EXPECT_THAT(warning_of_poses(scene, "a/images.txt"),
                HasSubstr("a/images.txt seems to contain camera-to-world"));
}

TEST(WarningOfPoses, DetectsDifferentFrames)
{
    Scene scene = ball_of_views();
    for (Eigen::Vector3d& position : scene.positions) {
        position += Eigen::Vector3d(40, 30, 20);
    }
    EXPECT_THAT(warning_of_poses(scene, "images.bin"),
                ::testing::AllOf(StartsWith("100 % of the rays have a point that does not"),
                                 HasSubstr("do not seem to match")));
}

TEST(WarningOfPoses, TestsAllImagesWithoutRays)
{
    Scene scene = ball_of_views();
    scene.tracks = {};
    scene.tracks.begins.assign(scene.num_points() + 1, 0);
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
    for (View& view : scene.views) {
        turn_round(view);
    }
    EXPECT_THAT(warning_of_poses(scene, "images.txt"),
                StartsWith("few points project into the images, unless poses are inverted"));
    scene.positions.assign(scene.num_points(), {90, 90, 90});
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
}

TEST(WarningOfPoses, IsEmptyForUnknownLenses)
{
    Scene scene = ball_of_views();
    for (View& view : scene.views) {
        turn_round(view);
    }
    scene.cameras.front().model = -1;
    EXPECT_THAT(warning_of_poses(scene, "images.txt"), IsEmpty());
}

TEST(WarningOfFrames, IsGivenIfMostPointsProjectIntoNoImage)
{
    Scene scene = ball_of_views();
    EXPECT_THAT(warning_of_frames(scene, "a.ply", "transforms.json"), IsEmpty());
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (i % 3 != 0) scene.positions[i] *= 1000.0;
    }
    EXPECT_EQ(warning_of_frames(scene, "a.ply", "transforms.json"),
              "67 % of the points of a.ply project into no image of transforms.json: points and "
              "poses seem to have different frames, so the mesh will be wrong");
    EXPECT_THAT(warning_of_frames({}, "a.ply", "transforms.json"), IsEmpty());
}

} // namespace

} // namespace
} // namespace vcarve::complete_rays_test
