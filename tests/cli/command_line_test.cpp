#include "cli/command_line.h"
#include "support/sample_options.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace vcarve::cli::command_line_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// The sample's options, and a path.
struct Values {
    SampleOptions sample;
    std::filesystem::path stats;

    OptionList options()
    {
        OptionList all = options_of(sample);
        all.push_back({"Third", {.name = "stats", .help = "A file."}, &stats});
        all.push_back({"Third", {.name = "help", .help = "Help."}, &asks_for_help});
        return all;
    }

    bool asks_for_help = false;
};

ParsedArguments parsed(const std::vector<std::string>& words)
{
    Values values;
    return parse_arguments(words, values.options());
}

SampleOptions options_of(const std::vector<std::string>& words)
{
    Values values;
    read_options(parse_arguments(words, values.options()), values.options());
    return values.sample;
}

std::string refusal_of(const std::vector<std::string>& words)
{
    try {
        options_of(words);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(OptionParser, SeparatesOperandsFromOptionsInAnyOrder)
{
    const ParsedArguments given =
        parsed({"in", "--angle", "7", "--closed", "out", "--stats=s.json"});
    EXPECT_THAT(given.operands, ElementsAre("in", "out"));
    EXPECT_EQ(given.options, (std::map<std::string, std::string>{
                                 {"angle", "7"}, {"closed", ""}, {"stats", "s.json"}}));
}

TEST(OptionParser, TreatsWordsAfterTwoDashesAsOperands)
{
    const ParsedArguments given = parsed({"--closed", "--", "--angle", "-x"});
    EXPECT_THAT(given.operands, ElementsAre("--angle", "-x"));
    EXPECT_EQ(given.options, (std::map<std::string, std::string>{{"closed", ""}}));
}

TEST(ReadOptions, SetsOnlyGivenOptions)
{
    const SampleOptions options = options_of(
        {"--angle=12.25", "--min-views=7", "--min-views", "5", "--closed", "--shape", "flat"});
    EXPECT_EQ(options.angle_deg, 12.25);
    EXPECT_EQ(options.spacing, 2.0);
    EXPECT_EQ(options.views, 5);
    EXPECT_TRUE(options.closed);
    EXPECT_EQ(options.shape, Shape::flat);
    EXPECT_EQ(options.memory, 3 << 20);
}

TEST(ReadOptions, ParsesMemorySizesWithSuffix)
{
    EXPECT_EQ(options_of({"--memory", "8G"}).memory, std::int64_t{8} << 30);
    EXPECT_EQ(options_of({"--memory", "0"}).memory, 0);
    EXPECT_EQ(refusal_of({"--memory", "8 apples"}),
              "--memory takes a size in bytes, or with K, M or G as in 8G, not \"8 apples\"");
}

TEST(ReadOptions, AcceptsTheWordOfAnOption)
{
    EXPECT_EQ(options_of({}).factor, 7.0);
    EXPECT_EQ(options_of({"--factor=usual"}).factor, 1.0);
    EXPECT_EQ(options_of({"--factor=2.5"}).factor, 2.5);
    EXPECT_EQ(refusal_of({"--factor=unusual"}),
              "--factor takes usual or a number, 0 or more, not \"unusual\"");
}

TEST(ReadOptions, AcceptsWordsOrThreeNumbers)
{
    EXPECT_EQ(options_of({}).place.word, 0);
    EXPECT_EQ(options_of({"--place", "there"}).place.word, 1);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--place", "-1,2.5,1e-3"}, {"--place=-1,2.5,0.001"}}) {
        const WordOrVector place = options_of(words).place;
        EXPECT_EQ(place.word, WordOrVector::kNoWord);
        EXPECT_EQ(place.vector, Eigen::Vector3d(-1.0, 2.5, 1e-3));
    }
}

TEST(ReadOptions, RejectsTextThatIsNeitherAWordNorThreeNumbers)
{
    const std::string expected = "--place takes here, there or x,y,z from -10 to 10, not ";
    for (const std::string text :
         {"nowhere", "1", "1,2", "1,2,", "1,2,3,4", "1, 2,3", "1,x,3", "1;2;3", "1e999,0,0"}) {
        EXPECT_EQ(refusal_of({"--place", text}), expected + '"' + text + '"');
    }
    EXPECT_EQ(refusal_of({"--place", "1,inf,3"}), expected + "inf");
    EXPECT_EQ(refusal_of({"--place", "1,2,nan"}), expected + "nan");
    EXPECT_EQ(refusal_of({"--place", "1,2,10.5"}), expected + "10.5");
}

TEST(ReadOptions, AcceptsAWordABoxOrAFileForARegion)
{
    using Kind = RegionChoice::Kind;
    EXPECT_EQ(options_of({}).part.kind, Kind::everything);
    EXPECT_EQ(options_of({"--part", "auto"}).part.kind, Kind::looked_at);
    EXPECT_EQ(options_of({"--part", "auto", "--part", "none"}).part.kind, Kind::everything);
    const RegionChoice box = options_of({"--part", "-1,0,1e-3,2,0.5,7"}).part;
    EXPECT_EQ(box.kind, Kind::box);
    EXPECT_EQ(box.low, Eigen::Vector3d(-1, 0, 1e-3));
    EXPECT_EQ(box.high, Eigen::Vector3d(2, 0.5, 7));
    for (const std::string path : {"a/part.ply", "corners.txt", "5", "a,b", "./1,2"}) {
        EXPECT_EQ(options_of({"--part", path}).part.kind, Kind::file);
        EXPECT_EQ(options_of({"--part", path}).part.file, path);
    }
}

TEST(ReadOptions, RejectsListsThatAreNotABox)
{
    const std::string expected = "--part takes none, auto, x0,y0,z0,x1,y1,z1 or a file, not ";
    for (const std::string text :
         {"1,2", "0,0,0,1,1", "0,0,0,1,1,1,1", "0,0,0,1,1,x", "0,0,0,1,1,", "0, 0,0,1,1,1"}) {
        EXPECT_EQ(refusal_of({"--part", text}), expected + '"' + text + '"');
    }
    EXPECT_EQ(refusal_of({"--part", "0,0,0,1,-1,1"}),
              "--part takes a box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and z0 < z1, not "
              "0,0,0,1,-1,1");
}

TEST(ReadOptions, RejectsValuesOfTheWrongType)
{
    EXPECT_EQ(refusal_of({"--angle", "wide"}),
              "--angle takes a number from 0 to 180 (deg), not \"wide\"");
    EXPECT_EQ(refusal_of({"--angle", "1,5"}),
              "--angle takes a number from 0 to 180 (deg), not \"1,5\"");
    EXPECT_EQ(refusal_of({"--min-views", "3.5"}),
              "--min-views takes a whole number, 2 or more (views), not \"3.5\"");
    EXPECT_EQ(refusal_of({"--min-views", "99999999999"}),
              "--min-views takes a whole number, 2 or more (views), not \"99999999999\"");
    EXPECT_EQ(refusal_of({"--spacing", "nan"}), "--spacing takes a number, 0 or more, not nan");
    EXPECT_EQ(refusal_of({"--shape", "square"}), "--shape takes round or flat, not \"square\"");
    EXPECT_EQ(refusal_of({"--angle="}), "--angle needs a value: a number from 0 to 180 (deg)");
}

TEST(OptionParser, RejectsAnOptionWithoutValue)
{
    EXPECT_EQ(refusal_of({"--min-views"}),
              "--min-views needs a value: a whole number, 2 or more (views)");
    EXPECT_EQ(refusal_of({"--shape"}), "--shape needs a value: round or flat");
    EXPECT_EQ(refusal_of({"--stats", ""}), "--stats needs a value: a path");
    EXPECT_EQ(refusal_of({"--shape", "--closed"}), "--shape needs a value: round or flat");
}

TEST(OptionParser, AcceptsColmapsNamesOfOperands)
{
    EXPECT_THAT(parsed({"-i", "in", "-o", "out"}).operands, ElementsAre("in", "out"));
    EXPECT_THAT(parsed({"--output_path=out", "--closed", "--input_path", "in"}).operands,
                ElementsAre("in", "out"));
    EXPECT_THAT(parsed({"-o", "out", "in"}).operands, ElementsAre("in", "out"));
}

TEST(OptionParser, AcceptsColmapsInputTypeAsPoints)
{
    std::string points;
    const OptionList options = {{"Input", {.name = "points", .help = "Which."}, &points}};
    const std::vector<std::string> words = {"--input_type", "dense", "--input_path", "in"};
    EXPECT_EQ(parse_arguments(words, options).options.at("points"), "dense");
}

TEST(OptionParser, ReportsTheWrongWord)
{
    EXPECT_EQ(refusal_of({"--closed=yes"}), "--closed takes no value; remove \"yes\"");
    EXPECT_EQ(refusal_of({"--closed", "no", "in"}), "--closed takes no value; remove \"no\"");
    EXPECT_EQ(refusal_of({"--closed", "in"}), "accepted");
    EXPECT_EQ(refusal_of({"--secret", "2"}),
              "--secret can be set from C++ and Python only, not on the command line");
    EXPECT_EQ(refusal_of({"in", "--frobnicate", "out"}),
              "there is no option --frobnicate (see colmap-vcarve --help)");
    EXPECT_EQ(refusal_of({"-x"}), "there is no option -x (see colmap-vcarve --help)");
}

TEST(Nearest, PrefersCandidatesThatContainTheWord)
{
    EXPECT_EQ(nearest("--views", {"--view", "--min-views"}), "--min-views");
    EXPECT_EQ(nearest("--min", {"--in", "--min-views"}), "--min-views");
}

TEST(Nearest, CountsInsertedRemovedAndReplacedLetters)
{
    EXPECT_EQ(nearest("--colsed", {"--closed", "--colored"}), "--closed");
    EXPECT_EQ(nearest("--quite", {"--quiet", "--ascii"}), "--quiet");
    EXPECT_EQ(nearest("--ascii", {"--quiet", "--help"}), "");
}

Manual sample_manual()
{
    const auto options = std::make_shared<SampleOptions>();
    Manual manual;
    manual.command = "carve";
    manual.operands = "IN OUT";
    manual.summary = "Carves.";
    manual.examples = {{"carve a b", "the default"}, {"carve --closed a b", "closed"}};
    manual.operand_meanings = {{"IN", "Input. Any."}};
    manual.ends = {"Exit codes: 0."};
    manual.options = options_of(*options);
    manual.values = options;
    return manual;
}

TEST(HelpText, ShowsOneLinePerCommonOption)
{
    EXPECT_EQ(help_text(sample_manual(), false), R"(Carves.

Usage: carve IN OUT [options]

Examples:
  carve a b           the default
  carve --closed a b  closed

Arguments:
  IN                          Input

First options:
  --angle N                   Drop smaller angles; 0 keeps all
                              [default: 10.5, max: 180]
  --spacing N                 A pure number [default: 2]

Second options:
  --min-views N               Drop points [default: 3, min: 2]
  --closed                    Keep a|b
  --shape round|flat          What it is like [default: round]
  --memory SIZE               Take no more [default: 3M]
  --place here|there|X,Y,Z    Where it is [default: here, min: -10, max: 10]
  --part none|auto|BOX|FILE   How much [default: none]

Exit codes: 0.
)");
}

TEST(HelpText, ShowsFullTextsOfAllOptionsOnRequest)
{
    const std::string all = help_text(sample_manual(), true);
    EXPECT_THAT(all, HasSubstr("\n  IN                          Input. Any.\n"));
    EXPECT_THAT(all, HasSubstr("\nThird options:\n"
                               "  --factor usual|N            Of what is usual. [default: 7]\n"));
    EXPECT_THAT(all, Not(HasSubstr("--secret")));
    EXPECT_THAT(help_text(sample_manual(), false), Not(HasSubstr("--factor")));
}

TEST(MarkdownOptions, ShowOneTablePerHeading)
{
    EXPECT_EQ(markdown_options(sample_manual()), R"(## carve IN OUT

### First options

| option | default | range | meaning |
|---|---|---|---|
| `--angle N` | 10.5 | max: 180 | Drop smaller angles; 0 keeps all. |
| `--spacing N` | 2 |  | A pure number. |

### Second options

| option | default | range | meaning |
|---|---|---|---|
| `--min-views N` | 3 | min: 2 | Drop points. |
| `--closed` |  |  | Keep a\|b. |
| `--shape round\|flat` | round |  | What it is like. |
| `--memory SIZE` | 3M |  | Take no more. |
| `--place here\|there\|X,Y,Z` | here | min: -10, max: 10 | Where it is. |
| `--part none\|auto\|BOX\|FILE` | none |  | How much. |

### Third options

| option | default | range | meaning |
|---|---|---|---|
| `--factor usual\|N` | 7 |  | Of what is usual. |

### C++ and Python only

These options are for studying the method. In Python they are keywords, with `_` for `-`.

#### Third options

| option | default | range | meaning |
|---|---|---|---|
| `secret` | 1 |  | For C++. |
)");
}

} // namespace
} // namespace vcarve::cli::command_line_test
