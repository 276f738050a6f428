#include "support/temporary_folder.h"
#include "tiles/run_memory.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vcarve::run_memory_test {
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

RunMemory with_memory(std::int64_t bytes, std::size_t tile_points = 0, bool one_piece = false)
{
    return {{.limit = bytes}, tile_points, one_piece, 1};
}

TEST(RunMemory, MeshesInOnePieceIfThatFits)
{
    RunMemory memory = with_memory(predicted_peak(kRun, 1));
    Notes notes;
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.tile_points(), 0U);
    EXPECT_THAT(notes.heard, IsEmpty());
}

TEST(RunMemory, ChoosesTilesOnceIfMemoryIsShort)
{
    RunMemory memory = with_memory(predicted_peak(kRun, 1) - 1);
    Notes notes;
    memory.fit(kRun, notes);
    const std::size_t points = memory.tile_points();
    EXPECT_GT(points, 100'000U);
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.tile_points(), points);
    EXPECT_THAT(notes.heard, ElementsAre(MatchesRegex("about [0-9.]+M needed, [0-9.]+M allowed: "
                                                      "tiles of [0-9,]+ points")));
}

TEST(RunMemory, RejectsOptionsThatNeedOnePieceIfMemoryIsShort)
{
    RunMemory memory = with_memory(predicted_peak(kRun, 1) - 1, 0, true);
    Notes notes;
    EXPECT_THAT(refusal<InputError>([&] { memory.fit(kRun, notes); }),
                MatchesRegex("1000000 points with 4000000 rays need about [0-9.]+M of memory, and "
                             "--max-memory allows [0-9.]+M"));
}

TEST(RunMemory, KeepsTheNumberOfPointsThatIsGiven)
{
    RunMemory memory = with_memory(0, 5000);
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

TEST(RunMemory, RefusesDepthMapsThatDoNotFitEvenWithTiles)
{
    RunSize size = kRun;
    size.measures_dense = true;
    size.photos.assign(300, {4000, 3000});
    EXPECT_GT(predicted_peak(size, 1), predicted_peak(kRun, 1));
    RunMemory memory = with_memory(predicted_peak(size, 1) - 1, 5000);
    Notes notes;
    EXPECT_THAT(refusal<InputError>([&] { memory.fit(size, notes); }),
                MatchesRegex("--dense needs about [0-9.]+[MG] of memory for 300 photographs, but "
                             "the limit is [0-9.]+[MG]; use a smaller --dense-size, fewer "
                             "--threads, or a larger --max-memory"));
}

} // namespace
} // namespace vcarve::run_memory_test
