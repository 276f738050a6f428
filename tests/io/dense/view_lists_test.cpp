#include "io/dense/dense_scene.h"
#include "io/dense/view_lists.h"
#include "support/ball_model.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

namespace vcarve::view_lists_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Rows = std::vector<std::vector<std::uint32_t>>;

const fs::path kWorkspace = fixtures_folder() / "formats/dense_little";

/// The points of the fixture with lists beside them, as OpenMVS writes them.
std::string cloud_with_lists(const std::vector<std::string>& lists)
{
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nproperty list uchar uint view_indices\n"
           "property list uchar float view_weights\nend_header\n0.5 0.25 4 " +
           lists[0] + "\n-0.125 3 5 " + lists[1] + "\n1.5 -2 6 " + lists[2] + "\n";
}

class ViewLists : public ::testing::Test {
  protected:
    Scene read(const std::vector<std::string>& lists)
    {
        const fs::path cloud = folder_.write("scene_dense.ply", cloud_with_lists(lists));
        notes.clear();
        return read_dense_scene({kWorkspace / "sparse", ModelFormat::binary, cloud, {}, true}, {},
                                &notes);
    }
    std::string file() const { return (folder_ / "scene_dense.ply").string(); }

    std::vector<std::string> notes;

  private:
    TemporaryFolder folder_;
};

TEST(TracksOfLists, CountImagesAsTheyStandInTheirFile)
{
    Scene scene;
    scene.cameras.resize(1); // without a size: it shows all that is before it
    scene.views.resize(3);
    scene.positions.assign(3, Eigen::Vector3d(0, 0, 1));
    Tracks lists;
    for (const std::vector<std::uint32_t>& row : Rows{{2, 0, 2}, {1}, {}}) {
        lists.push_back(row);
    }
    const std::vector<std::uint32_t> file_order = {1, 2, 0};
    std::string note;
    const auto tracks = tracks_of_lists(lists, file_order, scene, note);
    ASSERT_TRUE(tracks) << note;
    EXPECT_THAT(tracks->begins, ElementsAre(0, 2, 3, 3));
    EXPECT_THAT(tracks->views, ElementsAre(0, 1, 2));
}

TEST(TracksOfLists, AreThoseOfAnotherModelWhereImagesDoNotShowThePoints)
{
    const Scene scene =
        read_colmap_model(fixtures_folder() / "scene/sparse/0", ModelFormat::binary);
    std::vector<std::uint32_t> file_order(scene.views.size());
    std::iota(file_order.begin(), file_order.end(), 0U);
    std::string note;
    const auto tracks = tracks_of_lists(scene.tracks, file_order, scene, note);
    ASSERT_TRUE(tracks) << note;
    EXPECT_EQ(tracks->views, scene.tracks.views);
    EXPECT_EQ(note, "");

    Scene other = scene; // whose cameras look the other way
    for (View& view : other.views) {
        view.cam_from_world =
            Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitY()) * view.cam_from_world;
    }
    EXPECT_FALSE(tracks_of_lists(scene.tracks, file_order, other, note));
    EXPECT_EQ(note, "100 % of the points do not show in the images that its lists view_indices "
                    "name, which seem to be those of another model, so the nearest views are taken "
                    "instead");
}

TEST(ViewListsOfBall, AreTheTracksOfACloud)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "sparse", 60);
    const Scene ball = read_colmap_model(folder / "sparse", ModelFormat::text);
    std::string bytes = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\n"
                                    "property list ushort int view_indices\nproperty double x\n"
                                    "property double y\nproperty double z\nend_header\n",
                                    ball.num_points());
    for (std::size_t i = 0; i < ball.num_points(); ++i) {
        bytes += fmt::format("{} {} {}\n", ball.tracks[i].size(), fmt::join(ball.tracks[i], " "),
                             fmt::join(ball.positions[i], " "));
    }
    const fs::path cloud = folder.write("scene_dense.ply", bytes);
    std::vector<std::string> notes;
    const Scene scene =
        read_dense_scene({folder / "sparse", ModelFormat::text, cloud, {}, true}, {}, &notes);
    EXPECT_THAT(notes, IsEmpty());
    EXPECT_EQ(scene.tracks.begins, ball.tracks.begins);
    EXPECT_EQ(scene.tracks.views, ball.tracks.views);
    EXPECT_EQ(scene.positions, ball.positions);
}

TEST_F(ViewLists, AreLeftOutWhereTheyNameImagesThatAreNotThere)
{
    const Scene scene = read({"2 0 3 0", "1 1 0", "0 0"});
    EXPECT_THAT(notes, ElementsAre(file() + ": its lists view_indices name image 3, but the model "
                                            "has 3, counted from 0, so the nearest views are taken "
                                            "instead"));
    expect_well_formed(scene);
}

TEST_F(ViewLists, AreRefusedWhereTheyAreNoNumbersOfImages)
{
    EXPECT_EQ(refusal<InputError>([&] {
                  read({"1 -1 0", "0 0", "0 0"});
              }),
              file() + ": vertex 0 of 3: its list view_indices names image -1");
}

} // namespace
} // namespace vcarve::view_lists_test
