#include "cli/run_memory.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vcarve::cli::run_memory_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

struct Notes : Log {
    void note(std::string_view sentence) override { heard.emplace_back(sentence); }
    std::vector<std::string> heard;
};

constexpr SceneSize kMillion = {.points = 1'000'000, .rays = 4'000'000, .views = 300};
const RunSize kRun = {.read = kMillion, .thinned = kMillion};

MeshArguments with_memory(std::int64_t bytes)
{
    MeshArguments arguments;
    arguments.options.memory.limit = bytes;
    return arguments;
}

TEST(RunMemory, MeshesInOnePieceIfThatFits)
{
    const MeshArguments arguments = with_memory(predicted_peak(kRun, 1));
    RunMemory memory(arguments, 1);
    Notes notes;
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.tile_points(), 0U);
    EXPECT_THAT(notes.heard, IsEmpty());
}

TEST(RunMemory, ChoosesTilesOnceIfMemoryIsShort)
{
    const MeshArguments arguments = with_memory(predicted_peak(kRun, 1) - 1);
    RunMemory memory(arguments, 1);
    Notes notes;
    memory.fit(kRun, notes);
    const std::size_t points = memory.tile_points();
    EXPECT_GT(points, 100'000U);
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.tile_points(), points);
    EXPECT_EQ(memory.record()["tile_points"], points);
    EXPECT_THAT(notes.heard, ElementsAre(MatchesRegex("about [0-9.]+M needed, [0-9.]+M allowed: "
                                                      "tiles of [0-9,]+ points")));
}

TEST(RunMemory, RejectsOptionsThatNeedOnePieceIfMemoryIsShort)
{
    MeshArguments arguments = with_memory(predicted_peak(kRun, 1) - 1);
    arguments.options.surface.closed = true;
    RunMemory memory(arguments, 1);
    Notes notes;
    EXPECT_THAT(refusal<InputError>([&] { memory.fit(kRun, notes); }),
                MatchesRegex("1000000 points with 4000000 rays need about [0-9.]+M of memory, and "
                             "--max-memory allows [0-9.]+M"));
}

TEST(RunMemory, KeepsTheNumberOfPointsThatIsGiven)
{
    MeshArguments arguments = with_memory(0);
    arguments.tile_points = 5000;
    RunMemory memory(arguments, 1);
    Notes notes;
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.tile_points(), 5000U);
}

TEST(RunMemory, AllowsTheGivenLimitOrMostOfTheFreeMemory)
{
    EXPECT_EQ(allowed_memory({.limit = 1000}), 1000);
    EXPECT_EQ(allowed_memory({.limit = 0}), std::nullopt) << "no limit";
    EXPECT_GT(allowed_memory({}), 1000);
}

TEST(FolderBeside, IsNotInTheFolderOfADevice)
{
    EXPECT_THAT(folder_beside("a/out.ply").string(), MatchesRegex("a/out.ply.tiles-[0-9]+"));
    EXPECT_NE(folder_beside("/dev/null").parent_path(), "/dev");
}

} // namespace
} // namespace vcarve::cli::run_memory_test
