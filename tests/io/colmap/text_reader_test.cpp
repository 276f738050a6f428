#include "io/colmap/text_reader.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace vcarve::text_reader_test {
namespace {

TextReader reader_over(std::string_view text)
{
    return {{text.data(), text.size()}, "f.txt"};
}

TextReader reader_at(std::string_view text)
{
    TextReader reader = reader_over(text);
    reader.next_line();
    return reader;
}

TEST(TextReader, SkipsCommentsAndBlankLinesBetweenRecords)
{
    TextReader reader = reader_over("\xEF\xBB\xBF# one\r\n\r\n  \t\n  # two\na  b\r\n\nc");
    ASSERT_TRUE(reader.next_record());
    EXPECT_EQ(reader.read_word("a word"), "a");
    EXPECT_FALSE(reader.at_line_end());
    EXPECT_EQ(reader.read_word("a word"), "b");
    EXPECT_TRUE(reader.at_line_end());
    ASSERT_TRUE(reader.next_record());
    EXPECT_EQ(reader.rest(), "c");
    EXPECT_FALSE(reader.next_record());
    EXPECT_TRUE(reader.at_line_end());
}

TEST(TextReader, StopsAtBlankLinesInNextLine)
{
    TextReader reader = reader_over("a\n\nb\n# c\n");
    ASSERT_TRUE(reader.next_line());
    ASSERT_TRUE(reader.next_line());
    EXPECT_EQ(reader.rest(), "");
    ASSERT_TRUE(reader.next_line());
    EXPECT_EQ(reader.rest(), "b");
    EXPECT_FALSE(reader.next_line());
}

TEST(TextReader, KeepsBlanksInsideTheRest)
{
    TextReader reader = reader_at("1 \t IMG  0001 .jpg \r\n");
    EXPECT_EQ(reader.read_uint32("an id"), 1U);
    EXPECT_EQ(reader.rest(), "IMG  0001 .jpg");
}

TEST(TextReader, ReadsNumbersAsWritten)
{
    TextReader reader = reader_at("255 4294967295 18446744073709551615 +7 -0.5 +1e-3 5e-324 .5");
    EXPECT_EQ(reader.read_uint8("n"), 255);
    EXPECT_EQ(reader.read_uint32("n"), 4294967295U);
    EXPECT_EQ(reader.read_uint64("n"), 18446744073709551615U);
    EXPECT_EQ(reader.read_uint32("n"), 7U);
    EXPECT_EQ(reader.read_double("n"), -0.5);
    EXPECT_EQ(reader.read_double("n"), 1e-3);
    EXPECT_EQ(reader.read_double("n"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(reader.read_double("n"), 0.5);
}

TEST(TextReader, ReadsNegativeNumbersAsNoneOnlyIfNoneIsAllowed)
{
    TextReader reader = reader_at("-1 -20 12 -1 -1");
    EXPECT_EQ(reader.read_uint32_or_none("n"), 4294967295U);
    EXPECT_EQ(reader.read_uint32_or_none("n"), 4294967295U);
    EXPECT_EQ(reader.read_uint32_or_none("n"), 12U);
    EXPECT_EQ(reader.read_uint64_or_none("n"), 18446744073709551615U);
    EXPECT_THROW(reader.read_uint32("n"), InputError);
    EXPECT_THROW(reader_at("-").read_uint32_or_none("n"), InputError);
    EXPECT_THROW(reader_at("-1x").read_uint32_or_none("n"), InputError);
    EXPECT_THROW(reader_at("-1.5").read_uint64_or_none("n"), InputError);
}

TEST(TextReader, ReadsNumbersThatAreNotFinite)
{
    TextReader reader = reader_at("nan -nan(ind) inf -inf");
    EXPECT_TRUE(std::isnan(reader.read_double("n")));
    EXPECT_TRUE(std::isnan(reader.read_double("n")));
    EXPECT_EQ(reader.read_double("n"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(reader.read_double("n"), -std::numeric_limits<double>::infinity());
}

TEST(TextReader, RefusesWordsThatAreNotNumbersOfTheType)
{
    const auto energy_of = [](std::string_view text, auto member) {
        TextReader reader = reader_at(text);
        return refusal<InputError>([&] { (reader.*member)("the id"); });
    };
    const auto of_32_bits = [](const std::string& word) {
        return "f.txt: line 1: found '" + word + "', expected the id (an unsigned 32-bit integer)";
    };
    for (const char* word : {"-1", "4294967296", "1.0", "1x", "+", "++1", "+-1", "x"}) {
        EXPECT_EQ(energy_of(word, &TextReader::read_uint32), of_32_bits(word));
    }
    for (const char* word : {"1,5", "1e999", "1e-999", "+-1", "1.2.3", "--1", "0x1p3"}) {
        EXPECT_EQ(energy_of(word, &TextReader::read_double),
                  std::string("f.txt: line 1: found '") + word + "', expected the id (a number)");
    }
    EXPECT_EQ(energy_of("256", &TextReader::read_uint8),
              "f.txt: line 1: found '256', expected the id (an integer from 0 to 255)");
    EXPECT_EQ(energy_of(" ", &TextReader::read_double),
              "f.txt: line 1: the line ends, expected the id");
}

TEST(TextReader, CountsCommentLines)
{
    TextReader reader = reader_over("# a\n\n# b\r\nx\n");
    ASSERT_TRUE(reader.next_record());
    EXPECT_EQ(refusal<InputError>([&] { reader.fail("sentence"); }), "f.txt: line 4: sentence");
}

TEST(Printable, TruncatesBetweenCharactersAndReplacesControls)
{
    EXPECT_EQ(printable("K\xC3\xB6ln 1.png"), "K\xC3\xB6ln 1.png");
    EXPECT_EQ(printable("a\nb\x7F"), "a?b?");
    EXPECT_EQ(printable(std::string(61, 'x')), std::string(60, 'x') + "...");
    EXPECT_EQ(printable(std::string(59, 'x') + "\xC3\xB6 and more"), std::string(59, 'x') + "...");
}

} // namespace
} // namespace vcarve::text_reader_test
