#include "picture/picture.h"
#include "support/read_png.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vcarve::picture_test {
namespace {

using ::testing::ElementsAre;

Picture numbered(int width_px, int height_px)
{
    Picture picture = even_picture(width_px, height_px, Eigen::Array3f::Zero());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto number = static_cast<float>(i);
        picture.pixels[i] = {number, 2.0F * number, 4.0F};
    }
    return picture;
}

TEST(Picture, ShrinksToTheMeansOfCompleteSquares)
{
    const Picture half = shrunk(numbered(5, 3), 2);
    EXPECT_EQ(half.width_px, 2);
    EXPECT_EQ(half.height_px, 1);
    ASSERT_EQ(half.pixels.size(), 2U);
    EXPECT_TRUE((half.pixels[0] == Eigen::Array3f(3.0F, 6.0F, 4.0F)).all());
    EXPECT_TRUE((half.pixels[1] == Eigen::Array3f(5.0F, 10.0F, 4.0F)).all());
}

TEST(Picture, PastesAPartAtAPixel)
{
    Picture whole = even_picture(4, 3, Eigen::Array3f::Constant(9.0F));
    paste(numbered(2, 2), 1, 1, whole);
    std::vector<float> reds;
    for (const Eigen::Array3f& pixel : whole.pixels) {
        reds.push_back(pixel[0]);
    }
    EXPECT_THAT(reds, ElementsAre(9, 9, 9, 9, 9, 0, 1, 9, 9, 2, 3, 9));
}

TEST(Picture, WritesRoundedAndClampedBytes)
{
    const TemporaryFolder folder;
    const auto path = folder / "two.png";
    write_png(path, {2, 1, {{0.4F, 0.5F, 254.5F}, {-7.0F, 300.0F, 128.0F}}});
    const ReadPng read = read_png(path);
    EXPECT_EQ(read.width, 2);
    EXPECT_EQ(read.height, 1);
    EXPECT_THAT(read.bytes, ElementsAre(0, 1, 255, 0, 255, 128));
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(Picture, ReportsMissingOutputFolders)
{
    const TemporaryFolder folder;
    const auto path = folder / "no_folder/one.png";
    const std::string parent = (folder / "no_folder").string();
    EXPECT_EQ(refusal<UsageError>([&] { write_png(path, numbered(1, 1)); }),
              "cannot write " + path.string() + ": the folder " + parent + " does not exist");
}

const Eigen::Array3f kPaper = Eigen::Array3f::Constant(255.0F);
const Eigen::Array3f kInk = Eigen::Array3f::Zero();

/// Returns the rows of a drawn text with '#' for ink.
std::string drawn(const std::string& text, int scale, int width_px, int height_px,
                  const Eigen::Array2i& at_px = {0, 0})
{
    Picture picture = even_picture(width_px, height_px, kPaper);
    draw_text(text, at_px, scale, kInk, picture);
    std::string dots;
    for (const Eigen::Array3f& pixel : picture.pixels) {
        dots += (pixel == kInk).all() ? '#' : '.';
    }
    return dots;
}

TEST(Caption, DrawsALetterDotByDot)
{
    EXPECT_EQ(drawn("T", 1, 6, 9), "#####."
                                   "..#..."
                                   "..#..."
                                   "..#..."
                                   "..#..."
                                   "..#..."
                                   "..#..."
                                   "......"
                                   "......");
}

TEST(Caption, ScalesDots)
{
    const std::string small = drawn("a/B9.ply", 1, 60, 14);
    const std::string large = drawn("a/B9.ply", 3, 180, 42);
    for (int y = 0; y < 42; ++y) {
        for (int x = 0; x < 180; ++x) {
            ASSERT_EQ(large[y * 180 + x], small[(y / 3) * 60 + x / 3]) << x << ", " << y;
        }
    }
    EXPECT_GT(std::ranges::count(small, '#'), 50);
}

TEST(Caption, ReplacesMissingLettersByOneQuestionMarkEach)
{
    EXPECT_EQ(drawn("T\u00e9\u4e2d\tT", 1, 60, 14), drawn("T???T", 1, 60, 14));
    EXPECT_EQ(text_width("\u4e2d"), text_width("?"));
    EXPECT_EQ(text_width(""), 0);
}

TEST(Caption, IsClippedAtTheEdges)
{
    const std::string whole = drawn("Town", 1, 40, 20, {10, 5});
    const std::string cut = drawn("Town", 1, 10, 5, {-4, -2});
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 10; ++x) {
            ASSERT_EQ(cut[y * 10 + x], whole[(y + 7) * 40 + x + 14]) << x << ", " << y;
        }
    }
}

TEST(Caption, DrawsAtMost400Letters)
{
    EXPECT_EQ(text_width(std::string(1000, 'T')), text_width(std::string(400, 'T')));
    const std::string dots = drawn(std::string(1000, 'T'), 1, 8000, 9);
    EXPECT_EQ(std::ranges::count(dots, '#'), 400 * 11);
}

} // namespace
} // namespace vcarve::picture_test
