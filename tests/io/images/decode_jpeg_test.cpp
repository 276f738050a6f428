#include "io/images/encode_image.h"
#include "io/images/jpeg_errors.h"
#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace vcarve::decode_jpeg_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Le;

/// Format of a JPEG that encode_jpeg() cannot write.
struct Look {
    J_COLOR_SPACE given = JCS_RGB; ///< color space of the given pixels
    J_COLOR_SPACE stored = JCS_YCbCr;
    bool progressive = false;
    bool has_adobe_marker = false;
    Bytes exif{}; ///< content of an APP1 marker
};

int channels_of(J_COLOR_SPACE space)
{
    return space == JCS_GRAYSCALE ? 1 : space == JCS_CMYK ? 4 : 3;
}

/// Returns a JPEG of these pixels with quality 100.
Bytes jpeg_of(int width_px, int height_px, Bytes pixels, const Look& look)
{
    jpeg_error_mgr errors{};
    jpeg_compress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = static_cast<JDIMENSION>(width_px);
    jpeg.image_height = static_cast<JDIMENSION>(height_px);
    jpeg.input_components = channels_of(look.given);
    jpeg.in_color_space = look.given;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, look.stored);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg.write_Adobe_marker = look.has_adobe_marker ? TRUE : FALSE;
    if (look.progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    if (!look.exif.empty()) {
        jpeg_write_marker(&jpeg, JPEG_APP0 + 1, look.exif.data(),
                          static_cast<unsigned>(look.exif.size()));
    }
    while (jpeg.next_scanline < jpeg.image_height) {
        JSAMPROW row = pixels.data() + static_cast<std::size_t>(jpeg.next_scanline) * width_px *
                                           channels_of(look.given);
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    Bytes file(bytes, bytes + size);
    std::free(bytes);
    return file;
}

Photograph decoded(const Bytes& file)
{
    return decode_jpeg({kImagePath, file});
}

std::string refusal_of(const Bytes& file)
{
    return refusal<InputError>([&] { decoded(file); });
}

/// The absolute differences of all channels of two photographs.
std::vector<int> differences(const Photograph& a, const Photograph& b)
{
    std::vector<int> result;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        result.push_back(std::abs(a.rgb[i] - b.rgb.at(i)));
    }
    return result;
}

/// The message of refuse_image() for a reason.
std::string sentence(const std::string& reason)
{
    return "a folder/photo: found a JPEG that cannot be read (" + reason +
           "), but a complete photograph is expected; copy or convert it again";
}

TEST(DecodeJpeg, ReturnsRowsOfColors)
{
    const Photograph photo = gradient(20, 11);
    const Bytes file = jpeg_of(20, 11, photo.rgb, {});
    EXPECT_EQ(jpeg_size({kImagePath, file}).width_px, 20);
    EXPECT_EQ(jpeg_size({kImagePath, file}).height_px, 11);
    const Photograph read = decoded(file);
    EXPECT_EQ(read.width_px, 20);
    EXPECT_EQ(read.height_px, 11);
    ASSERT_EQ(read.rgb.size(), photo.rgb.size());
    EXPECT_THAT(differences(read, photo), Each(Le(6)));
}

TEST(DecodeJpeg, ReadsProgressiveFiles)
{
    const Photograph photo = gradient(20, 11);
    const Bytes file = jpeg_of(20, 11, photo.rgb, {.progressive = true});
    ASSERT_NE(file, jpeg_of(20, 11, photo.rgb, {}));
    EXPECT_THAT(differences(decoded(file), photo), Each(Le(6)));
}

TEST(DecodeJpeg, ExpandsGrayToThreeChannels)
{
    const Bytes file = jpeg_of(2, 1, {77, 77}, {.given = JCS_GRAYSCALE, .stored = JCS_GRAYSCALE});
    EXPECT_THAT(decoded(file).rgb, ElementsAre(77, 77, 77, 77, 77, 77));
}

