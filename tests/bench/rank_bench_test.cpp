#include "rank_bench.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::bench {
namespace {

using testing::HasSubstr;

/// Stands for mpirun: -q --oversubscribe --bind-to none -n R PROGRAM --quiet --threads T --work DIR
/// MODEL OUT. Writes another surface for MODEL `bad`.
constexpr const char* kFakeLauncher = R"sh(#!/bin/sh
echo "ranks $@" >> "$(dirname "$0")/calls"
test -e "${12}" && echo "work folder is there" >> "$(dirname "$0")/calls"
mkdir "${12}"
surface=surface
if [ "${13}" = bad ]; then surface=other; fi
echo $surface > "${14}"
)sh";

/// Stands for the program on one process: --quiet --threads T --blocks 0 MODEL OUT.
constexpr const char* kFakeProgram = R"sh(#!/bin/sh
echo "alone $@" >> "$(dirname "$0")/calls"
echo surface > "$7"
)sh";

/// A folder with both in it.
class FakePrograms {
  public:
    FakePrograms()
    {
        for (const auto& path :
             {folder_.write("launcher", kFakeLauncher), folder_.write("program", kFakeProgram)}) {
            std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        }
    }

    RankRuns runs() const
    {
        return {.program = folder_ / "program",
                .rank_program = "on-ranks",
                .launcher = folder_ / "launcher",
                .folder = folder_ / "made"};
    }
    std::string calls() const { return bytes_of(folder_ / "calls"); }

  private:
    TemporaryFolder folder_;
};

TEST(MeasureRanks, RunsEachModelOnItsRanksAndAlone)
{
    const FakePrograms fakes;
    RankRuns runs = fakes.runs();
    runs.rounds = 2;
    const std::vector<RankRun> results = measure_ranks({{"small", 10, 1}, {"large", 20, 2}}, runs);
    const std::string made = runs.folder;
    const auto on_ranks = [&](const std::string& ranks, const std::string& model) {
        return "ranks -q --oversubscribe --bind-to none -n " + ranks +
               " on-ranks --quiet --threads 1 --work " + made + "/work " + model + " " + made +
               "/ranks.ply\nalone --quiet --threads 1 --blocks 0 " + model + " " + made +
               "/alone.ply\n";
    };
    const std::string round = on_ranks("1", "small") + on_ranks("2", "large");
    EXPECT_EQ(fakes.calls(), round + round);
    EXPECT_TRUE(is_same_everywhere(results));
    ASSERT_EQ(results.size(), 2U);
    EXPECT_EQ(results[1].model.ranks, 2U);
    EXPECT_GT(results[1].figures["seconds"].get<double>(), 0.0);
    EXPECT_GT(results[1].alone["seconds"].get<double>(), 0.0);
    EXPECT_FALSE(std::filesystem::exists(runs.folder / "work"));
}

TEST(MeasureRanks, FindsTheModelsOfAnotherSurface)
{
    const FakePrograms fakes;
    const auto results = measure_ranks({{"bad", 10, 1}, {"good", 20, 2}}, fakes.runs());
    EXPECT_FALSE(is_same_everywhere(results));
    ASSERT_EQ(results.size(), 2U);
    EXPECT_FALSE(results[0].is_same);
    EXPECT_TRUE(results[1].is_same);
    EXPECT_EQ(json_of(results)[0]["same_bytes"], false);
}

TEST(RankReport, HoldsRunsToTheFirst)
{
    const auto figures = [](double seconds, double cpu) {
        return Json{{"seconds", seconds},
                    {"cpu_seconds", cpu},
                    {"peak_bytes", 30e6},
                    {"written_bytes", 7e6}};
    };
    const std::string text = rank_report("terrain", {{.model = {"a", 1'000'000, 1},
                                                      .figures = figures(10, 8),
                                                      .alone = figures(9, 6),
                                                      .is_same = true},
                                                     {.model = {"b", 2'000'000, 2},
                                                      .figures = figures(20, 20),
                                                      .alone = figures(18, 16),
                                                      .is_same = false}});
    EXPECT_THAT(text, HasSubstr("## terrain\n"));
    EXPECT_THAT(text, HasSubstr("| 1 | 1000000 | 10.00 | 8.00 | 8.00 | 1.00 | 1.00 | 6.00 | 1.33 | "
                                "30 | 7 | yes |\n"));
    EXPECT_THAT(text, HasSubstr("| 2 | 2000000 | 20.00 | 20.00 | 10.00 | 0.80 | 0.50 | 8.00 | 1.25 "
                                "| 30 | 7 | **NO** |\n"));
}

} // namespace
} // namespace vcarve::bench
