#include "base/numbers.h"
#include "page/pack.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string_view>

namespace vcarve::pack_test {
namespace {

using Eigen::Vector3d;

/// The bytes of base64, by the alphabet of RFC 4648.
std::vector<std::uint8_t> decoded(std::string_view text)
{
    constexpr std::string_view kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char letter : text) {
        if (letter == '=') break;
        bits = bits << 6 | static_cast<unsigned>(kLetters.find(letter));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> count));
    }
    return bytes;
}

std::vector<std::uint32_t> three_byte_numbers(std::string_view text)
{
    const std::vector<std::uint8_t> bytes = decoded(text);
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        numbers.push_back(bytes[i] | bytes[i + 1] << 8 | bytes[i + 2] << 16);
    }
    return numbers;
}

std::string base64_of(std::string_view text)
{
    return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(Base64, FollowsTheStandard)
{
    EXPECT_EQ(base64_of(""), "");
    EXPECT_EQ(base64_of("f"), "Zg==");
    EXPECT_EQ(base64_of("fo"), "Zm8=");
    EXPECT_EQ(base64_of("foo"), "Zm9v");
    EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::vector<std::uint8_t>{0xfb, 0xff, 0xfe}), "+//+");
}

TEST(PackPositions, RoundsToHalfAQuantumBesideDistantPoints)
{
    std::vector<Vector3d> positions = {{1e4, -3e3, 7e5}};
    for (std::uint64_t i = 0; i < 500; ++i) {
        positions.emplace_back(random_number(1, i), -random_number(2, i),
                               5.0 + random_number(3, i));
    }
    const PackedPositions packed = pack_positions(positions);
    const std::vector<std::uint32_t> steps = three_byte_numbers(packed.data);
    ASSERT_EQ(steps.size(), 3 * positions.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto axis = static_cast<Eigen::Index>(i % 3);
        const double place = packed.low[axis] + packed.quantum[axis] * steps[i];
        worst = std::max(worst, std::abs(place - positions[i / 3][axis]) / packed.quantum[axis]);
    }
    EXPECT_LE(worst, 0.5 + 1e-6);
    EXPECT_NEAR(packed.quantum.x(), 1e4 / 16777215.0, 1e-6);
}

TEST(PackPositions, AcceptsABoxWithoutThickness)
{
    const std::vector<Vector3d> positions = {{1, 5, 2}, {3, 5, 2}};
    const PackedPositions packed = pack_positions(positions);
    EXPECT_EQ(three_byte_numbers(packed.data),
              (std::vector<std::uint32_t>{0, 0, 0, 16777215, 0, 0}));
    EXPECT_EQ(packed.low, positions[0]);
    EXPECT_EQ(packed.quantum.y(), 0.0);
}

TEST(PackPositions, IsEmptyWithoutPositions)
{
    EXPECT_EQ(pack_positions({}).data, "");
}

TEST(PackFaces, IsExact)
{
    const std::vector<Face> faces = {{0, 255, 256}, {65536, 16777215, 66051}};
    EXPECT_EQ(three_byte_numbers(pack_faces(faces)),
              (std::vector<std::uint32_t>{0, 255, 256, 65536, 16777215, 66051}));
}

TEST(PackColors, IsExact)
{
    const std::vector<Color> colors = {{1, 2, 3}, {255, 0, 128}};
    EXPECT_EQ(decoded(pack_colors(colors)), (std::vector<std::uint8_t>{1, 2, 3, 255, 0, 128}));
}

TEST(PackBytes, ClampsToAByte)
{
    EXPECT_EQ(decoded(pack_bytes(std::vector<std::int32_t>{0, 7, 255, 256, 70000})),
              (std::vector<std::uint8_t>{0, 7, 255, 255, 255}));
}

TEST(PackErrors, UsesThousandthsOfAPixelAndMarksUnknownErrors)
{
    const std::vector<std::uint8_t> bytes =
        decoded(pack_errors(std::vector<double>{0.0, 0.2561, 1e9, -1.0}));
    EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0, 0, 0, 1, 254, 255, 255, 255}));
}

} // namespace
} // namespace vcarve::pack_test
