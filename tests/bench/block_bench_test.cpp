#include "block_bench.h"
#include "program_run.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace vcarve::bench {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Stands for the program: takes --quiet --threads T --blocks N [--work DIR] MODEL OUT, puts 300
/// kilobytes aside for a fifth of a second, and writes another surface for MODEL `bad` in 8 blocks.
constexpr const char* kFake = R"sh(#!/bin/sh
echo "$@" >> "$(dirname "$0")/calls"
threads=$3 blocks=$5
if [ "$6" = --work ]; then
    mkdir "$7"
    head -c 300000 /dev/zero > "$7/block"
    sleep 0.2
    rm -r "$7"
    shift 2
fi
surface=surface
if [ "$(basename "$6")" = bad ] && [ "$blocks" = 8 ]; then surface=other; fi
echo $surface > "$7"
)sh";

/// A folder with the program in it.
class FakeProgram {
  public:
    explicit FakeProgram(const char* script)
    {
        const auto path = folder_.write("fake", script);
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    }

    BlockRuns runs() const
    {
        return {.program = folder_ / "fake",
                .folder = folder_ / "made",
                .blocks = {"8", "64"},
                .threads = {1, 2}};
    }
    std::string calls() const { return bytes_of(folder_ / "calls"); }

  private:
    TemporaryFolder folder_;
};

TEST(MeasureProgram, TellsWhatItTookAndPutAside)
{
    const TemporaryFolder folder;
    const std::string work = folder / "work";
    const Json figures =
        measure_program({"/bin/sh", "-c",
                         "mkdir " + work + "; head -c 300000 /dev/zero > " + work + "/a; cat " +
                             work + "/a > " + work + "/b; sleep 0.2; rm -r " + work},
                        work);
    EXPECT_GE(figures["seconds"].get<double>(), 0.2);
    EXPECT_GT(figures["peak_bytes"].get<double>(), 1e5);
    EXPECT_GE(figures["scratch_bytes"].get<double>(), 600'000.0);
    EXPECT_LT(figures["scratch_bytes"].get<double>(), 700'000.0);
    EXPECT_GE(figures["written_bytes"].get<double>(), 600'000.0);
    EXPECT_GE(figures["read_bytes"].get<double>(), 300'000.0);
}

TEST(MeasureProgram, SaysHowAProgramFailed)
{
    EXPECT_EQ(refusal<std::runtime_error>([] {
                  measure_program({"/bin/sh", "-c", "exit 3"}, "");
              }),
              "/bin/sh -c exit 3 ended with exit code 3");
    EXPECT_EQ(refusal<std::runtime_error>([] {
                  measure_program({"/bin/sh", "-c", "kill $$"}, "");
              }),
              "/bin/sh -c kill $$ ended with signal 15");
}

TEST(MeasureBlocks, RunsInMemoryAndInBlocksWithAFolderToPutThingsAside)
{
    const FakeProgram fake(kFake);
    BlockRuns runs = fake.runs();
    runs.threads = {2};
    const BlockResult result = measure_blocks("good", runs);
    const std::string made = runs.folder;
    EXPECT_EQ(fake.calls(), "--quiet --threads 2 --blocks 0 good " + made + "/first.ply\n" +
                                "--quiet --threads 2 --blocks 8 --work " + made + "/work good " +
                                made + "/other.ply\n" + "--quiet --threads 2 --blocks 64 --work " +
                                made + "/work good " + made + "/other.ply\n");
    EXPECT_TRUE(is_same_everywhere(result));
    ASSERT_EQ(result.runs.size(), 3U);
    EXPECT_EQ(result.runs[0].figures["scratch_bytes"], 0);
    EXPECT_GE(result.runs[1].figures["scratch_bytes"], 300'000);
}

TEST(MeasureBlocks, FindsTheRunsThatMadeAnotherSurface)
{
    const FakeProgram fake(kFake);
    BlockRuns runs = fake.runs();
    runs.rounds = 2;
    const BlockResult result = measure_blocks("bad", runs);
    EXPECT_FALSE(is_same_everywhere(result));
    EXPECT_EQ(result.runs.size(), 6U);
    for (const BlockRun& run : result.runs) {
        EXPECT_EQ(run.surface == BlockRun::Surface::other, run.blocks == "8") << run.blocks;
    }
}

TEST(MeasureBlocks, HoldsRunsToTheFirstWhereMemoryCannotHoldTheModel)
{
    const FakeProgram fake(kFake);
    BlockRuns runs = fake.runs();
    runs.in_memory = false;
    EXPECT_TRUE(is_same_everywhere(measure_blocks("good", runs)));
    EXPECT_THAT(fake.calls(), Not(HasSubstr("--blocks 0 ")));
    EXPECT_FALSE(is_same_everywhere(measure_blocks("bad", runs)));
}

TEST(BlockReport, HoldsRunsToThatInMemoryOnAsManyThreads)
{
    const auto figures = [](double seconds, double peak_mb, double scratch_mb) {
        return Json{{"seconds", seconds},          {"cpu_seconds", 2 * seconds},
                    {"peak_bytes", 1e6 * peak_mb}, {"scratch_bytes", 1e6 * scratch_mb},
                    {"written_bytes", 7e6},        {"read_bytes", 8e6}};
    };
    using Surface = BlockRun::Surface;
    const BlockResult result = {
        "terrain",
        1000,
        {{.blocks = "0", .threads = 1, .figures = figures(2, 40, 0), .surface = Surface::unknown},
         {.blocks = "8", .threads = 1, .figures = figures(5, 10, 3), .surface = Surface::same},
         {.blocks = "8", .threads = 2, .figures = figures(3, 11, 4), .surface = Surface::other}}};
    const std::string text = block_report(result);
    EXPECT_THAT(text, HasSubstr("## terrain: 1000 points\n"));
    EXPECT_THAT(text, HasSubstr("| in memory | 1 | 2.00 | 1.00 | 4.00 | 40 | 1.00 | 40000 | 0 | 7 "
                                "| 8 | - |\n"));
    EXPECT_THAT(text, HasSubstr("| 8 | 1 | 5.00 | 2.50 | 10.00 | 10 | 0.25 | 10000 | 3 | 7 | 8 | "
                                "yes |\n"));
    EXPECT_THAT(text, HasSubstr("| 8 | 2 | 3.00 | - | 6.00 | 11 | - | 11000 | 4 | 7 | 8 | **NO** "
                                "|\n"));
}

} // namespace
} // namespace vcarve::bench
