#include "base/text.h"

#include <gtest/gtest.h>

namespace vcarve::text_test {
namespace {

TEST(ParseByteSize, AcceptsPlainBytesAndSuffixes)
{
    EXPECT_EQ(parse_byte_size("0"), 0);
    EXPECT_EQ(parse_byte_size("1500000"), 1'500'000);
    EXPECT_EQ(parse_byte_size("2k"), 2048);
    EXPECT_EQ(parse_byte_size("2K"), 2048);
    EXPECT_EQ(parse_byte_size("1.5M"), 1'572'864);
    EXPECT_EQ(parse_byte_size("8G"), 8'589'934'592);
    EXPECT_EQ(parse_byte_size("8589934591G"), 9'223'372'035'781'033'984); // the largest below 2^63
}

TEST(ParseByteSize, RejectsOtherTexts)
{
    for (const char* text : {"", "G", "8GB", "8 G", " 8", "-1", "-1G", "8T", "1e9", "nan", "inf",
                             "0x10", "1,5G", "8589934592G"}) {
        EXPECT_EQ(parse_byte_size(text), std::nullopt) << text;
    }
}

TEST(ByteSizeText, UsesTheLargestSuffixAndFourDigits)
{
    EXPECT_EQ(byte_size_text(0), "0");
    EXPECT_EQ(byte_size_text(1023), "1023");
    EXPECT_EQ(byte_size_text(1024), "1K");
    EXPECT_EQ(byte_size_text(1536), "1.5K");
    EXPECT_EQ(byte_size_text(24'117'248), "23M");
    EXPECT_EQ(byte_size_text(std::int64_t{8} << 30), "8G");
    EXPECT_EQ(byte_size_text(12'345'678'901), "11.5G");
    EXPECT_EQ(byte_size_text(std::int64_t{5000} << 30), "5000G");
}

TEST(Counted, UsesTheSingularForOne)
{
    EXPECT_EQ(counted(1, "vertices"), "1 vertex");
    EXPECT_EQ(counted(1, "pages"), "1 page");
    EXPECT_EQ(counted(0, "points"), "0 points");
    EXPECT_EQ(counted(24310, "faces"), "24,310 faces");
}

TEST(ControlFree, ReplacesControlCharacters)
{
    EXPECT_EQ(control_free("a\x1b[31mb\tc\nd\x7f"), "a?[31mb?c?d?");
    EXPECT_EQ(control_free("a\xC2\x9B"
                           "31m"),
              "a?31m");
    EXPECT_EQ(control_free("\xC2"), "\xC2");
}

TEST(ControlFree, PreservesOtherCharacters)
{
    EXPECT_EQ(control_free(""), "");
    EXPECT_EQ(control_free("Stra\xC3\x9F"
                           "e \xC2\xA0 100 %"),
              "Stra\xC3\x9F"
              "e \xC2\xA0 100 %");
}

} // namespace
} // namespace vcarve::text_test
