#include "texture/photo_pyramid.h"

#include <gtest/gtest.h>

namespace vcarve::photo_pyramid_test {
namespace {

/// Red grows to the right by 2 a pixel, green downwards by 3.
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

TEST(PhotoPyramid, GoesEvenlyFromTheMiddleOfAPixelToTheNext)
{
    const PhotoPyramid pyramid(ramp(64, 48));
    EXPECT_TRUE(pyramid.at({10.5, 20.5}).isApprox(Eigen::Array3f(20, 60, 7)));
    EXPECT_TRUE(pyramid.at({10.75, 20.75}).isApprox(Eigen::Array3f(20.5F, 60.75F, 7)));
}

TEST(PhotoPyramid, AveragesOverAsManyPixelsAsAreAskedFor)
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

TEST(PhotoPyramid, GoesOnBeyondTheEdges)
{
    const PhotoPyramid pyramid(ramp(64, 48));
    EXPECT_TRUE(pyramid.at({-9.0, 500.0}).isApprox(Eigen::Array3f(0, 141, 7)));
    EXPECT_TRUE(pyramid.at({500.0, -9.0}, 4.0).isApprox(Eigen::Array3f(123, 5, 7), 0.02F));
}

TEST(PhotoPyramid, OfOnePixelIsThatPixel)
{
    const PhotoPyramid pyramid(Photograph{1, 1, {9, 8, 7}});
    EXPECT_TRUE(pyramid.at({0.5, 0.5}, 16.0).isApprox(Eigen::Array3f(9, 8, 7)));
}

} // namespace
} // namespace vcarve::photo_pyramid_test
