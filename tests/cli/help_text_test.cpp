#include "cli/help_text.h"
#include "support/sample_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace vcarve::cli::help_text_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST(HelpText, HasALinePerCommonOption)
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

TEST(HelpText, HasWholeTextsOfMoreOptionsOnRequest)
{
    const std::string all = help_text(sample_manual(), true);
    EXPECT_THAT(all, HasSubstr("\n  IN                          Input. Any.\n"));
    EXPECT_THAT(all, HasSubstr("\nThird options:\n"
                               "  --factor usual|N            Of what is usual. [default: 7]\n"));
    EXPECT_THAT(all, Not(HasSubstr("--secret")));
    EXPECT_THAT(help_text(sample_manual(), false), Not(HasSubstr("--factor")));
}

TEST(HelpText, BreaksLongTextsBetweenWordsAndLongTermsAfterThem)
{
    Manual manual = sample_manual();
    manual.options.resize(1);
    manual.options[0].info.name = "a-name-that-leaves-no-room";
    manual.options[0].info.help = "Words that go on and on, further than the hundredth column of a "
                                  "line that anybody wants to read.";
    EXPECT_THAT(
        help_text(manual, true),
        HasSubstr("  --a-name-that-leaves-no-room N\n"
                  "                              Words that go on and on, further than the\n"
                  "                              hundredth column of a line that anybody "
                  "wants to\n"
                  "                              read. [default: 10.5, max: 180]\n"));
}

TEST(MarkdownOptions, IsATablePerHeading)
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
} // namespace vcarve::cli::help_text_test
