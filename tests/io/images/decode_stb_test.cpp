#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace vcarve::decode_stb_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void put(Bytes& bytes, std::uint32_t value, int count)
{
    for (int i = 0; i < count; ++i) {
        bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    }
}

/// An uncompressed BMP of these pixels. With a negative height the first row is at the top.
Bytes bmp(int width_px, int height_px, int bits, const Bytes& pixels)
{
    Bytes bytes{'B', 'M'};
    for (const std::uint32_t value :
         {54U + static_cast<std::uint32_t>(pixels.size()), 0U, 54U, 40U,
          static_cast<std::uint32_t>(width_px), static_cast<std::uint32_t>(height_px)}) {
        put(bytes, value, 4);
    }
    put(bytes, 1, 2);
    put(bytes, static_cast<std::uint32_t>(bits), 2);
    bytes.resize(54);
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

/// A TGA whose first row is at the top. Kind 2 is uncompressed, 3 gray, 10 compressed.
Bytes tga(int kind, int width_px, int height_px, int bits, const Bytes& pixels)
{
    Bytes bytes{0, 0, static_cast<std::uint8_t>(kind)};
    bytes.resize(12);
    put(bytes, static_cast<std::uint32_t>(width_px), 2);
    put(bytes, static_cast<std::uint32_t>(height_px), 2);
    bytes.push_back(static_cast<std::uint8_t>(bits));
    bytes.push_back(32);
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

Photograph decode(const Bytes& bytes)
{
    const ImageFile file{kImagePath, bytes};
    const Photograph photo = decode_stb(file);
    EXPECT_EQ(stb_size(file).width_px, photo.width_px);
    EXPECT_EQ(stb_size(file).height_px, photo.height_px);
    return photo;
}

std::string refused(const Bytes& bytes)
{
    return refusal<InputError>([&] { decode_stb({kImagePath, bytes}); });
}

TEST(DecodeStb, ReadsBottomUpAndTopDownBmp)
{
    const Bytes rows{3, 2, 1, 6, 5, 4, 0, 0, 9, 8, 7, 12, 11, 10, 0, 0}; // blue first, padded
    const Photograph up = decode(bmp(2, 2, 24, rows));
    EXPECT_THAT(up.rgb, ElementsAre(7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6));
    EXPECT_THAT(up.alpha, IsEmpty());
    EXPECT_THAT(decode(bmp(2, -2, 24, rows)).rgb,
                ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
}

TEST(DecodeStb, KeepsTransparentPixels)
{
    const Photograph photo = decode(tga(2, 2, 1, 32, {3, 2, 1, 0, 6, 5, 4, 255}));
    EXPECT_THAT(photo.rgb, ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(photo.alpha, ElementsAre(0, 255));
    EXPECT_THAT(decode(tga(2, 1, 1, 32, {3, 2, 1, 255})).alpha, IsEmpty());
}

TEST(DecodeStb, ReadsEveryKindOfTga)
{
    EXPECT_THAT(decode(tga(2, 2, 1, 24, {3, 2, 1, 6, 5, 4})).rgb, ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(decode(tga(3, 2, 1, 8, {7, 8})).rgb, ElementsAre(7, 7, 7, 8, 8, 8));
    EXPECT_THAT(decode(tga(10, 2, 1, 24, {0x81, 3, 2, 1})).rgb, ElementsAre(1, 2, 3, 1, 2, 3));
}

TEST(DecodeStb, RefusesTruncatedFiles)
{
    const Bytes row(std::size_t{3} * 100, 1);
    Bytes packets;
    for (int i = 0; i < 100; ++i) {
        packets.insert(packets.end(), {0x80, 3, 2, 1});
    }
    for (const Bytes& whole :
         {bmp(100, 1, 24, row), tga(2, 100, 1, 24, row), tga(10, 100, 1, 24, packets)}) {
        EXPECT_THAT(decode(whole).rgb, ::testing::SizeIs(300));
        for (std::size_t size = 2; size < whole.size(); ++size) {
            const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            EXPECT_THAT(refused(cut), HasSubstr("that cannot be read (it is truncated)")) << size;
        }
    }
}

TEST(DecodeStb, RefusesSizesBeyondTheLimit)
{
    EXPECT_THAT(refused(bmp(1 << 15, 1 << 15, 24, {})),
                HasSubstr("found an image of 32768 x 32768 pixels, but 1 to 536870912"));
    EXPECT_THAT(refused(bmp(0, 5, 24, {})), HasSubstr("0 x 5 pixels"));
    EXPECT_THAT(refused(bmp(1, std::numeric_limits<int>::min(), 24, {})),
                HasSubstr("1 x 2147483648 pixels"));
    EXPECT_THAT(refused(tga(2, 40000, 40000, 24, {})), HasSubstr("40000 x 40000 pixels"));
}

TEST(DecodeStb, ReportsTheFormatInErrors)
{
    Bytes packed = bmp(1, 1, 8, {0, 0, 0, 0});
    packed[30] = 1;
    EXPECT_EQ(refused(packed), kImagePath.string() +
                                   ": found a BMP that cannot be read (it is damaged, or "
                                   "its compression is not supported), but a complete "
                                   "photograph is expected; copy or convert it again");
    EXPECT_THAT(refused(tga(7, 1, 1, 24, {1, 2, 3})), HasSubstr("found a TGA that cannot be read"));
}

} // namespace
} // namespace vcarve::decode_stb_test
