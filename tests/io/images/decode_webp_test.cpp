#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <webp/encode.h>

#include <cstdlib>

namespace vcarve::decode_webp_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Returns a lossless WebP of RGBA pixels.
Bytes webp(int width_px, int height_px, const Bytes& rgba)
{
    std::uint8_t* made = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(rgba.data(), width_px, height_px, 4 * width_px, &made);
    const Bytes bytes(made, made + size);
    WebPFree(made);
    return bytes;
}

Bytes with_alpha(const Photograph& photo, std::uint8_t alpha)
{
    Bytes rgba;
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        rgba.insert(rgba.end(), {photo.rgb[i], photo.rgb[i + 1], photo.rgb[i + 2], alpha});
    }
    return rgba;
}

TEST(DecodeWebp, ReturnsExactColors)
{
    const Photograph photo = gradient(20, 11);
    const Bytes bytes = webp(20, 11, with_alpha(photo, 255));
    const ImageFile file{kImagePath, bytes};
    EXPECT_EQ(decode_webp(file).rgb, photo.rgb);
    EXPECT_THAT(decode_webp(file).alpha, IsEmpty());
    EXPECT_EQ(webp_size(file).width_px, 20);
    EXPECT_EQ(webp_size(file).height_px, 11);
}

TEST(DecodeWebp, KeepsTransparentPixels)
{
    Bytes rgba = with_alpha(gradient(4, 1), 255);
    rgba[7] = 0;
    EXPECT_THAT(decode_webp({kImagePath, webp(4, 1, rgba)}).alpha,
                ::testing::ElementsAre(255, 0, 255, 255));
}

TEST(DecodeWebp, ReadsLossyFiles)
{
    const Photograph photo = gradient(40, 40);
    std::uint8_t* made = nullptr;
    const std::size_t size = WebPEncodeRGB(photo.rgb.data(), 40, 40, 120, 90.0F, &made);
    const Bytes bytes(made, made + size);
    WebPFree(made);
    const Photograph read = decode_webp({kImagePath, bytes});
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(pixel(read, 20, 20).at(i), pixel(photo, 20, 20).at(i), 8);
    }
}

TEST(DecodeWebp, RefusesTruncatedFiles)
{
    const Bytes whole = webp(20, 11, with_alpha(gradient(20, 11), 255));
    for (std::size_t size = 12; size < whole.size() - 1; ++size) { // the last byte is padding
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_THAT(refusal<InputError>([&] {
                        decode_webp({kImagePath, cut});
                    }),
                    HasSubstr("found a WebP that cannot be read"))
            << size;
    }
}

} // namespace
} // namespace vcarve::decode_webp_test
