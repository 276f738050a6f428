#include "base/progress.h"
#include "cli/console_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

namespace vcarve::cli::console_log_test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

/// A temporary file that replaces a terminal.
class Screen {
  public:
    std::FILE* stream() const { return file_.get(); }
    std::string text() const
    {
        std::fflush(file_.get());
        std::string text(static_cast<std::size_t>(std::ftell(file_.get())), '\0');
        EXPECT_EQ(::pread(::fileno(file_.get()), text.data(), text.size(), 0),
                  static_cast<ssize_t>(text.size()));
        return text;
    }

  private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{std::tmpfile(), std::fclose};
};

TEST(BarLine, ShowsTheShareAndTheTimeLeft)
{
    EXPECT_EQ(bar_line("cut", 0.5, 12.3, 80),
              "cut          [===============>              ]  50 %  about 12 s left");
    EXPECT_EQ(bar_line("cut", 0.1, 20.0, 80),
              "cut          [===>                          ]  10 %  about 3 min left");
    EXPECT_EQ(bar_line("cut", 1.0, 5.0, 80),
              "cut          [==============================] 100 %  about 1 s left");
}

TEST(BarLine, ShowsSecondsWhileTheTimeLeftIsUnknown)
{
    EXPECT_EQ(bar_line("triangulate", 0.0, 3.0, 80), "triangulate  3 s");
    EXPECT_EQ(bar_line("cut", 0.01, 3.0, 80),
              "cut          [>                             ]   1 %  3 s");
}

TEST(BarLine, IsNarrowerThanTheTerminal)
{
    EXPECT_EQ(bar_line("cut", 0.5, 12.3, 20), "cut          [=====");
}

TEST(ConsoleLog, PrintsOneLinePerStageAndNotesImmediately)
{
    const Screen screen;
    {
        ConsoleLog log({.stream = screen.stream()});
        Stage stage(log, "read");
        log.note("images.txt is ignored.");
        stage.end({{"points", 12}});
    }
    EXPECT_THAT(screen.text(),
                MatchesRegex("note: images.txt is ignored.\nread +12 points +[0-9.]+ s\n"));
}

TEST(ConsoleLog, RemovesControlCharactersFromNames)
{
    const Screen screen;
    {
        ConsoleLog log({.stream = screen.stream(), .verbose = true});
        Stage stage(log, "read");
        log.note("of \x1b[2J.ply");
        stage.end({{"points of \x1b[2J.ply", 12}});
    }
    EXPECT_THAT(screen.text(), MatchesRegex("note: of .\\[2J.ply\nread +12 points of .\\[2J.ply "
                                            "+[0-9.]+ s\n"));
    EXPECT_THAT(screen.text(), Not(HasSubstr("\x1b")));
}

TEST(ConsoleLog, IgnoresWriteErrors)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> full(std::fopen("/dev/full", "w"),
                                                               std::fclose);
    ConsoleLog log({.stream = full.get(), .live = true, .bar_after_s = 0});
    Stage stage(log, "read");
    std::this_thread::sleep_for(std::chrono::milliseconds(150)); // a bar is drawn
    log.note("nobody reads this");
    stage.end({{"points", 7}});
    log.conclude("nor this");
}

TEST(ConsoleLog, ShowsABarUntilTheStageEnds)
{
    const Screen screen;
    ConsoleLog log({.stream = screen.stream(), .live = true, .bar_after_s = 0});
    Stage stage(log, "cut");
    stage.progress(0.5);
    while (screen.text().find(" 50 %") == std::string::npos) {
        std::this_thread::yield();
    }
    stage.end({{"cells", 1}});
    EXPECT_THAT(screen.text(),
                MatchesRegex("(.|\n)* 50 %  about 1 s left\r\x1b\\[Kcut +1 cells +[0-9.]+ s\n"));
}

