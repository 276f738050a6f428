#include "pipeline/memory.h"
#include "support/ball_model.h"
#include "support/dense_workspace.h"
#include "support/places.h"
#include "support/program.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

namespace vcarve::memory_test {
namespace {

using ::testing::HasSubstr;

constexpr SceneSize kMillion = {.points = 1'000'000, .rays = 3'700'000, .views = 300};

/// The size of a run on a sparse model, whose points are not merged.
RunSize size_of_run(const SceneSize& size)
{
    return {.read = size, .thinned = size};
}

TEST(PredictedMemory, NamesStagesInTheOrderOfTheLog)
{
    struct Names : Log {
        std::vector<std::string> heard = {"read"}; // before reconstruct()
        void stage_begins(std::string_view name) override { heard.emplace_back(name); }
    } log;
    const Scene scene = bumpy_sphere(300, 1);
    std::vector<Options> runs(3);
    runs[1].labels.method = Method::strict;
    runs[2].denoise.denoise = 0.0;
    for (const Options& options : runs) {
        log.heard = {"read"};
        reconstruct(scene, options, log);
        RunSize size = size_of_run(size_of(scene));
        size.options = options;
        auto at = log.heard.begin();
        for (const StageMemory& stage : predicted_memory(size, 1)) {
            at = std::find(at, log.heard.end(), stage.stage);
            ASSERT_NE(at, log.heard.end()) << stage.stage;
        }
    }
}

TEST(PredictedMemory, GrowsWithPointsAndRaysAndThreads)
{
    const std::int64_t peak = predicted_peak(size_of_run(kMillion), 1);
    SceneSize more = kMillion;
    more.points += 1000;
    EXPECT_GT(predicted_peak(size_of_run(more), 1), peak);
    more = kMillion;
    more.rays += 1000;
    EXPECT_GT(predicted_peak(size_of_run(more), 1), peak);
    EXPECT_GT(predicted_peak(size_of_run(kMillion), 4), predicted_peak(size_of_run(kMillion), 2));
    more = kMillion;
    more.has_normals = true;
    EXPECT_GE(predicted_peak(size_of_run(more), 1), peak + 12'000'000);
    // Except for the program itself, a model of ten times the size needs ten times the memory.
    const SceneSize ten = {.points = 10'000'000, .rays = 37'000'000, .views = 3'000};
    const std::int64_t program = predicted_peak({}, 1);
    EXPECT_NEAR(static_cast<double>(predicted_peak(size_of_run(ten), 1) - program),
                10.0 * static_cast<double>(peak - program), 1e3);
}

TEST(PredictedMemory, CountsRaysOnceWhileReading)
{
    SceneSize more = kMillion;
    more.rays += 1000;
    const StageMemory before = predicted_memory(size_of_run(kMillion), 1).front();
    const StageMemory after = predicted_memory(size_of_run(more), 1).front();
    EXPECT_STREQ(before.stage, "read");
    EXPECT_EQ(after.bytes - before.bytes, 1000 * 4);
}

TEST(PredictedMemory, StaysInRangeForHugeSizes)
{
    const SceneSize most = {.points = ~0ULL, .rays = ~0ULL, .views = ~0ULL};
    EXPECT_GT(predicted_peak(size_of_run(most), 2), std::int64_t{1} << 60);
}

#ifndef VCARVE_SANITIZED // sanitizers need additional memory
/// The measured and the predicted memory of each stage of a run of the program.
struct MeasuredRun {
    std::map<std::string, double> measured; ///< bytes
    std::vector<StageMemory> predicted;
    double peak = 0.0;

    double ratio(const StageMemory& stage) const
    {
        return static_cast<double>(stage.bytes) / measured.at(stage.stage);
    }
};

MeasuredRun run_on(const std::filesystem::path& model, int threads)
{
    const TemporaryFolder folder;
    const std::string stats = folder / "stats.json";
    MeasuredRun run;
    const int exit_code = run_program({"--quiet", "--threads", std::to_string(threads), "--stats",
                                       stats, model, folder / "out.ply"})
                              .exit_code;
    EXPECT_EQ(exit_code, 0);
    const auto record = nlohmann::json::parse(std::ifstream(stats));
    EXPECT_TRUE(record["peak_memory_is_per_stage"]);
    for (const auto& stage : record["stages"]) {
        run.measured[stage["name"]] = stage["peak_memory_bytes"];
    }
    const SceneSize read = {.points = record["input"]["points"],
                            .rays = record["input"]["rays"],
                            .views = record["input"]["views"],
                            .has_normals = !record["input"]["cloud"].is_null(),
                            .is_dense = !record["input"]["cloud"].is_null()};
    RunSize size = size_before_thinning(read, {});
    if (read.is_dense) {
        size.thinned = read;
        size.thinned.points = record["stages"][0]["counts"]["points"];
        size.thinned.rays = read.rays * size.thinned.points / read.points;
    }
    run.predicted = predicted_memory(size, threads);
    run.peak = record["total"]["peak_memory_bytes"];
    return run;
}

MeasuredRun run_on_ball(int points, int threads)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", points);
    return run_on(folder / "ball", threads);
}

/// The memory of a larger ball minus that of a smaller one: predicted over measured, per stage. The
/// resident pages of the program and its libraries depend on the machine, and cancel out.
std::map<std::string, double> growth_ratios(int fewer, int more, int threads)
{
    const MeasuredRun small = run_on_ball(fewer, threads);
    const MeasuredRun large = run_on_ball(more, threads);
    std::map<std::string, double> ratios;
    for (std::size_t i = 0; i < large.predicted.size(); ++i) {
        const auto& [stage, bytes, is_stereo] = large.predicted[i];
        ratios[stage] = static_cast<double>(bytes - small.predicted[i].bytes) /
                        (large.measured.at(stage) - small.measured.at(stage));
    }
    return ratios;
}

TEST(PredictedMemory, GrowsLikeTheMemoryOfTheProgram)
{
    const std::map<std::string, double> expected = {
        {"read", 0.85}, {"filter", 1.02},  {"fill", 0.80},  {"triangulate", 1.42}, {"rays", 1.06},
        {"cut", 1.40},  {"surface", 1.12}, {"clean", 1.08}, {"adjust", 1.10}}; // as measured
    for (const auto& [stage, ratio] : growth_ratios(20'000, 80'000, 1)) {
        EXPECT_NEAR(ratio, expected.at(stage), 0.2) << stage;
    }
    for (const auto& [stage, ratio] : growth_ratios(20'000, 80'000, 2)) {
        EXPECT_GE(ratio, 0.65) << stage << ": memory that CGAL freed must be returned before";
    }
}

/// Writes a dense workspace that repeats the points of a fixture `times` times.
void repeat_cloud(const std::filesystem::path& folder, std::size_t times)
{
    const std::filesystem::path from = fixtures_folder() / "dense_room";
    std::filesystem::create_directory(folder);
    std::filesystem::copy(from / "sparse", folder / "sparse");
    const std::string cloud = bytes_of(from / "fused.ply");
    const std::string rows = bytes_of(from / "fused.ply.vis");
    std::uint64_t count = 0;
    std::memcpy(&count, rows.data(), sizeof(count));
    const std::string old_count = fmt::format("element vertex {}", count);
    const std::size_t at = cloud.find(old_count);
    ASSERT_NE(at, std::string::npos);
    const std::string_view end = "end_header\n";
    const std::size_t body = cloud.find(end) + end.size();
    count *= times;
    std::ofstream ply(folder / "fused.ply", std::ios::binary);
    ply << cloud.substr(0, at) << "element vertex " << count
        << cloud.substr(at + old_count.size(), body - at - old_count.size());
    std::ofstream vis(folder / "fused.ply.vis", std::ios::binary);
    vis << raw(count);
    for (std::size_t i = 0; i < times; ++i) {
        ply << std::string_view(cloud).substr(body);
        vis << std::string_view(rows).substr(sizeof(count));
    }
}

TEST(Program, DoesNotResetThePeakOfTheProcessWithoutStats)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 30'000);
    const Outcome plain =
        run_program({"--quiet", "--threads", "1", folder / "ball", folder / "out.ply"});
    EXPECT_GE(plain.peak_memory_bytes, 0.9 * run_on(folder / "ball", 1).peak);
}

TEST(PredictedMemory, HoldsOnlyMergedPointsAndAPartOfACloud)
{
    const TemporaryFolder folder;
    std::map<std::size_t, double> peaks;
    for (const std::size_t times : {150, 400}) { // 1.2 and 3.2 million points; a part has 1.05
        const std::filesystem::path workspace = folder / std::to_string(times);
        repeat_cloud(workspace, times);
        const MeasuredRun run = run_on(workspace, 2);
        EXPECT_STREQ(run.predicted.front().stage, "read");
        EXPECT_GE(run.ratio(run.predicted.front()), kLeastPredicted);
        EXPECT_LE(run.ratio(run.predicted.front()), kMostPredicted);
        peaks[times] = run.measured.at("read");
        std::filesystem::remove_all(workspace);
    }
    // Peaks vary by 10 % between runs; keeping all points would need 2.7 times the memory.
    EXPECT_LE(peaks[400], 1.3 * peaks[150]) << "merged points must be freed";
}
#endif

TEST(RequireMemory, AcceptsThePredictedPeakAndRejectsAByteLess)
{
    const std::int64_t peak = predicted_peak(size_of_run(kMillion), 1);
    EXPECT_NO_THROW(require_memory(size_of_run(kMillion), 1, peak));
    EXPECT_NO_THROW(require_memory(size_of_run(kMillion), 1, 0));
    EXPECT_THROW(require_memory(size_of_run(kMillion), 1, peak - 1), InputError);
    EXPECT_THAT(refusal<InputError>([] { require_memory(size_of_run(kMillion), 1, 4 << 20); }),
                ::testing::MatchesRegex("1000000 points with 3700000 rays need about [0-9.]+M of "
                                        "memory, and --max-memory allows 4M"));
}

TEST(MostCells, AreTheNumberThatFitsIntoMemory)
{
    RunSize run = size_of_run(kMillion);
    run.options.memory.limit = 0;
    EXPECT_EQ(most_cells(run, 1), kAnyCells);
    run.options.memory.limit = 2 * predicted_peak(run, 1);
    EXPECT_GT(most_cells(run, 1), 2 * 6'800'000U);
    EXPECT_LT(most_cells(run, 1), 3 * 6'800'000U);
    run.options.memory.limit = predicted_peak(run, 1) / 2;
    EXPECT_GE(most_cells(run, 1), 8'000'000U) << "at least the usual number";
}

TEST(Reconstruct, RejectsAModelThatNeedsTooMuchMemoryBeforeAnyWork)
{
    struct Stages : Log {
        int ended = 0;
        void stage_ends(std::string_view, const Counts&) override { ++ended; }
    } log;
    Options options;
    options.memory.limit = 1000;
    EXPECT_THAT(refusal<InputError>([&] { reconstruct(bumpy_sphere(300, 1), options, log); }),
                HasSubstr("--max-memory allows 1000"));
    EXPECT_EQ(log.ended, 0);
}

} // namespace
} // namespace vcarve::memory_test
