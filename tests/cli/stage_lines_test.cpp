#include "cli/stage_lines.h"

#include <gtest/gtest.h>

namespace vcarve::cli::stage_lines_test {
namespace {

TEST(CountsText, SaysTheResultThenWhatItWasTakenFromThenTheRest)
{
    EXPECT_EQ(
        counts_text({{"points", 24310}, {"of", 25784}, {"few views", 1102}, {"high error", 372}}),
        "24,310 of 25,784 points (1,102 few views, 372 high error)");
    EXPECT_EQ(counts_text({{"cells", 1000000}, {"vertices", 999}}),
              "1,000,000 cells (999 vertices)");
    EXPECT_EQ(counts_text({{"faces", 0}}), "0 faces");
    EXPECT_EQ(counts_text({}), "");
}

TEST(CountsText, LeavesOutWhatDidNotHappen)
{
    EXPECT_EQ(counts_text({{"points", 12}, {"of", 12}, {"few views", 0}}), "12 of 12 points");
}

TEST(CountsText, GroupsDigitsOfNegativeNumbers)
{
    EXPECT_EQ(counts_text({{"a", -123}, {"b", -1234}, {"c", -123456}}),
              "-123 a (-1,234 b, -123,456 c)");
}

TEST(StageWords, SayTheCountsInTheWordsOfTheField)
{
    const StageWords cut = stage_words("cut", {{"inside", 11283}, {"of", 22611}, {"needles", 2}});
    EXPECT_EQ(cut.name, "cut");
    EXPECT_EQ(cut.text, "11,283 of 22,611 cells are solid");
    EXPECT_TRUE(cut.is_shown);
    const StageWords settle =
        stage_words("settle", {{"vertices moved", 2920}, {"thousandths of a pixel of noise", 272}});
    EXPECT_EQ(settle.name, "denoise");
    EXPECT_EQ(settle.text, "2,920 vertices moved within their error (0.27 px)");
}

TEST(StageWords, LeaveOutWhatDidNotHappenAndWhatHasNoRoom)
{
    Counts counts = {{"points", 3133}, {"of", 3243}, {"duplicate", 110}, {"few views", 0}};
    EXPECT_EQ(stage_words("filter", counts).text, "3,133 of 3,243 points kept, 110 duplicate");
    counts = {{"points", 1234567},    {"of", 2345678},       {"duplicate", 100000},
              {"few views", 1000000}, {"high error", 10000}, {"low angle", 5}};
    EXPECT_EQ(stage_words("filter", counts).text,
              "1,234,567 of 2,345,678 points kept, 100,000 duplicate");
}

TEST(StageWords, AreThereOnlyInDetailWhereTheyTellAUserNothing)
{
    const StageWords open = stage_words("open", {{"rays of the views", 1}, {"of", 3960}});
    EXPECT_FALSE(open.is_shown);
    EXPECT_EQ(open.text, "1 of 3,960 rays of the views");
}

TEST(StageWords, ShowAllCountsOfAStageThatIsNotKnown)
{
    const StageWords words = stage_words("measure", {{"faces of a.ply", 12}, {"of", 13}});
    EXPECT_EQ(words.name, "measure");
    EXPECT_EQ(words.text, "12 of 13 faces of a.ply");
    EXPECT_EQ(stage_words("cut", {{"insides", 3}}).text, "3 insides");
}

TEST(StageLine, KeepsNamesAndSecondsInColumns)
{
    EXPECT_EQ(stage_line({"fill", "12 points added on planes"}, 0.034),
              "fill         12 points added on planes                                   0.03 s");
    EXPECT_EQ(stage_line({"fill", std::string(55, 'x')}, 1234.5).size(), 79U);
}

} // namespace
} // namespace vcarve::cli::stage_lines_test
