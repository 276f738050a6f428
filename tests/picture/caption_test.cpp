#include "picture/caption.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace vcarve::caption_test {
namespace {

const Eigen::Array3f kPaper = Eigen::Array3f::Constant(255.0F);
const Eigen::Array3f kInk = Eigen::Array3f::Zero();

/// '#' where there is ink, row by row.
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

TEST(Caption, DrawsAsManyPixelsADotAsItsScale)
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

TEST(Caption, ShowsLettersThatItsFontLacksAsOneQuestionMarkEach)
{
    EXPECT_EQ(drawn("T\u00e9\u4e2d\tT", 1, 60, 14), drawn("T???T", 1, 60, 14));
    EXPECT_EQ(text_width("\u4e2d"), text_width("?"));
    EXPECT_EQ(text_width(""), 0);
}

TEST(Caption, IsCutOffAtThePicturesEdges)
{
    const std::string whole = drawn("Town", 1, 40, 20, {10, 5});
    const std::string cut = drawn("Town", 1, 10, 5, {-4, -2});
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 10; ++x) {
            ASSERT_EQ(cut[y * 10 + x], whole[(y + 7) * 40 + x + 14]) << x << ", " << y;
        }
    }
}

TEST(Caption, DrawsNoMoreThanFourHundredLetters)
{
    EXPECT_EQ(text_width(std::string(1000, 'T')), text_width(std::string(400, 'T')));
    const std::string dots = drawn(std::string(1000, 'T'), 1, 8000, 9);
    EXPECT_EQ(std::ranges::count(dots, '#'), 400 * 11);
}

} // namespace
} // namespace vcarve::caption_test
