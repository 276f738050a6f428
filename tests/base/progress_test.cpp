#include "base/parallel.h"
#include "base/progress.h"
#include "support/recording_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace vcarve::progress_test {

namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

} // namespace

TEST(Stage, ReportsIncreasingSharesAndEndsWithOne)
{
    RecordingLog log;
    Stage stage(log, "work");
    for (const double share : {0.0, 0.25, 0.2, 0.2501, 0.5, 0.5, 0.75}) {
        stage.progress(share);
    }
    stage.end({});
    EXPECT_THAT(log.shares(), ElementsAre(Pair("work", ElementsAre(0.25, 0.5, 0.75, 1.0))));
}

TEST(Stage, ReportsNoShareWithoutProgress)
{
    RecordingLog log;
    Stage(log, "work").end({});
    EXPECT_THAT(log.shares(), ElementsAre(Pair("work", IsEmpty())));
}

TEST(Stage, LimitsSharesToOne)
{
    RecordingLog log;
    Stage stage(log, "work");
    stage.progress(1.25);
    stage.end({});
    EXPECT_THAT(log.shares(), ElementsAre(Pair("work", ElementsAre(1.0))));
}

TEST(Progress, ScalesNestedPartsToSharesOfTheStage)
{
    RecordingLog log;
    Stage stage(log, "work");
    const Progress half = Progress(stage).part(0.5, 1.0);
    half.report(0.5);
    half.part(0.5, 0.75).report(1.0, 2.0);
    half.part(0.75, 1.0).report(0.0, 0.0); // 0 of 0 is complete
    EXPECT_THAT(log.shares(),
                ElementsAre(Pair("work", ElementsAre(DoubleEq(0.75), DoubleEq(0.8125), 1.0))));
}

TEST(Progress, ReportsNothingWithoutStage)
{
    const Progress none;
    EXPECT_NO_THROW(none.report(0.5));
    EXPECT_NO_THROW(none.part(0.0, 0.5).report(1.0, 2.0));
}

TEST(Progress, IncreasesToOneWithSeveralThreads)
{
    RecordingLog log;
    Stage stage(log, "work");
    tbb::task_arena(4).execute([&] {
        parallel_for(
            10'000, stage, [](std::size_t) {}, 16);
    });
    stage.end({});
    const std::vector<double> shares = log.shares().at("work");
    EXPECT_GT(shares.size(), 10U);
    EXPECT_LT(shares.front(), 0.5);
    EXPECT_EQ(shares.back(), 1.0);
    EXPECT_TRUE(std::ranges::is_sorted(shares, std::less_equal()));
}

TEST(Progress, StopsALoopIfTheLogRequestsIt)
{
    RecordingLog log;
    Stage stage(log, "work");
    std::atomic<int> done = 0;
    const auto loop = [&] {
        parallel_for(
            10'000, stage,
            [&](std::size_t) {
                if (++done == 100) log.stop();
            },
            1);
    };
    EXPECT_THROW(tbb::task_arena(4).execute(loop), Cancelled);
    EXPECT_GE(done, 100);
    EXPECT_LT(done, 1000);
}

TEST(Progress, StopsAStageBeforeItBeginsAndBeforeItEnds)
{
    RecordingLog log;
    Stage stage(log, "work");
    log.stop();
    EXPECT_THROW(stage.end({}), Cancelled);
    try {
        const Stage next(log, "more work");
        FAIL() << "the next stage began";
    } catch (const Cancelled& cancelled) {
        EXPECT_STREQ(cancelled.what(), "stopped in stage more work, as requested");
    }
    EXPECT_THAT(log.ended(), IsEmpty());
}

} // namespace vcarve::progress_test
