#include "picture/picture.h"
#include "support/read_png.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Picture, ShrunkHoldsTheMeanOfEachSquareAndLeavesOutTheRest)
{
    const Picture half = shrunk(numbered(5, 3), 2);
    EXPECT_EQ(half.width_px, 2);
    EXPECT_EQ(half.height_px, 1);
    ASSERT_EQ(half.pixels.size(), 2U);
    EXPECT_TRUE((half.pixels[0] == Eigen::Array3f(3.0F, 6.0F, 4.0F)).all());
    EXPECT_TRUE((half.pixels[1] == Eigen::Array3f(5.0F, 10.0F, 4.0F)).all());
}

TEST(Picture, TakesAPartAtItsPlace)
{
    Picture whole = even_picture(4, 3, Eigen::Array3f::Constant(9.0F));
    paste(numbered(2, 2), 1, 1, whole);
    std::vector<float> reds;
    for (const Eigen::Array3f& pixel : whole.pixels) {
        reds.push_back(pixel[0]);
    }
    EXPECT_THAT(reds, ElementsAre(9, 9, 9, 9, 9, 0, 1, 9, 9, 2, 3, 9));
}

TEST(Picture, IsWrittenWithEightBitsAChannelRoundedAndClamped)
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

TEST(Picture, RefusesAPlaceItCannotWriteTo)
{
    const TemporaryFolder folder;
    const auto path = folder / "no_folder/one.png";
    const std::string parent = (folder / "no_folder").string();
    EXPECT_EQ(refusal<UsageError>([&] { write_png(path, numbered(1, 1)); }),
              "cannot write " + path.string() + ": the folder " + parent + " does not exist");
}

} // namespace
} // namespace vcarve::picture_test
