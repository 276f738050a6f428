#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

namespace vcarve::decode_tiff_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Format of a TIFF to write.
struct Look {
    std::uint16_t photometric = PHOTOMETRIC_RGB;
    std::uint16_t channels = 3;
    std::uint16_t bits = 8;
    std::uint16_t compression = COMPRESSION_NONE;
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    std::uint16_t extra = 0; ///< type of the last channel, if it is no color
    std::uint32_t rows_per_strip = 7;
    const char* mode = "w";
};

/// Returns the bytes of a TIFF with these rows.
Bytes tiff_of(const TemporaryFolder& folder, int width_px, std::vector<Bytes> rows,
              const Look& look)
{
    TIFF* const tiff = TIFFOpen((folder / "made.tif").c_str(), look.mode);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width_px);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<int>(rows.size()));
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, look.channels);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, look.bits);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, look.photometric);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, look.compression);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, look.orientation);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, look.rows_per_strip);
    if (look.extra != 0) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &look.extra);
    if (look.photometric == PHOTOMETRIC_PALETTE) {
        std::vector<std::uint16_t> reds(256, 0x1111);
        std::vector<std::uint16_t> greens(256, 0x2222);
        std::vector<std::uint16_t> blues(256, 0x3333);
        reds[9] = 0xC8C8;
        TIFFSetField(tiff, TIFFTAG_COLORMAP, reds.data(), greens.data(), blues.data());
    }
    for (std::size_t y = 0; y < rows.size(); ++y) {
        TIFFWriteScanline(tiff, rows[y].data(), static_cast<std::uint32_t>(y), 0);
    }
    TIFFClose(tiff);
    const std::string text = bytes_of(folder / "made.tif");
    return {text.begin(), text.end()};
}

std::vector<Bytes> rows_of(const Photograph& photo)
{
    std::vector<Bytes> rows;
    for (int y = 0; y < photo.height_px; ++y) {
        const auto begin = photo.rgb.begin() + std::ptrdiff_t{3} * y * photo.width_px;
        rows.emplace_back(begin, begin + std::ptrdiff_t{3} * photo.width_px);
    }
    return rows;
}

/// Writes the bytes to a file, which libtiff needs, and decodes it.
Photograph decoded(const Bytes& bytes)
{
    const TemporaryFolder folder;
    folder.write("photo", text_of(bytes));
    return decode_tiff({folder / "photo", bytes});
}

/// Encodes the rows as TIFF and decodes it.
Photograph decoded(int width_px, const std::vector<Bytes>& rows, const Look& look)
{
    const TemporaryFolder folder;
    return decoded(tiff_of(folder, width_px, rows, look));
}

std::string refusal_of(const Bytes& file)
{
    return refusal<InputError>([&] { decoded(file); });
}

TEST(DecodeTiff, ReturnsExactColors)
{
    const Photograph photo = gradient(5, 200); // 200, 29 or one strip
    for (const char* const mode : {"wl", "wb", "w8"}) {
        for (const std::uint32_t rows : {1U, 7U, 200U}) {
            const Look look{.compression = COMPRESSION_LZW, .rows_per_strip = rows, .mode = mode};
            const Photograph read = decoded(5, rows_of(photo), look);
            EXPECT_EQ(read.width_px, 5);
            EXPECT_EQ(read.height_px, 200);
            EXPECT_EQ(read.rgb, photo.rgb) << mode << rows;
        }
    }
}

TEST(DecodeTiff, ReadsTiles)
{
    const TemporaryFolder folder;
    const Photograph photo = gradient(16, 96);
    TIFF* const tiff = TIFFOpen((folder / "tiled.tif").c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 16);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 96);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, 48);
    for (std::uint32_t y = 0; y < 96; y += 48) {
        Bytes tile(photo.rgb.begin() + 48 * y, photo.rgb.begin() + 48 * (y + 48));
        TIFFWriteTile(tiff, tile.data(), 0, y, 0, 0);
    }
    TIFFClose(tiff);
    EXPECT_EQ(decode_tiff({folder / "tiled.tif", {}}).rgb, photo.rgb);
}

TEST(DecodeTiff, ExpandsGrayToThreeChannels)
{
    const Look black{.photometric = PHOTOMETRIC_MINISBLACK, .channels = 1};
    EXPECT_THAT(decoded(2, {{7, 250}}, black).rgb, ElementsAre(7, 7, 7, 250, 250, 250));
    const Look white{.photometric = PHOTOMETRIC_MINISWHITE, .channels = 1};
    EXPECT_THAT(decoded(1, {{7}}, white).rgb, Each(248));
}

