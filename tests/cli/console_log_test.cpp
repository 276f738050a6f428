#include "base/progress.h"
#include "base/stage_counts.h"
#include "cli/console_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
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
        stage.end({{counts::kRead.points, 12}});
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
        stage.end({{counts::kRead.points, 12, kNoTotal, "\x1b[2J.ply"}});
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
    stage.end({{counts::kRead.points, 7}});
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
    stage.end({{counts::kCells.all, 1}});
    EXPECT_THAT(screen.text(),
                MatchesRegex("(.|\n)* 50 %  about 1 s left\r\x1b\\[Kcut +1 cell +[0-9.]+ s\n"));
}

TEST(ConsoleLog, KeepsCountsAndPrintsNothingWhenQuiet)
{
    const Screen screen;
    ConsoleLog log({.stream = screen.stream(), .quiet = true});
    Stage(log, "read").end({{counts::kRead.points, 12}});
    log.note("a note");
    log.conclude("done");
    EXPECT_EQ(screen.text(), "");
    EXPECT_EQ(find_count(log.counts().at("read"), counts::kRead.points)->value, 12);
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
    EXPECT_EQ(counts_text({{counts::kFilter.points, 24310, 25784},
                           {counts::kFilter.few_views, 1102},
                           {counts::kFilter.high_error, 372}}),
              "24,310 of 25,784 points (1,102 few views, 372 high error)");
    EXPECT_EQ(counts_text({{counts::kDense.maps, 2}, {counts::kDense.measured, 1000000, 1000001}}),
              "2 depth maps (1,000,000 of 1,000,001 pixels measured)");
    EXPECT_EQ(counts_text({{counts::kOutput.faces, 0}, {counts::kOutput.vertices, 0}}), "0 faces");
    EXPECT_EQ(counts_text({}), "");
}

TEST(CountsText, GroupsDigitsOfNegativeNumbers)
{
    const CountKind kind = {"a", "", ""};
    EXPECT_EQ(counts_text({{kind, -123}, {kind, -1234}, {kind, -123456}}),
              "-123 a (-1,234 a, -123,456 a)");
}

TEST(StageWords, DescribeCountsInTermsOfTheField)
{
    EXPECT_EQ(stage_words({{counts::kCells.inside, 11283, 22611}, {counts::kCells.on_hull, 2}}),
              "11,283 of 22,611 cells are solid");
    EXPECT_EQ(stage_words({{counts::kDenoise.vertices, 2920, 3612},
                           {counts::kDenoise.held, 196},
                           {counts::kDenoise.noise, 272}}),
              "2,920 vertices moved within their error (0.27 px)");
    EXPECT_EQ(stage_words({{counts::kMerge.faces, 775, 16927}, {counts::kMerge.components, 3}}),
              "16,927 faces merged to 775");
}

TEST(StageWords, NameTheSubject)
{
    EXPECT_EQ(stage_words({{counts::kCompare.faces, 1, kNoTotal, "a.ply"}}), "1 face of a.ply");
    EXPECT_EQ(stage_words({{counts::kCompare.faces, 12, kNoTotal, "{}.ply"}}),
              "12 faces of {}.ply");
}

TEST(StageWords, UsesTheSingularForOne)
{
    EXPECT_EQ(stage_words({{counts::kTexture.charts, 1}, {counts::kTexture.pages, 1}}),
              "1 chart on 1 page");
    EXPECT_EQ(stage_words({{counts::kPlan.tiles, 1}, {counts::kPlan.points, 1}}),
              "1 tile (1 point)");
}

TEST(StageWords, OmitZeroCountsAndTextsWithoutRoom)
{
    Counts filtered = {{counts::kFilter.points, 3133, 3243},
                       {counts::kFilter.duplicate, 110},
                       {counts::kFilter.few_views, 0}};
    EXPECT_EQ(stage_words(filtered), "3,133 of 3,243 points kept, 110 duplicate");
    filtered = {{counts::kFilter.points, 1234567, 2345678},
                {counts::kFilter.duplicate, 100000},
                {counts::kFilter.few_views, 1000000},
                {counts::kFilter.high_error, 10000},
                {counts::kFilter.low_angle, 5}};
    EXPECT_EQ(stage_words(filtered), "1,234,567 of 2,345,678 points kept, 100,000 duplicate");
}

TEST(StageWords, ShowTheFirstTextAndRequiredTextsAlways)
{
    EXPECT_EQ(
        stage_words({{counts::kRead.points, 0}, {counts::kRead.views, 1}, {counts::kRead.rays, 0}}),
        "0 points, 1 view, 0 rays");
}

TEST(StageWords, AreMissingForAStageWithoutTexts)
{
    EXPECT_EQ(stage_words({{counts::kMesh.open, 1, 3960}, {counts::kMesh.past, 561}}),
              std::nullopt);
    EXPECT_EQ(stage_words({}), "");
}

} // namespace
} // namespace vcarve::cli::console_log_test
