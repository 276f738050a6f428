#include "base/error.h"
#include "pipeline.h"
#include "pipeline_memory.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve {
namespace {

using testing::HasSubstr;

constexpr SceneSize kMillion = {.points = 1'000'000, .sights = 3'700'000, .views = 300};

TEST(PredictedMemory, NamesStagesOfTheLogInTheirOrder)
{
    struct Names : Log {
        std::vector<std::string> heard = {"read"}; // before reconstruct
        void stage_begins(std::string_view name) override { heard.emplace_back(name); }
    } log;
    const Scene scene = bumpy_sphere(300, 1);
    reconstruct(scene, Options(), log);
    auto at = log.heard.begin();
    for (const StageMemory& stage : predicted_memory(size_of(scene), 1)) {
        at = std::find(at, log.heard.end(), stage.stage);
        ASSERT_NE(at, log.heard.end()) << stage.stage;
    }
}

TEST(PredictedMemory, GrowsWithPointsAndSightsAndThreads)
{
    const std::int64_t peak = predicted_peak(kMillion, 1);
    SceneSize more = kMillion;
    more.points += 1000;
    EXPECT_GT(predicted_peak(more, 1), peak);
    more = kMillion;
    more.sights += 1000;
    EXPECT_GT(predicted_peak(more, 1), peak);
    EXPECT_GE(predicted_peak(kMillion, 2), peak);
    // Ten times the model takes ten times what a run takes beside the program itself.
    const SceneSize ten = {.points = 10'000'000, .sights = 37'000'000, .views = 3'000};
    const std::int64_t program = predicted_peak({}, 1);
    EXPECT_NEAR(static_cast<double>(predicted_peak(ten, 1) - program),
                10.0 * static_cast<double>(peak - program), 1e3);
}

TEST(PredictedMemory, StaysInRangeForSizesNobodyHas)
{
    const SceneSize most = {.points = ~0ULL, .sights = ~0ULL, .views = ~0ULL};
    EXPECT_GT(predicted_peak(most, 2), std::int64_t{1} << 60);
}

TEST(RequireMemory, AllowsWhatIsNeededAndRefusesAByteLess)
{
    const std::int64_t peak = predicted_peak(kMillion, 1);
    EXPECT_NO_THROW(require_memory(kMillion, 1, peak));
    EXPECT_NO_THROW(require_memory(kMillion, 1, 0));
    EXPECT_THROW(require_memory(kMillion, 1, peak - 1), InputError);
    EXPECT_THAT(refusal<InputError>([] { require_memory(kMillion, 1, 4 << 20); }),
                testing::MatchesRegex("1000000 points with 3700000 sights need about [0-9.]+M of "
                                      "memory, and --max-memory allows 4M"));
}

TEST(Reconstruct, RefusesAModelThatNeedsTooMuchMemoryBeforeAnyWork)
{
    struct Stages : Log {
        int ended = 0;
        void stage_ends(std::string_view, const Counts&) override { ++ended; }
    } log;
    Options options;
    options.max_memory = 1000;
    EXPECT_THAT(refusal<InputError>([&] { reconstruct(bumpy_sphere(300, 1), options, log); }),
                HasSubstr("--max-memory allows 1000"));
    EXPECT_EQ(log.ended, 0);
}

} // namespace
} // namespace vcarve
