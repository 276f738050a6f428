#include "cli/manual.h"
#include "support/sample_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace vcarve::cli::help_text_test {
namespace {

using ::testing::Not;

Manual sample_manual()
{
    const auto options = std::make_shared<SampleOptions>();
    Manual manual;
    manual.command = "carve";
    manual.operands = "IN OUT";
    manual.summary = "Carves.";
    manual.examples = {{"carve a b", "the default"}, {"carve --closed a b", "closed"}};
    manual.operand_meanings = {{"IN", "What is read."}};
    manual.footnotes = {{"Exit code", "0 done."}};
    manual.options = options_of(*options);
    manual.values = options;
    return manual;
}

TEST(HelpText, GroupsOptionsByStageWithUnitDefaultAndRange)
{
    EXPECT_EQ(help_text(sample_manual(), false), R"(Carves.

Usage: carve IN OUT [options]

Examples:
  carve a b           the default
  carve --closed a b  closed

  IN                          What is read.

First:
  --angle <deg>               Drop smaller angles; 0 keeps all.
                              [default 10.5, 0 to 180]
  --spacing <number>          A pure number. [default 2]

Second:
  --min-views <views>         Drop points. [default 3, 2 or more]
  --closed                    Keep a|b.
  --shape round|flat          What it is like. [default round]
  --memory <size>             Take no more. [default 3M]
  --place here|there|x,y,z    Where it is. [default here, -10 to 10]
  --part none|auto|box|<file>
                              How much. [default none]

  Exit code                   0 done.
)");
}

TEST(HelpText, ListsWhatIsForTuningOnlyWhereItIsAskedFor)
{
    const std::string entry = "\nThird:\n"
                              "  --factor usual|<number>     Of what is usual. [default 7]\n";
    EXPECT_THAT(help_text(sample_manual(), true), ::testing::HasSubstr(entry));
    EXPECT_THAT(help_text(sample_manual(), false), Not(::testing::HasSubstr("--factor")));
}

TEST(HelpText, BreaksLongTextsBetweenWordsAndLongTermsAfterThem)
{
    Manual manual = sample_manual();
    manual.options.resize(1);
    manual.options[0].info.name = "a-name-that-leaves-no-room-beside";
    manual.options[0].info.help =
        "Words that go on and on, further than the hundredth column of a line "
        "that anybody wants to read.";
    EXPECT_THAT(
        help_text(manual, false),
        ::testing::HasSubstr(
            "  --a-name-that-leaves-no-room-beside <deg>\n"
            "                              Words that go on and on, further than the\n"
            "                              hundredth column of a line that anybody wants to\n"
            "                              read. [default 10.5, 0 to 180]\n"));
}

TEST(MarkdownOptions, IsATableAStage)
{
    EXPECT_EQ(markdown_options(sample_manual()), R"(## carve IN OUT

### First

| option | default | range | meaning |
|---|---|---|---|
| `--angle <deg>` | 10.5 | 0 to 180 | Drop smaller angles; 0 keeps all. |
| `--spacing <number>` | 2 |  | A pure number. |

### Second

| option | default | range | meaning |
|---|---|---|---|
| `--min-views <views>` | 3 | 2 or more | Drop points. |
| `--closed` |  |  | Keep a\|b. |
| `--shape round\|flat` | round |  | What it is like. |
| `--memory <size>` | 3M |  | Take no more. |
| `--place here\|there\|x,y,z` | here | -10 to 10 | Where it is. |
| `--part none\|auto\|box\|<file>` | none |  | How much. |

### For tuning, listed by `--help-all`

#### Third

| option | default | range | meaning |
|---|---|---|---|
| `--factor usual\|<number>` | 7 |  | Of what is usual. |
)");
}

} // namespace
} // namespace vcarve::cli::help_text_test
