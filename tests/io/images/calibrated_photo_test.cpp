#include "io/images/calibrated_photo.h"
#include "support/photographed_wall.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::calibrated_photo_test {
namespace {

using ::testing::ElementsAre;

TEST(CalibratedPhoto, ProjectsLikeItsCamera)
{
    const CalibratedPhoto photo = photo_from({0, 0, -2});
    const auto pixel = pixel_of(photo, {0.5, -0.25, 0.0});
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(pixel->isApprox(Eigen::Vector2d(105.0, 47.5), 1e-12)) << pixel->transpose();
}

TEST(CalibratedPhoto, ScalesPixelsIfThePhotographIsSmaller)
{
    CalibratedPhoto photo = photo_from({0, 0, -2});
    photo.size = {80, 40};
    photo.scale = {0.5, 1.0 / 3.0};
    const auto pixel = pixel_of(photo, {0.5, -0.25, 0.0});
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(pixel->isApprox(Eigen::Vector2d(52.5, 47.5 / 3.0), 1e-12)) << pixel->transpose();
}

TEST(CalibratedPhoto, ShowsNothingBeyondItsEdgesOrBehindIt)
{
    const CalibratedPhoto photo = photo_from({0, 0, -2});
    EXPECT_FALSE(pixel_of(photo, {1.7, 0.0, 0.0}));
    EXPECT_FALSE(pixel_of(photo, {0.0, 0.0, -3.0}));
    EXPECT_TRUE(pixel_beyond(photo, {1.7, 0.0, 0.0}));
}

/// Red increases by 2 per pixel to the right, green by 3 per pixel downwards.
Photograph ramp(int width_px, int height_px)
{
    Photograph image{width_px, height_px, {}};
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            image.rgb.insert(image.rgb.end(), {static_cast<std::uint8_t>(2 * x),
                                               static_cast<std::uint8_t>(3 * y), 7});
        }
    }
    return image;
}

TEST(PhotoPyramid, InterpolatesBetweenPixelCenters)
{
    const PhotoPyramid pyramid(ramp(64, 48));
    EXPECT_TRUE(pyramid.at({10.5, 20.5}).isApprox(Eigen::Array3f(20, 60, 7)));
    EXPECT_TRUE(pyramid.at({10.75, 20.75}).isApprox(Eigen::Array3f(20.5F, 60.75F, 7)));
}

TEST(PhotoPyramid, AveragesOverTheGivenWidth)
{
    Photograph stripes{64, 64, {}};
    for (int i = 0; i < 64 * 64; ++i) {
        const auto level = static_cast<std::uint8_t>(i % 2 == 0 ? 0 : 200);
        stripes.rgb.insert(stripes.rgb.end(), {level, level, level});
    }
    const PhotoPyramid pyramid(stripes);
    EXPECT_EQ(pyramid.at({20.5, 20.5})[0], 0.0F);
    EXPECT_EQ(pyramid.at({20.5, 20.5}, 2.0)[0], 100.0F);
    EXPECT_EQ(pyramid.at({20.5, 20.5}, 8.0)[0], 100.0F);
    EXPECT_EQ(pyramid.at({20.5, 20.5}, 1e9)[0], 100.0F);
}

TEST(PhotoPyramid, ExtendsTheColorsAtTheEdges)
{
    const PhotoPyramid pyramid(ramp(64, 48));
    EXPECT_TRUE(pyramid.at({-9.0, 500.0}).isApprox(Eigen::Array3f(0, 141, 7)));
    EXPECT_TRUE(pyramid.at({500.0, -9.0}, 4.0).isApprox(Eigen::Array3f(123, 5, 7), 0.02F));
}

TEST(PhotoPyramid, ShowsNothingIfABlendedPixelIsTransparent)
{
    Photograph image = ramp(8, 8);
    image.alpha.assign(64, 255);
    image.alpha[3 * 8 + 5] = 0; // column 5, row 3
    const PhotoPyramid pyramid(image);
    EXPECT_FALSE(pyramid.shows({5.5, 3.5}));
    EXPECT_FALSE(pyramid.shows({4.6, 3.5})) << "the transparent pixel is blended in";
    EXPECT_TRUE(pyramid.shows({4.4, 3.5}));
    EXPECT_FALSE(pyramid.shows({5.0, 3.0}, 2.0));
    EXPECT_TRUE(pyramid.shows({1.0, 7.0}, 2.0));
    EXPECT_TRUE(PhotoPyramid(ramp(8, 8)).shows({5.5, 3.5}));
}

TEST(PhotoPyramid, ReturnsTheOnlyPixelForAnyWidth)
{
    const PhotoPyramid pyramid(Photograph{1, 1, {9, 8, 7}});
    EXPECT_TRUE(pyramid.at({0.5, 0.5}, 16.0).isApprox(Eigen::Array3f(9, 8, 7)));
}

TEST(ExcludeMasked, MakesBlackPixelsTransparentForAnyMaskSize)
{
    const TemporaryFolder folder;
    for (const int size : {2, 4, 8}) {
        write_photograph(folder / "mask.png",
                         mask_image(size, size, [&](int x, int) { return 2 * x >= size; }));
        Photograph photo = mask_image(4, 2, [](int, int) { return false; });
        exclude_masked(folder / "mask.png", photo);
        EXPECT_THAT(photo.alpha, ElementsAre(255, 255, 0, 0, 255, 255, 0, 0)) << size;
        photo.alpha[0] = 0;
        exclude_masked(folder / "mask.png", photo);
        EXPECT_EQ(photo.alpha[0], 0) << "it was transparent before";
    }
}

TEST(ExcludeMasked, IgnoresPixelsThatAreNotBlack)
{
    const TemporaryFolder folder;
    Photograph mask = mask_image(2, 1, [](int, int) { return true; });
    mask.rgb[2] = 1;
    write_photograph(folder / "mask.png", mask);
    Photograph photo = mask_image(2, 1, [](int, int) { return false; });
    exclude_masked(folder / "mask.png", photo);
    EXPECT_THAT(photo.alpha, ElementsAre(255, 0));
}

} // namespace
} // namespace vcarve::calibrated_photo_test
