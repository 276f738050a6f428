#include "io/input/complete_sights.h"
#include "support/ball_model.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace vcarve::complete_sights_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A ball, of whose points the tracks are written as a test wants them.
class CompleteSights : public ::testing::Test {
  protected:
    CompleteSights()
    {
        write_ball_model(folder.path(), kPoints);
        whole = read();
    }
    Scene read() const { return read_colmap_model(folder.path(), ModelFormat::text); }

    /// Leaves of each track what `kept` makes of it.
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
    /// Writes the sights into the 2D points of the images instead.
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

    std::vector<std::string> complete(SightsFrom from = SightsFrom::automatic)
    {
        const FoundInput found = {.model = {folder.path(), ModelFormat::text, {}},
                                  .dense = {},
                                  .scan = {},
                                  .notes = {},
                                  .sights = from};
        DroppedSights dropped;
        scene = read_colmap_model(folder.path(), ModelFormat::text, {}, &dropped);
        return complete_sights(found, dropped, scene);
    }

    static constexpr int kPoints = 700;
    TemporaryFolder folder;
    Scene whole;
    Scene scene;
};

TEST_F(CompleteSights, LeavesGoodTracksAlone)
{
    EXPECT_THAT(complete(), IsEmpty());
    EXPECT_EQ(scene.tracks.views, whole.tracks.views);
    // Fewer than half of them have none.
    rewrite_tracks([](std::size_t i) { return i % 5 < 2 ? "" : "1 0 3 0"; });
    EXPECT_THAT(complete(), IsEmpty());
    EXPECT_THAT(scene.tracks[0], IsEmpty());
}

TEST_F(CompleteSights, TakesWhatThePointsOfImagesTell)
{
    write_points2d();
    for (const char* const track : {"", "0 0", "-1 -1"}) {
        rewrite_tracks([&](std::size_t /*point*/) { return track; });
        EXPECT_THAT(complete(),
                    ElementsAre(HasSubstr("the 2D points of " + (folder / "images.txt").string() +
                                          " tell which views saw ")));
        EXPECT_EQ(scene.tracks.begins, whole.tracks.begins) << track;
        EXPECT_EQ(scene.tracks.views, whole.tracks.views) << track;
    }
}

TEST_F(CompleteSights, TakesTheNearestViewsWhereNothingTells)
{
    rewrite_tracks([](std::size_t /*point*/) { return ""; });
    EXPECT_THAT(complete(),
                ElementsAre(HasSubstr("nothing tells of 700 of 700 points which two views saw")));
    std::size_t true_sights = 0;
    for (std::size_t i = 0; i < whole.num_points(); ++i) {
        for (const std::uint32_t view : scene.tracks[i]) {
            true_sights += whole.positions[i].dot(whole.views[view].center) > 1.0 ? 1 : 0;
        }
    }
    EXPECT_GT(scene.num_sights(), whole.num_sights() * 3 / 4);
    EXPECT_GT(true_sights, scene.num_sights() * 3 / 4) << "the ball hides its other side";
}

TEST_F(CompleteSights, KeepsTheViewsThatAreKnown)
{
    rewrite_tracks([](std::size_t i) { return i % 9 == 0 ? "2 0 6 0" : "4 0"; });
    EXPECT_THAT(complete(), ElementsAre(HasSubstr("nothing tells of 622 of 700 points")));
    EXPECT_GT(scene.num_sights(), 2 * scene.num_points());
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (i % 9 == 0) {
            EXPECT_THAT(scene.tracks[i], ElementsAre(1U, 5U));
        } else {
            EXPECT_EQ(std::ranges::count(scene.tracks[i], 3U), 1);
        }
    }
}

TEST_F(CompleteSights, GoesByWhatTheUserSays)
{
    EXPECT_THAT(complete(SightsFrom::nearest), ElementsAre(HasSubstr("the nearest views")));
    EXPECT_NE(scene.tracks.views, whole.tracks.views);
    rewrite_tracks([](std::size_t /*point*/) { return "5 0"; });
    EXPECT_THAT(complete(SightsFrom::file), IsEmpty());
    EXPECT_EQ(scene.num_sights(), scene.num_points());
}

TEST_F(CompleteSights, TellsOfSightsThatWereDropped)
{
    rewrite_tracks([](std::size_t i) { return i == 3 ? "1 0 2 0 11 0" : "1 0 2 0 0 0"; });
    EXPECT_THAT(complete(), ElementsAre("1 sights are left out, for they are of 1 image that " +
                                        (folder / "images.txt").string() + " does not have (11)"));
    rewrite_tracks([](std::size_t /*point*/) { return "1 0 12 0 3 0 13 0"; });
    EXPECT_THAT(complete(), ElementsAre(HasSubstr("1,400 sights are left out, for they are of 2 "
                                                  "images")));
}

} // namespace
} // namespace vcarve::complete_sights_test
