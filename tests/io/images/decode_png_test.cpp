#include "io/images/encode_image.h"
#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

namespace vcarve::decode_png_test {
namespace {

using ::testing::ElementsAre;

/// Format of a PNG that encode_png() cannot write.
struct Look {
    int color_type = PNG_COLOR_TYPE_RGB;
    int bits = 8;
    int interlace = PNG_INTERLACE_NONE;
    std::vector<png_color> palette{};
    Bytes transparent{}; ///< alpha of each color of the palette
};

void append(png_structp png, png_bytep bytes, std::size_t count)
{
    auto* const file = static_cast<Bytes*>(png_get_io_ptr(png));
    file->insert(file->end(), bytes, bytes + count);
}

/// Returns a PNG of packed rows.
Bytes png_of(int width_px, const std::vector<Bytes>& rows, const Look& look)
{
    Bytes file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width_px),
                 static_cast<png_uint_32>(rows.size()), look.bits, look.color_type, look.interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!look.palette.empty()) {
        png_set_PLTE(png, info, look.palette.data(), static_cast<int>(look.palette.size()));
    }
    if (!look.transparent.empty()) {
        png_set_tRNS(png, info, look.transparent.data(), static_cast<int>(look.transparent.size()),
                     nullptr);
    }
    png_set_gAMA(png, info, 1.0); // the decoder must ignore it
    png_write_info(png, info);
    std::vector<png_bytep> pointers;
    for (const Bytes& row : rows) {
        pointers.push_back(const_cast<png_bytep>(row.data()));
    }
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

Photograph decoded(const Bytes& file)
{
    return decode_png({kImagePath, file});
}

std::string refusal_of(const Bytes& file)
{
    return refusal<InputError>([&] { decoded(file); });
}

/// The message of refuse_image() for a reason.
std::string sentence(const std::string& reason)
{
    return "a folder/photo: found a PNG that cannot be read (" + reason +
           "), but a complete photograph is expected; copy or convert it again";
}

TEST(DecodePng, ReturnsExactColors)
{
    const Photograph photo = gradient(7, 5);
    const Photograph read = decoded(encode_png(photo));
    EXPECT_EQ(read.width_px, 7);
    EXPECT_EQ(read.height_px, 5);
    EXPECT_EQ(read.rgb, photo.rgb);
    EXPECT_EQ(png_size({kImagePath, encode_png(photo)}).height_px, 5);
}

TEST(DecodePng, ExpandsGrayToThreeChannels)
{
    const Look gray{.color_type = PNG_COLOR_TYPE_GRAY};
    EXPECT_THAT(decoded(png_of(2, {{7, 250}}, gray)).rgb, ElementsAre(7, 7, 7, 250, 250, 250));
    const Look bits{.color_type = PNG_COLOR_TYPE_GRAY, .bits = 1};
    EXPECT_THAT(decoded(png_of(2, {{0x40}}, bits)).rgb, ElementsAre(0, 0, 0, 255, 255, 255));
}

TEST(DecodePng, KeepsAlphaAndColorsOfTransparentPixels)
{
    const Look colors{.color_type = PNG_COLOR_TYPE_RGB_ALPHA};
    const Photograph half = decoded(png_of(2, {{10, 20, 30, 0, 40, 50, 60, 200}}, colors));
    EXPECT_THAT(half.rgb, ElementsAre(10, 20, 30, 40, 50, 60));
    EXPECT_THAT(half.alpha, ElementsAre(0, 200));
    EXPECT_THAT(decoded(png_of(1, {{10, 20, 30, 1}}, colors)).alpha, ElementsAre());
    const Look gray{.color_type = PNG_COLOR_TYPE_GRAY_ALPHA};
    EXPECT_THAT(decoded(png_of(1, {{99, 5}}, gray)).rgb, ElementsAre(99, 99, 99));
}

TEST(DecodePng, LooksColorsUpInThePalette)
{
    const Look look{.color_type = PNG_COLOR_TYPE_PALETTE,
                    .bits = 4,
                    .palette = {{1, 2, 3}, {200, 100, 50}},
                    .transparent = {255, 0}};
    const Photograph photo = decoded(png_of(2, {{0x10}}, look));
    EXPECT_THAT(photo.rgb, ElementsAre(200, 100, 50, 1, 2, 3));
    EXPECT_THAT(photo.alpha, ElementsAre(0, 255));
}

TEST(DecodePng, RoundsSixteenBitsToEight)
{
    const Look look{.bits = 16};
    // 0x12FF / 257 is 18.9
    EXPECT_THAT(decoded(png_of(1, {{0x12, 0xFF, 0x80, 0x80, 0xFF, 0xFF}}, look)).rgb,
                ElementsAre(19, 128, 255));
}

TEST(DecodePng, ReadsInterlacedFiles)
{
    const Photograph photo = gradient(5, 3);
    std::vector<Bytes> rows;
    for (int y = 0; y < 3; ++y) {
        rows.emplace_back(photo.rgb.begin() + 15 * y, photo.rgb.begin() + 15 * (y + 1));
    }
    EXPECT_EQ(decoded(png_of(5, rows, {.interlace = PNG_INTERLACE_ADAM7})).rgb, photo.rgb);
}

TEST(DecodePng, RefusesWrongChecksums)
{
    Bytes file = encode_png(gradient(7, 5));
    const Bytes data{'I', 'D', 'A', 'T'};
    const auto at = std::search(file.begin(), file.end(), data.begin(), data.end());
    ASSERT_NE(at, file.end());
    Bytes last = file;
    last[last.size() - 13] ^= 1U; // the checksum of the pixels
    EXPECT_EQ(refusal_of(last), sentence("IDAT: CRC error"));
    file[12 + 8 + 4] ^= 1U; // in the header
    EXPECT_EQ(refusal_of(file), sentence("IHDR: CRC error"));
    EXPECT_EQ(refusal<InputError>([&] {
                  png_size({kImagePath, file});
              }),
              sentence("IHDR: CRC error"));
}

TEST(DecodePng, RefusesTruncatedFiles)
{
    const Bytes file = encode_png(gradient(30, 30));
    for (const std::size_t count :
         {std::size_t{8}, std::size_t{20}, file.size() / 2, file.size() - 1}) {
        EXPECT_EQ(refusal_of({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(count)}),
                  sentence("the file is truncated"));
    }
}

TEST(DecodePng, RefusesHugeSizesBeforeAllocation)
{
    Bytes huge = encode_png(gradient(1, 1));
    for (const int at : {16, 20}) {
        std::ranges::copy(Bytes{0, 1, 0x86, 0xA0}, huge.begin() + at);
    }
    std::uint32_t checksum = 0xFFFFFFFF;
    for (std::size_t i = 12; i < 29; ++i) {
        checksum ^= huge[i];
        for (int bit = 0; bit < 8; ++bit) {
            checksum = (checksum >> 1U) ^ ((checksum & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    checksum = ~checksum;
    for (std::size_t i = 0; i < 4; ++i) {
        huge[29 + i] = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
    }
    EXPECT_EQ(refusal_of(huge),
              "a folder/photo: found an image of 100000 x 100000 pixels, but 1 to 536870912 are "
              "expected; replace it, or make it smaller");
}

} // namespace
} // namespace vcarve::decode_png_test
