#include "io/dense/visibility.h"
#include "support/dense_workspace.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace vcarve::visibility_test {
namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;
using ::testing::ElementsAre;

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

TEST_F(Visibility, CountsImagesAsTheyStandInTheirFile)
{
    const Tracks tracks = read({{0, 2}, {1}, {}, {0, 1, 2}}, {1, 2, 0});
    EXPECT_THAT(tracks.begins, ElementsAre(0, 2, 3, 3, 6));
    EXPECT_THAT(tracks.views, ElementsAre(0, 1, 2, 0, 1, 2));
}

TEST_F(Visibility, CountsAViewThatAPointNamesTwiceOnce)
{
    const Tracks tracks = read({{0}, {2, 1, 2, 2}, {1, 1}, {}, {2, 0}}, {0, 1, 2});
    EXPECT_THAT(tracks.begins, ElementsAre(0, 1, 3, 4, 4, 6));
    EXPECT_THAT(tracks.views, ElementsAre(0, 1, 2, 1, 0, 2));
}

TEST_F(Visibility, OfNoPointsIsEmpty)
{
    EXPECT_EQ(read({}, {0}).size(), 0U);
}

TEST_F(Visibility, IsWhatASetOfEachRowIs)
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

TEST_F(Visibility, NamesTheFirstPointWithAnImageThatIsNotThere)
{
    Rows rows(50'000, {0, 1});
    rows[31'000] = {1, 2};
    rows[49'999] = {5};
    EXPECT_EQ(refusal<InputError>([&] {
                  read(rows, {0, 1});
              }),
              (folder / "a.vis").string() + ": point 31000 of 50000 was seen by image 2, but the "
                                            "model has 2 images, counted from 0");
}

TEST_F(Visibility, ComesInParts)
{
    VisibilityReader reader(
        folder.write("a.vis", visibility_bytes(Rows{{0, 2}, {1, 1}, {}, {0, 1, 2}, {5}})),
        {5, "a.ply"}, {1, 2, 0});
    const Tracks first = reader.next(3);
    EXPECT_THAT(first.begins, ElementsAre(0, 2, 3, 3));
    EXPECT_THAT(first.views, ElementsAre(0, 1, 2));
    EXPECT_THAT(reader.next(1).views, ElementsAre(0, 1, 2));
    EXPECT_EQ(refusal<InputError>([&] { reader.next(7); }),
              (folder / "a.vis").string() + ": point 4 of 5 was seen by image 5, but the model has "
                                            "3 images, counted from 0");
}

TEST_F(Visibility, IsRefusedWhereverTheFileIsCut)
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
} // namespace vcarve::visibility_test