TEST(DecodeTiff, KeepsColorsUnchangedByAlpha)
{
    for (const std::uint16_t extra : {EXTRASAMPLE_UNASSALPHA, EXTRASAMPLE_ASSOCALPHA}) {
        const Look colors{.channels = 4, .extra = extra};
        EXPECT_THAT(decoded(1, {{10, 20, 30, 0}}, colors).rgb, ElementsAre(10, 20, 30));
        const Look gray{.photometric = PHOTOMETRIC_MINISBLACK, .channels = 2, .extra = extra};
        EXPECT_THAT(decoded(1, {{99, 5}}, gray).rgb, Each(99));
    }
}

TEST(DecodeTiff, LooksColorsUpInThePalette)
{
    const Look look{.photometric = PHOTOMETRIC_PALETTE, .channels = 1};
    EXPECT_THAT(decoded(2, {{9, 0}}, look).rgb, ElementsAre(0xC8, 0x22, 0x33, 0x11, 0x22, 0x33));
}

TEST(DecodeTiff, RoundsSixteenBitsToEight)
{
    // 0x12FF / 257 is 18.9; little endian
    const Look look{.bits = 16, .mode = "wl"};
    EXPECT_THAT(decoded(1, {{0xFF, 0x12, 0x80, 0x80, 0xFF, 0xFF}}, look).rgb,
                ElementsAre(19, 128, 255));
}

TEST(DecodeTiff, ConvertsCmykToRgb)
{
    const Look look{.photometric = PHOTOMETRIC_SEPARATED, .channels = 4};
    EXPECT_THAT(decoded(1, {{0, 255, 0, 0}}, look).rgb, ElementsAre(255, 0, 255));
}

TEST(DecodeTiff, IgnoresTheOrientation)
{
    const Photograph photo = gradient(5, 3);
    for (const std::uint16_t turned :
         {ORIENTATION_BOTLEFT, ORIENTATION_TOPRIGHT, ORIENTATION_RIGHTTOP}) {
        EXPECT_EQ(decoded(5, rows_of(photo), {.orientation = turned}).rgb, photo.rgb);
    }
}

TEST(DecodeTiff, RefusesTruncatedFiles)
{
    const TemporaryFolder folder;
    // The directory follows the pixels, so the first half of the file lacks it.
    const Bytes file = tiff_of(folder, 30, rows_of(gradient(30, 30)), {.mode = "wl"});
    const Bytes part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(file.size() / 2));
    EXPECT_THAT(refusal_of(part), HasSubstr("/photo: found a TIFF that cannot be read ("));
    EXPECT_THAT(refusal_of({'I', 'I', 42, 0}), HasSubstr("a TIFF that cannot be read ("));
}

TEST(DecodeTiff, RefusesDamagedPixels)
{
    const TemporaryFolder folder;
    const Look look{.compression = COMPRESSION_LZW, .rows_per_strip = 30};
    Bytes file = tiff_of(folder, 30, rows_of(gradient(30, 30)), look);
    std::fill(file.begin() + 60, file.begin() + 200, std::uint8_t{0xFF});
    EXPECT_THAT(refusal_of(file), HasSubstr("a TIFF that cannot be read ("));
}

TEST(DecodeTiff, Refuses32BitSamples)
{
    const TemporaryFolder folder;
    const Bytes file = tiff_of(folder, 1, {Bytes(12)}, {.bits = 32});
    EXPECT_THAT(refusal_of(file), HasSubstr("32-bit samples"));
}

TEST(DecodeTiff, RefusesHugeSizesBeforeAllocation)
{
    const TemporaryFolder folder;
    Bytes file = tiff_of(folder, 1, {{1, 2, 3}}, {.mode = "wl"});
    for (const std::uint8_t tag : {0, 1}) { // width and height, of 16 or 32 bits
        for (const std::uint8_t type : {3, 4}) {
            const Bytes entry{tag, 1, type, 0, 1, 0, 0, 0};
            const auto at = std::search(file.begin(), file.end(), entry.begin(), entry.end());
            if (at == file.end()) continue;
            std::ranges::copy(Bytes{tag, 1, 4, 0, 1, 0, 0, 0, 0xA0, 0x86, 1, 0}, at);
        }
    }
    EXPECT_THAT(refusal_of(file),
                HasSubstr("/photo: found an image of 100000 x 100000 pixels, but 1 to 536870912 "
                          "are expected; replace it, or make it smaller"));
}

} // namespace
} // namespace vcarve::decode_tiff_test
