#include "io/colmap/byte_reader.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <string_view>

namespace vcarve::byte_reader_test {
namespace {

using namespace std::string_view_literals;

ByteReader reader_over(std::string_view bytes)
{
    return {{bytes.data(), bytes.size()}, "f.bin"};
}

TEST(ByteReader, ReadsLittleEndianNumbersWithoutPadding)
{
    ByteReader reader = reader_over("\x01\x02\x03\x04\x05\x00\x00\x00\x00\x00\x00\xF0\x3F"sv);
    EXPECT_EQ(reader.read<std::uint8_t>("a"), 1);
    EXPECT_EQ(reader.read<std::uint32_t>("b"), 0x05040302U);
    EXPECT_EQ(reader.offset(), 5U);
    EXPECT_EQ(reader.read<double>("c"), 1.0);
    EXPECT_EQ(reader.left(), 0U);
    reader.expect_end("c");
}

TEST(ByteReader, NeverReadsPastTheEnd)
{
    ByteReader reader = reader_over("abcde");
    reader.read<std::uint8_t>("a letter");
    EXPECT_EQ(refusal<InputError>([&] { reader.read<double>("the width"); }),
              "f.bin: byte 1: the file ends inside the width (bytes expected: 8, found: 4)");
    EXPECT_EQ(reader.offset(), 1U);
}

TEST(ByteReader, AcceptsACountThatFillsTheFileExactly)
{
    ByteReader reader = reader_over("\x02\0\0\0\0\0\0\0aabb"sv);
    EXPECT_EQ(reader.read_count(2, "pairs"), 2U);
    reader.skip(2, 2);
    reader.expect_end("the last pair");
}

TEST(ByteReader, RefusesACountThatExceedsTheFile)
{
    ByteReader reader = reader_over("\x03\0\0\0\0\0\0\0aabb"sv);
    EXPECT_EQ(
        refusal<InputError>([&] { reader.read_count(2, "pairs"); }),
        "f.bin: byte 0: found a count of 3 pairs, but the rest of the file can hold 2 at most");
    ByteReader short_reader = reader_over("\x03\0\0"sv);
    EXPECT_EQ(
        refusal<InputError>([&] { short_reader.read_count(2, "pairs"); }),
        "f.bin: byte 0: the file ends inside the number of pairs (bytes expected: 8, found: 3)");
}

TEST(ByteReader, ReadsTextUpToTheZeroByte)
{
    ByteReader reader = reader_over("a b\0\0c"sv);
    EXPECT_EQ(reader.read_zero_terminated("a name"), "a b");
    EXPECT_EQ(reader.read_zero_terminated("a name"), "");
    EXPECT_EQ(refusal<InputError>([&] { reader.read_zero_terminated("a name"); }),
              "f.bin: byte 5: the file ends inside a name (no terminating zero byte)");
    ByteReader empty = reader_over("");
    EXPECT_EQ(refusal<InputError>([&] { empty.read_zero_terminated("a name"); }),
              "f.bin: byte 0: the file ends inside a name (no terminating zero byte)");
}

TEST(ByteReader, RefusesTrailingBytes)
{
    const ByteReader reader = reader_over("ab");
    EXPECT_EQ(
        refusal<InputError>([&] { reader.expect_end("the last point"); }),
        "f.bin: byte 0: expected the end of the file after the last point, found more bytes: 2");
}

} // namespace
} // namespace vcarve::byte_reader_test
