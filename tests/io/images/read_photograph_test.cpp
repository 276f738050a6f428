#include "io/images/encode_image.h"
#include "io/images/read_photograph.h"
#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

namespace vcarve::read_photograph_test {
namespace {

using ::testing::ElementsAre;

TEST(ReadPhotograph, DetectsTheFormatByContent)
{
    const TemporaryFolder folder;
    const Photograph photo = gradient(6, 4);
    const auto png = folder.write("a.jpg", text_of(encode_png(photo)));
    EXPECT_EQ(read_photograph(png).rgb, photo.rgb);
    EXPECT_EQ(photograph_size(png).width_px, 6);
    const auto jpeg = folder.write("b.png", text_of(encode_jpeg(photo, 90)));
    EXPECT_EQ(read_photograph(jpeg).rgb, decode_jpeg({jpeg, encode_jpeg(photo, 90)}).rgb);
    EXPECT_EQ(photograph_size(jpeg).height_px, 4);
}

TEST(ReadPhotograph, ReadsEveryKindOfTiff)
{
    const TemporaryFolder folder;
    for (const char* const mode : {"wl", "wb", "wl8", "wb8"}) {
        const auto path = folder / "a.png";
        TIFF* const tiff = TIFFOpen(path.c_str(), mode);
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 2);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        Bytes row{3, 4};
        TIFFWriteScanline(tiff, row.data(), 0, 0);
        TIFFClose(tiff);
        EXPECT_THAT(read_photograph(path).rgb, ElementsAre(3, 3, 3, 4, 4, 4)) << mode;
        EXPECT_EQ(photograph_size(path).width_px, 2);
    }
}

TEST(ReadPhotograph, ReadsPpmAndPgm)
{
    const TemporaryFolder folder;
    const auto color = folder.write("color.ppm", "P6\n# a comment\n2 1\n255\nabcdef");
    EXPECT_THAT(read_photograph(color).rgb, ElementsAre('a', 'b', 'c', 'd', 'e', 'f'));
    EXPECT_EQ(photograph_size(color).width_px, 2);
    const auto gray = folder.write("gray.pgm", "P5 1 2 255\nxy");
    EXPECT_THAT(read_photograph(gray).rgb, ElementsAre('x', 'x', 'x', 'y', 'y', 'y'));
    const auto deep =
        folder.write("deep.ppm", std::string_view("P6 1 1 1023 \x03\xff\x00\x00\x02\x00", 18));
    EXPECT_THAT(read_photograph(deep).rgb, ElementsAre(255, 0, 128));
    const auto none = folder.write("none.ppm", "P6 1 x");
    EXPECT_THAT(refusal<InputError>([&] { photograph_size(none); }),
                testing::HasSubstr("no size or maximum value"));
    const auto cut = folder.write("cut.ppm", "P6 2 2 255\nabc");
    EXPECT_THAT(refusal<InputError>([&] { read_photograph(cut); }),
                testing::HasSubstr("found a PPM or PGM that cannot be read"));
    const auto huge = folder.write("huge.ppm", "P6 100000 100000 255\nabc");
    EXPECT_THAT(refusal<InputError>([&] { photograph_size(huge); }),
                testing::HasSubstr("huge.ppm"));
}

TEST(ReadPhotograph, ReadsBmpTgaAndWebp)
{
    const TemporaryFolder folder;
    const auto bmp = folder.write(
        "a.jpg",
        std::string_view("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0"
                         "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"
                         "cba\0",
                         58));
    EXPECT_THAT(read_photograph(bmp).rgb, ElementsAre('a', 'b', 'c'));
    const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\x20"
                          "cba",
                          21);
    EXPECT_THAT(read_photograph(folder.write("b.TGA", tga)).rgb, ElementsAre('a', 'b', 'c'));
    const std::string footer("\0\0\0\0\0\0\0\0TRUEVISION-XFILE.\0", 26);
    EXPECT_THAT(read_photograph(folder.write("b.jpg", tga + footer)).rgb,
                ElementsAre('a', 'b', 'c'));
    const auto webp = folder.write(
        "c.png", std::string_view("RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\0\0\0\x10\x07\x10\x11\x11"
                                  "\x88\x88\xfe\x07\0",
                                  34));
    EXPECT_EQ(photograph_size(webp).width_px, 1);
    EXPECT_THAT(read_photograph(webp).alpha, ElementsAre(0));
}

TEST(ReadPhotograph, RefusesOtherFiles)
{
    const TemporaryFolder folder;
    const auto refused = [](const std::filesystem::path& path) {
        const std::string sentence = refusal<InputError>([&] { read_photograph(path); });
        EXPECT_EQ(refusal<InputError>([&] { photograph_size(path); }), sentence);
        return sentence;
    };
    const auto text = folder.write("text.jpg", "to be replaced by a photograph\n");
    const std::string read = ", but photographs must be JPEG, PNG, TIFF, WebP, BMP, TGA, binary "
                             "PPM or PGM; convert it to one of them";
    EXPECT_EQ(refused(text), text.string() + ": found an unknown format" + read);
    const std::pair<std::string_view, const char*> kinds[] = {
        {"GIF89a", "a GIF"},
        {std::string_view("\0\0\0\x18"
                          "ftypheic",
                          12),
         "a HEIC"},
        {std::string_view("\0\0\0\x1c"
                          "ftypavif",
                          12),
         "an AVIF"},
        {std::string_view("\0\0\0\x0cjP  \r\n", 10), "a JPEG 2000"},
        {std::string_view("\0\0\0\x0cJXL \r\n", 10), "a JPEG XL"},
        {"P3 1 1 255 1 2 3", "a text PPM"}};
    for (const auto& [bytes, name] : kinds) {
        const auto file = folder.write("kind.jpg", bytes);
        EXPECT_EQ(refused(file), file.string() + ": found " + name + read);
    }
    const auto empty = folder.write("empty.jpg", "");
    EXPECT_EQ(refused(empty), empty.string() + ": the file is empty, but a photograph is "
                                               "expected; copy it again");
    EXPECT_EQ(refused(folder.path()),
              folder.path().string() + ": found something that is not a file");
    EXPECT_EQ(refused(folder / "no.jpg"),
              (folder / "no.jpg").string() + ": the file does not exist");
}

} // namespace
} // namespace vcarve::read_photograph_test
