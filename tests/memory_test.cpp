#include "pipeline/memory.h"
#include "support/ball_model.h"
#include "support/scenes.h"
#include "support/subprocess.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>

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
    for (const StageMemory& stage : predicted_memory(size_of(scene), size_of(scene), 1)) {
        at = std::find(at, log.heard.end(), stage.stage);
        ASSERT_NE(at, log.heard.end()) << stage.stage;
    }
}

TEST(PredictedMemory, GrowsWithPointsAndSightsAndThreads)
{
    const std::int64_t peak = predicted_peak(kMillion, kMillion, 1);
    SceneSize more = kMillion;
    more.points += 1000;
    EXPECT_GT(predicted_peak(more, more, 1), peak);
    more = kMillion;
    more.sights += 1000;
    EXPECT_GT(predicted_peak(more, more, 1), peak);
    EXPECT_GE(predicted_peak(kMillion, kMillion, 2), peak);
    more = kMillion;
    more.has_normals = true;
    EXPECT_GE(predicted_peak(more, more, 1), peak + 12'000'000);
    // Ten times the model takes ten times what a run takes beside the program itself.
    const SceneSize ten = {.points = 10'000'000, .sights = 37'000'000, .views = 3'000};
    const std::int64_t program = predicted_peak({}, {}, 1);
    EXPECT_NEAR(static_cast<double>(predicted_peak(ten, ten, 1) - program),
                10.0 * static_cast<double>(peak - program), 1e3);
}

TEST(PredictedMemory, OfReadingHoldsASightInTheFileInTheSceneAndInTheTrackThatGrows)
{
    SceneSize more = kMillion;
    more.sights += 1000;
    const StageMemory before = predicted_memory(kMillion, kMillion, 1).front();
    const StageMemory after = predicted_memory(more, more, 1).front();
    EXPECT_STREQ(before.stage, "read");
    EXPECT_EQ(after.bytes - before.bytes, 1000 * (8 + 4 + 4));
}

TEST(PredictedMemory, StaysInRangeForSizesNobodyHas)
{
    const SceneSize most = {.points = ~0ULL, .sights = ~0ULL, .views = ~0ULL};
    EXPECT_GT(predicted_peak(most, most, 2), std::int64_t{1} << 60);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they need memory of their own
/// What a run of the program on a ball took, stage by stage, and what was foretold.
struct MeasuredRun {
    std::map<std::string, double> measured; ///< bytes
    std::vector<StageMemory> predicted;
    double peak = 0.0;

    double ratio(const StageMemory& stage) const
    {
        return static_cast<double>(stage.bytes) / measured.at(stage.stage);
    }
};

MeasuredRun run_on_ball(int points, int threads)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", points);
    const std::string stats = folder / "stats.json";
    MeasuredRun run;
    const int exit_code =
        Subprocess({VCARVE_PROGRAM, "--quiet", "--threads", std::to_string(threads), "--stats",
                    stats, folder / "ball", folder / "out.ply"})
            .wait()
            .exit_code;
    EXPECT_EQ(exit_code, 0);
    const auto record = nlohmann::json::parse(std::ifstream(stats));
    EXPECT_TRUE(record["peak_memory_is_per_stage"]);
    for (const auto& stage : record["stages"]) {
        run.measured[stage["name"]] = stage["peak_memory_bytes"];
    }
    const SceneSize size = {.points = record["input"]["points"],
                            .sights = record["input"]["sights"],
                            .views = record["input"]["views"]};
    run.predicted = predicted_memory(size, size, threads);
    run.peak = record["total"]["peak_memory_bytes"];
    return run;
}

TEST(PredictedMemory, IsWhatTheProgramNeeds)
{
    const MeasuredRun run = run_on_ball(30'000, 1);
    const std::map<std::string, double> expected = {
        {"read", 1.00}, {"filter", 1.02},  {"triangulate", 1.34}, {"sights", 1.28},
        {"cut", 1.32},  {"surface", 1.06}, {"clean", 1.20}}; // as measured
    double most = 0.0;
    for (const StageMemory& stage : run.predicted) {
        EXPECT_NEAR(run.ratio(stage), expected.at(stage.stage), 0.1) << stage.stage;
        most = std::max(most, static_cast<double>(stage.bytes));
    }
    EXPECT_GE(most / run.peak, kLeastPredicted);
    EXPECT_LE(most / run.peak, kMostPredicted);
}

TEST(PredictedMemory, IsWhatTheProgramNeedsAfterAParallelTriangulation)
{
    const MeasuredRun run = run_on_ball(100'000, 2);
    for (const StageMemory& stage : run.predicted) {
        EXPECT_GE(run.ratio(stage), 0.9)
            << stage.stage << ": what CGAL freed is to be given back before";
    }
}
#endif

TEST(RequireMemory, AllowsWhatIsNeededAndRefusesAByteLess)
{
    const std::int64_t peak = predicted_peak(kMillion, kMillion, 1);
    EXPECT_NO_THROW(require_memory(kMillion, kMillion, 1, peak));
    EXPECT_NO_THROW(require_memory(kMillion, kMillion, 1, 0));
    EXPECT_THROW(require_memory(kMillion, kMillion, 1, peak - 1), InputError);
    EXPECT_THAT(refusal<InputError>([] { require_memory(kMillion, kMillion, 1, 4 << 20); }),
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