TEST(DecodeJpeg, ConvertsCmykWithAndWithoutAdobeMarker)
{
    const Look adobe{.given = JCS_CMYK, .stored = JCS_CMYK, .has_adobe_marker = true};
    EXPECT_THAT(decoded(jpeg_of(1, 1, {255, 128, 0, 255}, adobe)).rgb, ElementsAre(255, 128, 0));
    EXPECT_THAT(decoded(jpeg_of(1, 1, {255, 255, 255, 51}, adobe)).rgb, ElementsAre(51, 51, 51));
    const Look plain{.given = JCS_CMYK, .stored = JCS_CMYK};
    EXPECT_THAT(decoded(jpeg_of(1, 1, {0, 127, 255, 0}, plain)).rgb, ElementsAre(255, 128, 0));
}

TEST(DecodeJpeg, ConvertsYcck)
{
    const Look look{.given = JCS_CMYK, .stored = JCS_YCCK, .has_adobe_marker = true};
    const Bytes bright = pixel(decoded(jpeg_of(1, 1, {200, 150, 100, 255}, look)), 0, 0);
    EXPECT_NEAR(bright[0], 200, 2);
    EXPECT_NEAR(bright[1], 150, 2);
    EXPECT_NEAR(bright[2], 100, 2);
}

TEST(DecodeJpeg, IgnoresTheExifOrientation)
{
    // One entry: orientation 6, a rotation by 90 degrees.
    const Bytes exif{'E', 'x', 'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1,
                     1,   18,  0,   3,   0, 0, 0,   1,   0, 6,  0, 0, 0, 0, 0, 0};
    const Photograph photo = gradient(16, 8);
    EXPECT_EQ(decoded(jpeg_of(16, 8, photo.rgb, {.exif = exif})).rgb,
              decoded(jpeg_of(16, 8, photo.rgb, {})).rgb);
    EXPECT_EQ(decoded(jpeg_of(16, 8, photo.rgb, {.exif = exif})).width_px, 16);
}

TEST(DecodeJpeg, IgnoresSuperfluousBytes)
{
    Bytes file = jpeg_of(20, 11, gradient(20, 11).rgb, {});
    const Photograph whole = decoded(file);
    file.insert(file.begin() + 2, {0, 1, 2});
    EXPECT_EQ(decoded(file).rgb, whole.rgb);
}

TEST(DecodeJpeg, RefusesTruncatedFiles)
{
    const Photograph photo = gradient(64, 64);
    for (const bool progressive : {false, true}) {
        const Bytes file = jpeg_of(64, 64, photo.rgb, {.progressive = progressive});
        for (const double share : {0.5, 0.8, 0.95}) {
            const Bytes part(file.begin(),
                             file.begin() + static_cast<std::ptrdiff_t>(share * file.size()));
            EXPECT_EQ(refusal_of(part), sentence("Premature end of JPEG file"));
            EXPECT_EQ(jpeg_size({kImagePath, part}).width_px, 64);
        }
        EXPECT_THAT(refusal_of({file.begin(), file.begin() + 20}), HasSubstr("a folder/photo: "));
    }
    EXPECT_EQ(refusal_of({0xFF, 0xD8, 0xFF}), sentence("Premature end of JPEG file"));
    EXPECT_EQ(refusal<InputError>([] {
                  jpeg_size({kImagePath, Bytes{0xFF, 0xD8, 0xFF}});
              }),
              sentence("Premature end of JPEG file"));
}

TEST(DecodeJpeg, RefusesDamagedPixels)
{
    Bytes file = jpeg_of(64, 64, gradient(64, 64).rgb, {});
    std::fill(file.end() - 200, file.end() - 100, std::uint8_t{0xFF});
    EXPECT_THAT(refusal_of(file), HasSubstr("Corrupt JPEG data"));
}

TEST(DecodeJpeg, RefusesHugeSizesBeforeAllocation)
{
    Bytes file = encode_jpeg(gradient(8, 8), 90);
    const Bytes frame{0xFF, 0xC0, 0, 17, 8};
    const auto at = std::search(file.begin(), file.end(), frame.begin(), frame.end());
    ASSERT_NE(at, file.end());
    std::ranges::copy(Bytes{0xFD, 0xE8, 0xFD, 0xE8}, at + 5);
    const std::string expected = "a folder/photo: found an image of 65000 x 65000 pixels, but 1 "
                                 "to 536870912 are expected; replace it, or make it smaller";
    EXPECT_EQ(refusal_of(file), expected);
    EXPECT_EQ(refusal<InputError>([&] { jpeg_size({kImagePath, file}); }), expected);
}

} // namespace
} // namespace vcarve::decode_jpeg_test
