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

/// A file that is gone with the test, in the place of a terminal.
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

TEST(BarLine, FillsWithTheShareDone)
{
    EXPECT_EQ(bar_line("cut", 0.5, 12.3, 80),
              "cut          [===============>              ]  50 %  12 s");
    EXPECT_EQ(bar_line("cut", 1.0, 0.0, 80),
              "cut          [==============================] 100 %  0 s");
}

TEST(BarLine, ShowsOnlySecondsWhileNothingIsKnownOfTheShare)
{
    EXPECT_EQ(bar_line("triangulate", 0.0, 3.0, 80), "triangulate  3 s");
}

TEST(BarLine, IsNarrowerThanTheTerminal)
{
    EXPECT_EQ(bar_line("cut", 0.5, 12.3, 20), "cut          [=====");
}

TEST(ConsoleLog, PrintsALineAStageAndANoteAtOnce)
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

TEST(ConsoleLog, ObeysNoName)
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

TEST(ConsoleLog, DropsWhatCannotBeWritten)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> full(std::fopen("/dev/full", "w"),
                                                               std::fclose);
    ConsoleLog log({.stream = full.get(), .live = true, .bar_after_s = 0, .run_bar_after_s = 0});
    Stage stage(log, "read");
    std::this_thread::sleep_for(std::chrono::milliseconds(150)); // a bar is drawn
    log.note("nobody reads this");
    stage.end({{"points", 7}});
    log.conclude("nor this");
}

TEST(ConsoleLog, ShowsNoBarWhereTheStreamIsNoTerminal)
{
    const Screen screen;
    {
        ConsoleLog log({.stream = screen.stream(), .live = false, .bar_after_s = 0});
        Stage stage(log, "cut");
        stage.progress(0.5);
        stage.end({{"cells", 1}});
    }
    EXPECT_THAT(screen.text(), Not(HasSubstr("\r")));
}

TEST(ConsoleLog, MovesABarWhileAStageRunsAndRemovesItForTheLine)
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
                MatchesRegex("(.|\n)* 50 %  0 s\r\x1b\\[Kcut +1 cells +[0-9.]+ s\n"));
}

TEST(RunLine, ShowsTheStageAndWhatIsLeftOfTheRun)
{
    EXPECT_EQ(run_line("cut", {.share = 0.5, .left_seconds = 12.3}, 80),
              "cut          [===============>              ]  50 %  12 s left");
    EXPECT_EQ(run_line("cut", {.share = 0.999, .left_seconds = 0.2}, 80),
              "cut          [=============================>]  99 %  1 s left");
    EXPECT_EQ(run_line("smooth", {.share = 0.0, .left_seconds = 100}, 80),
              "smooth       [>                             ]   0 %  2 min left");
    EXPECT_EQ(run_line("smooth", {.share = 0.0, .left_seconds = 7300}, 80),
              "smooth       [>                             ]   0 %  2 h left");
}

TEST(RunLine, IsNarrowerThanTheTerminal)
{
    for (std::size_t columns = 1; columns < 80; ++columns) {
        EXPECT_LT(run_line("triangulate", {.share = 0.5, .left_seconds = 12}, columns).size(),
                  columns);
    }
    EXPECT_EQ(run_line("cut", {.share = 0.5, .left_seconds = 12}, 40),
              "cut          [===>   ]  50 %  12 s left");
    EXPECT_EQ(run_line("cut", {.share = 0.5, .left_seconds = 12}, 36),
              "cut           50 %  12 s left");
}

TEST(ConsoleLog, MovesABarOfTheRunWhereItIsExpectedToBeLong)
{
    const Screen screen;
    ConsoleLog log({.stream = screen.stream(), .live = true});
    log.expect({.stages = {{"read", 50}, {"cut", 50}}, .points = 0});
    Stage stage(log, "read");
    while (screen.text().find("   0 %  2 min left") == std::string::npos) {
        std::this_thread::yield();
    }
    stage.end({{"points", 1}});
    EXPECT_THAT(screen.text(), MatchesRegex("(.|\n)*left\r\x1b\\[Kread +1 points +[0-9.]+ s\n"));
}

TEST(ConsoleLog, ForetellsARunOfMinutesOnce)
{
    const Screen screen;
    ConsoleLog log({.stream = screen.stream()});
    log.expect({.stages = {{"read", 50}, {"cut", 60}}, .points = 0});
    EXPECT_EQ(screen.text(), "");
    for (int i = 0; i < 2; ++i) {
        log.expect({.stages = {{"read", 50}, {"smooth", 670}, {"cut", 60}}, .points = 0});
        EXPECT_EQ(screen.text(), "note: this may take 13 min, of which smooth takes 11 min\n");
    }
}

TEST(ConsoleLog, ShowsNoBarOfAShortRun)
{
    const Screen screen;
    {
        ConsoleLog log({.stream = screen.stream(), .live = true, .bar_after_s = 0});
        log.expect({.stages = {{"read", 1}, {"cut", 3}}, .points = 0});
        Stage stage(log, "read");
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
        stage.end({{"points", 1}});
    }
    EXPECT_THAT(screen.text(), Not(HasSubstr("\r")));
}

TEST(ConsoleLog, ShowsABarOfTheRunWhereItHasBecomeLong)
{
    const Screen screen;
    ConsoleLog log({.stream = screen.stream(), .live = true, .run_bar_after_s = 0.2});
    log.expect({.stages = {{"read", 0.01}, {"cut", 0.01}}, .points = 0});
    const Stage stage(log, "read");
    while (screen.text().find(" s left") == std::string::npos) {
        std::this_thread::yield();
    }
}

TEST(ConsoleLog, EndsWithASentenceInBoldWhereThatIsWanted)
{
    for (const bool emphasis : {false, true}) {
        const Screen screen;
        ConsoleLog log({.stream = screen.stream(), .emphasis = emphasis});
        log.conclude("done");
        EXPECT_EQ(screen.text(), emphasis ? "\x1b[1mdone\x1b[0m\n" : "done\n");
    }
}

} // namespace
} // namespace vcarve::cli::console_log_test