TEST(ConsoleLog, KeepsCountsAndPrintsNothingWhenQuiet)
{
    const Screen screen;
    ConsoleLog log({.stream = screen.stream(), .quiet = true});
    Stage(log, "read").end({{"points", 12}});
    log.note("a note");
    log.conclude("done");
    EXPECT_EQ(screen.text(), "");
    EXPECT_EQ(log.counts().at("read"), (Counts{{"points", 12}}));
}

TEST(ConsoleLog, PrintsTheConclusionInBoldOnRequest)
{
    for (const bool emphasis : {false, true}) {
        const Screen screen;
        ConsoleLog log({.stream = screen.stream(), .emphasis = emphasis});
        log.conclude("done");
        EXPECT_EQ(screen.text(), emphasis ? "\x1b[1mdone\x1b[0m\n" : "done\n");
    }
}

TEST(CountsText, ShowsResultThenTotalThenOtherCounts)
{
    EXPECT_EQ(
        counts_text({{"points", 24310}, {"of", 25784}, {"few views", 1102}, {"high error", 372}}),
        "24,310 of 25,784 points (1,102 few views, 372 high error)");
    EXPECT_EQ(counts_text({{"cells", 1000000}, {"vertices", 999}}),
              "1,000,000 cells (999 vertices)");
    EXPECT_EQ(counts_text({{"faces", 0}}), "0 faces");
    EXPECT_EQ(counts_text({}), "");
}

TEST(CountsText, GroupsDigitsOfNegativeNumbers)
{
    EXPECT_EQ(counts_text({{"a", -123}, {"b", -1234}, {"c", -123456}}),
              "-123 a (-1,234 b, -123,456 c)");
}

TEST(StageWords, DescribeCountsInTermsOfTheField)
{
    const StageWords cut = stage_words("cut", {{"inside", 11283}, {"of", 22611}, {"needles", 2}});
    EXPECT_EQ(cut.text, "11,283 of 22,611 cells are solid");
    EXPECT_TRUE(cut.is_shown);
    const StageWords adjust =
        stage_words("adjust", {{"vertices moved", 2920}, {"thousandths of a pixel of noise", 272}});
    EXPECT_EQ(adjust.text, "2,920 vertices moved within their error (0.27 px)");
}

TEST(StageWords, UsesTheSingularForOne)
{
    EXPECT_EQ(stage_words("texture", {{"charts", 1}, {"pages", 1}}).text, "1 chart on 1 page");
    EXPECT_EQ(stage_words("read", {{"points", 1143}, {"views", 1}, {"rays", 0}}).text,
              "1,143 points, 1 view, 0 rays");
}

TEST(StageWords, OmitZeroCountsAndPartsWithoutRoom)
{
    Counts counts = {{"points", 3133}, {"of", 3243}, {"duplicate", 110}, {"few views", 0}};
    EXPECT_EQ(stage_words("filter", counts).text, "3,133 of 3,243 points kept, 110 duplicate");
    counts = {{"points", 1234567},    {"of", 2345678},       {"duplicate", 100000},
              {"few views", 1000000}, {"high error", 10000}, {"low angle", 5}};
    EXPECT_EQ(stage_words("filter", counts).text,
              "1,234,567 of 2,345,678 points kept, 100,000 duplicate");
}

TEST(StageWords, AreHiddenIfTheTextIsEmpty)
{
    const StageWords open = stage_words("open", {{"rays of the views", 1}, {"of", 3960}});
    EXPECT_FALSE(open.is_shown);
}

TEST(StageWords, ShowAllCountsOfAnUnknownStage)
{
    const StageWords words = stage_words("measure", {{"faces of a.ply", 12}, {"of", 13}});
    EXPECT_EQ(words.text, "12 of 13 faces of a.ply");
    EXPECT_EQ(stage_words("cut", {{"insides", 3}}).text, "3 insides");
}

} // namespace
} // namespace vcarve::cli::console_log_test
