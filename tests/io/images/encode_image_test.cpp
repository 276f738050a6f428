#include "io/images/encode_image.h"
#include "support/image_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

namespace vcarve::encode_image_test {
namespace {

TEST(EncodeImage, ReturnsIdenticalBytes)
{
    const Photograph photo = gradient(20, 11);
    EXPECT_EQ(encode_jpeg(photo, 80), encode_jpeg(photo, 80));
    EXPECT_EQ(encode_png(photo), encode_png(photo));
}

TEST(EncodeImage, WritesLosslessPng)
{
    const Photograph photo = gradient(20, 11);
    EXPECT_EQ(decode_png({kImagePath, encode_png(photo)}).rgb, photo.rgb);
}

TEST(EncodeImage, WritesJpegOfTheGivenQuality)
{
    const Photograph photo = gradient(60, 60);
    const Bytes coarse = encode_jpeg(photo, 20);
    const Bytes fine = encode_jpeg(photo, 95);
    EXPECT_LT(coarse.size(), fine.size());
    const auto error = [&](const Bytes& file) {
        const Photograph read = decode_jpeg({kImagePath, file});
        int sum = 0;
        for (std::size_t i = 0; i < photo.rgb.size(); ++i) {
            sum += std::abs(photo.rgb[i] - read.rgb.at(i));
        }
        return static_cast<double>(sum) / static_cast<double>(photo.rgb.size());
    };
    EXPECT_LT(error(fine), 1.5);
    EXPECT_LT(error(fine), error(coarse));
}

TEST(EncodeImage, SeparatesColorsOfAdjacentPixels)
{
    Photograph photo{16, 16, {}};
    for (int i = 0; i < 256; ++i) {
        const bool is_red = i % 2 == 0;
        for (const int value : {is_red ? 220 : 30, 40, is_red ? 30 : 220}) {
            photo.rgb.push_back(static_cast<std::uint8_t>(value));
        }
    }
    const Photograph read = decode_jpeg({kImagePath, encode_jpeg(photo, 95)});
    EXPECT_GT(pixel(read, 4, 4)[0], 200);
    EXPECT_LT(pixel(read, 5, 4)[0], 50);
}

TEST(EncodeImage, ThrowsIfLibjpegFails)
{
    Photograph wide{70'000, 1, {}};
    wide.rgb.resize(std::size_t{3} * wide.width_px);
    EXPECT_THROW(encode_jpeg(wide, 90), std::runtime_error);
}

} // namespace
} // namespace vcarve::encode_image_test
