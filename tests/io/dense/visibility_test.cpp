#include "io/dense/dense_scene.h"
#include "io/dense/visibility.h"
#include "support/ball_model.h"
#include "support/dense_workspace.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace vcarve::visibility_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

class Visibility : public ::testing::Test {
  protected:
    Tracks read(const Rows& rows, const std::vector<std::uint32_t>& file_order) const
    {
        VisibilityReader reader(folder.write("a.vis", visibility_bytes(rows)),
                                {rows.size(), "a.ply"}, file_order);
        return reader.next(rows.size());
    }

    TemporaryFolder folder;
};

TEST_F(Visibility, CountsImagesInFileOrder)
{
    const Tracks tracks = read({{0, 2}, {1}, {}, {0, 1, 2}}, {1, 2, 0});
    EXPECT_THAT(tracks.begins, ElementsAre(0, 2, 3, 3, 6));
    EXPECT_THAT(tracks.views, ElementsAre(0, 1, 2, 0, 1, 2));
}

TEST_F(Visibility, CountsARepeatedViewOnce)
{
    const Tracks tracks = read({{0}, {2, 1, 2, 2}, {1, 1}, {}, {2, 0}}, {0, 1, 2});
    EXPECT_THAT(tracks.begins, ElementsAre(0, 1, 3, 4, 4, 6));
    EXPECT_THAT(tracks.views, ElementsAre(0, 1, 2, 1, 0, 2));
}

TEST_F(Visibility, IsEmptyWithoutPoints)
{
    EXPECT_EQ(read({}, {0}).size(), 0U);
}

TEST_F(Visibility, MatchesASetPerRow)
{
    constexpr std::size_t kPoints = 20'000; // several ranges of rows
    constexpr std::uint32_t kImages = 40;
    std::mt19937 random(5);
    std::vector<std::uint32_t> file_order(kImages);
    std::iota(file_order.begin(), file_order.end(), 0U);
    std::ranges::shuffle(file_order, random);
    for (const bool repeats : {false, true}) {
        Rows rows(kPoints);
        for (auto& row : rows) {
            std::set<std::uint32_t> seen;
            for (std::uint32_t n = random() % 9; n > 0; --n) {
                const std::uint32_t image = random() % kImages;
                if (seen.insert(image).second || repeats) row.push_back(image);
            }
        }
        const Tracks tracks = read(rows, file_order);
        ASSERT_EQ(tracks.size(), kPoints);
        for (std::size_t i = 0; i < kPoints; ++i) {
            std::set<std::uint32_t> expected;
            for (const std::uint32_t image : rows[i]) {
                expected.insert(file_order[image]);
            }
            const auto row = tracks[i];
            ASSERT_TRUE(std::equal(row.begin(), row.end(), expected.begin(), expected.end())) << i;
        }
        EXPECT_EQ(tracks.begins.back(), tracks.views.size());
    }
}

TEST_F(Visibility, NamesTheFirstPointWithAnInvalidImage)
{
    Rows rows(50'000, {0, 1});
    rows[31'000] = {1, 2};
    rows[49'999] = {5};
    EXPECT_EQ(refusal<InputError>([&] {
                  read(rows, {0, 1});
              }),
              (folder / "a.vis").string() + ": point 31000 of 50000 has image 2, but the model "
                                            "has 2 images, counted from 0");
}

TEST_F(Visibility, IsReadInParts)
{
    VisibilityReader reader(
        folder.write("a.vis", visibility_bytes(Rows{{0, 2}, {1, 1}, {}, {0, 1, 2}, {5}})),
        {5, "a.ply"}, {1, 2, 0});
    const Tracks first = reader.next(3);
    EXPECT_THAT(first.begins, ElementsAre(0, 2, 3, 3));
    EXPECT_THAT(first.views, ElementsAre(0, 1, 2));
    EXPECT_THAT(reader.next(1).views, ElementsAre(0, 1, 2));
    EXPECT_EQ(refusal<InputError>([&] { reader.next(7); }),
              (folder / "a.vis").string() + ": point 4 of 5 has image 5, but the model has 3 "
                                            "images, counted from 0");
}

TEST_F(Visibility, IsRefusedWhereverTheFileIsTruncated)
{
    const std::string bytes = visibility_bytes(Rows{{0, 1}, {}, {1}});
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const auto path = folder.write("a.vis", bytes.substr(0, length));
        const std::vector<std::uint32_t> file_order{0, 1};
        const auto read_all = [&] { VisibilityReader(path, {3, "a.ply"}, file_order).next(3); };
        EXPECT_THROW(read_all(), InputError) << length;
    }
}

} // namespace

namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

const fs::path kWorkspace = fixtures_folder() / "formats/dense_little";

/// The points of the fixture with view lists, as OpenMVS writes them.
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

TEST(TracksOfLists, CountsImagesInFileOrder)
{
    Scene scene;
    scene.cameras.resize(1); // without a size, so it shows all points in front
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

TEST(TracksOfLists, RejectsListsIfImagesDoNotShowThePoints)
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

    Scene other = scene; // its cameras look the other way
    for (View& view : other.views) {
        view.cam_from_world =
            Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitY()) * view.cam_from_world;
    }
    EXPECT_FALSE(tracks_of_lists(scene.tracks, file_order, other, note));
    EXPECT_EQ(note, "100 % of the images in its lists view_indices do not show the point, and "
                    "they seem to belong to another model, so the nearest views are used instead");
}

TEST(ViewListsOfBall, BecomeTheTracksOfACloud)
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

TEST_F(ViewLists, AreIgnoredIfTheyContainInvalidImages)
{
    const Scene scene = read({"2 0 3 0", "1 1 0", "0 0"});
    EXPECT_THAT(notes, ElementsAre(file() + ": its lists view_indices contain image 3, but the "
                                            "model has 3 images, counted from 0, so the nearest "
                                            "views are used instead"));
    expect_well_formed(scene);
}

TEST_F(ViewLists, AreRefusedIfTheyContainNegativeNumbers)
{
    EXPECT_EQ(refusal<InputError>([&] {
                  read({"1 -1 0", "0 0", "0 0"});
              }),
              file() +
                  ": vertex 0 of 3: its list view_indices has image -1, expected 0 to 4294967294");
}

} // namespace

} // namespace
} // namespace vcarve::visibility_test
