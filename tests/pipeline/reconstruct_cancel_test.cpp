// Progress of a run, and its cancellation.
#include "support/recording_log.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

namespace vcarve::reconstruct_cancel_test {

namespace {

using ::testing::Contains;
using ::testing::Not;

/// Options that enable every stage, with two rounds of labeling.
Options all_stages()
{
    Options options;
    options.labels.virtual_views.count = 20;
    options.refine.smooth.iterations = 2;
    options.refine.simplify.faces = 2000;
    return options;
}

/// The stages that take longer than a second at a million points.
const std::vector<std::string> kLongStages = {"triangulate", "rays",  "cut",    "surface",
                                              "viewpoints",  "guard", "smooth", "simplify"};

} // namespace

TEST(Reconstruct, ReportsTheProgressOfEveryLongStage)
{
    RecordingLog log;
    Options options = all_stages();
    options.labels.virtual_views.count = 0; // runs no stage twice
    reconstruct(bumpy_sphere(3000, 1), options, log);
    for (const std::string& stage : kLongStages) {
        if (stage == "viewpoints") continue;
        const std::vector<double> shares = log.shares()[stage];
        ASSERT_GE(shares.size(), 3U) << stage;
        EXPECT_TRUE(std::ranges::is_sorted(shares, std::less_equal())) << stage;
        EXPECT_EQ(shares.back(), 1.0) << stage;
        EXPECT_THAT(log.ended(), Contains(stage));
    }
}

TEST(Reconstruct, ReportsSharesRoughlyInProportionToWork)
{
    RecordingLog log;
    reconstruct(bumpy_sphere(3000, 1), all_stages(), log);
    for (const char* stage : {"triangulate", "rays", "viewpoints", "smooth", "simplify"}) {
        const std::vector<double> shares = log.shares()[stage];
        const auto is_early = [](double share) { return share < 0.5; };
        EXPECT_GE(std::ranges::count_if(shares, is_early), 2) << stage;
    }
}

class StoppedIn : public ::testing::TestWithParam<std::string> {};

TEST_P(StoppedIn, ThrowsCancelledWithoutFinishingTheStage)
{
    RecordingLog log;
    log.on_share = [&](const std::string& stage) {
        if (stage == GetParam()) log.stop();
    };
    const Scene scene = bumpy_sphere(3000, 1);
    EXPECT_EQ(refusal<Cancelled>([&] { reconstruct(scene, all_stages(), log); }),
              "stopped in stage " + GetParam() + ", as requested");
    EXPECT_THAT(log.ended(), Not(Contains(GetParam())));
    EXPECT_LT(log.shares()[GetParam()].back(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(EveryLongStage, StoppedIn, ::testing::ValuesIn(kLongStages),
                         [](const auto& stage) { return stage.param; });

TEST(Reconstruct, DoesNotStartIfTheLogRequestsAStop)
{
    RecordingLog log;
    log.stop();
    EXPECT_THROW(reconstruct(bumpy_sphere(100, 1), {}, log), Cancelled);
    EXPECT_TRUE(log.ended().empty());
}

TEST(Reconstruct, CanBeStoppedFromAnotherThreadDuringParallelTriangulation)
{
    // CGAL inserts this number of points on several threads.
    const Scene scene = bumpy_sphere(60'000, 1);
    Options options;
    options.threads = 4;
    RecordingLog log;
    std::thread stopper;
    log.on_stage = [&](const std::string& stage) {
        if (stage == "triangulate") stopper = std::thread([&] { log.stop(); });
    };
    EXPECT_EQ(refusal<Cancelled>([&] { reconstruct(scene, options, log); }),
              "stopped in stage triangulate, as requested");
    stopper.join();
}

TEST(Reconstruct, RejectsOptionsOutOfRangeBeforeAnyWork)
{
    const Scene scene = bumpy_sphere(100, 1);
    RecordingLog log;
    const auto refused = [&](const auto& change) {
        Options options;
        change(options);
        return refusal<UsageError>([&] { reconstruct(scene, options, log); });
    };
    EXPECT_EQ(refused([](Options& options) { options.points.min_views = 0; }),
              "--min-views takes a whole number, 1 or more (views), not 0");
    EXPECT_EQ(refused([](Options& options) {
                  options.labels.cut.quality = std::numeric_limits<double>::quiet_NaN();
              }),
              "--quality takes a number from 0 to 100000 (rays), not nan");
    EXPECT_EQ(refused([](Options& options) { options.threads = 1025; }),
              "--threads takes a whole number from 0 to 1024 (threads), not 1025");
    EXPECT_EQ(refused([](Options& options) { options.surface.cleanup.max_hole = 1001; }),
              "--max-hole takes a whole number from 0 to 1000 (edges), not 1001");
    EXPECT_TRUE(log.shares().empty());
}

TEST(Reconstruct, RejectsASceneWithInconsistentSizes)
{
    Scene scene = bumpy_sphere(100, 1);
    scene.colors.pop_back();
    Log silent;
    EXPECT_EQ(refusal<UsageError>([&] { reconstruct(scene, {}, silent); }),
              "the scene's colors have 99 entries, expected 100 (one per point)");
}

} // namespace vcarve::reconstruct_cancel_test
