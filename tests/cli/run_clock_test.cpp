#include "cli/run_clock.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace vcarve::cli::run_clock_test {
namespace {

PredictedTimes times(std::vector<StageTime> stages, double points = 0.0)
{
    return {.stages = std::move(stages), .points = points};
}

TEST(RunClock, SaysNothingWhileNothingIsExpected)
{
    RunClock clock;
    clock.stage_begins("read", 0.0);
    EXPECT_FALSE(clock.estimate(0.5, 1.0));
}

TEST(RunClock, GoesByWhatIsExpectedAtFirst)
{
    RunClock clock;
    clock.expect(times({{"a", 10}, {"b", 10}, {"c", 20}}));
    EXPECT_DOUBLE_EQ(clock.estimate(0, 0)->left_seconds, 40);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 0)->share, 0);
    clock.stage_begins("a", 0.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 4)->left_seconds, 36);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 4)->share, 0.1);
}

TEST(RunClock, TakesWhatIsToComeForAsSlowAsWhatIsOver)
{
    RunClock clock;
    clock.expect(times({{"a", 10}, {"b", 10}, {"c", 20}}));
    clock.stage_begins("a", 0.0);
    clock.stage_ends({}, 20.0);
    // A hundredth of the 40 s counts as taken in time.
    EXPECT_DOUBLE_EQ(clock.estimate(0, 20)->left_seconds, (20 + 0.4) / (10 + 0.4) * 30);
}

TEST(RunClock, LearnsNothingFromAStageThatIsShort)
{
    RunClock clock;
    clock.expect(times({{"read", 1}, {"cut", 99}}));
    clock.stage_begins("read", 0.0);
    clock.stage_ends({}, 20.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 20)->left_seconds, 99);
}

TEST(RunClock, MovesFromWhatIsExpectedOfAStageToItsOwnPace)
{
    RunClock clock;
    clock.expect(times({{"a", 10}}));
    clock.stage_begins("a", 0.0);
    // A tenth takes 4 s, so all would take 40.
    const double expected = (0.1 * 4 + 0.1) / (0.1 * 1 + 0.1) * 10;
    EXPECT_DOUBLE_EQ(clock.estimate(0.1, 4)->left_seconds, 0.9 * (0.9 * expected + 4));
    EXPECT_NEAR(clock.estimate(0.9, 36)->left_seconds, 4, 0.1);
    EXPECT_DOUBLE_EQ(clock.estimate(1.0, 40)->left_seconds, 0);
}

TEST(RunClock, ExpectsMoreOfALateStageThatDoesNotTellHowFarItIs)
{
    RunClock clock;
    clock.expect(times({{"a", 10}}));
    clock.stage_begins("a", 0.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 30)->left_seconds, 3);
}

TEST(RunClock, ForgetsStagesThatDoNotCome)
{
    RunClock clock;
    clock.expect(times({{"a", 10}, {"b", 100}, {"c", 10}}));
    clock.stage_begins("a", 0.0);
    clock.stage_ends({}, 10.0);
    clock.stage_begins("c", 10.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 10)->left_seconds, 10);
}

TEST(RunClock, CountsAStageThatWasNotExpectedWhileItRuns)
{
    RunClock clock;
    clock.expect(times({{"a", 10}, {"b", 10}}));
    clock.stage_begins("a", 0.0);
    clock.stage_ends({}, 10.0);
    clock.stage_begins("other", 10.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0.5, 14)->left_seconds, 4 + 10);
    clock.stage_ends({}, 18.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 18)->left_seconds, 10);
}

TEST(RunClock, FindsAStageThatComesTwiceInItsTurn)
{
    RunClock clock;
    clock.expect(times({{"sights", 10}, {"cut", 5}, {"sights", 1}, {"cut", 5}}));
    clock.stage_begins("sights", 0.0);
    clock.stage_ends({}, 10.0);
    clock.stage_begins("cut", 10.0);
    clock.stage_ends({}, 15.0);
    clock.stage_begins("sights", 15.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 15)->left_seconds, 6);
}

TEST(RunClock, FollowsTheNumberOfPointsThatAreLeft)
{
    RunClock clock;
    clock.expect(times({{"filter", 1}, {"cut", 50}}, 1000));
    clock.stage_begins("filter", 0.0);
    clock.stage_ends({{"points", 200}, {"of", 1000}}, 1.0);
    EXPECT_DOUBLE_EQ(clock.estimate(0, 1)->left_seconds, 10);
}

TEST(RunClock, LearnsWhatIsExpectedWhileAStageRuns)
{
    RunClock clock;
    clock.stage_begins("read", 0.0);
    clock.expect(times({{"read", 4}, {"cut", 10}}));
    EXPECT_DOUBLE_EQ(clock.estimate(0, 1)->left_seconds, 13);
}

/// A run whose stages take `factors` times what is expected, which tells its shares or not. Gives
/// all estimates, ten a stage, and the seconds that were really left.
struct Told {
    RunEstimate estimate;
    double truly_left;
};
std::vector<Told> run_of(const std::vector<StageTime>& stages, const std::vector<double>& factors,
                         bool tells_shares)
{
    double all = 0.0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        all += stages[i].seconds * factors[i];
    }
    RunClock clock;
    clock.expect(times(stages));
    std::vector<Told> told;
    double now = 0.0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        clock.stage_begins(stages[i].stage, now);
        const double takes = stages[i].seconds * factors[i];
        for (int step = 0; step <= 10; ++step) {
            const double at = now + 0.1 * step * takes;
            told.push_back({*clock.estimate(tells_shares ? 0.1 * step : 0.0, at), all - at});
        }
        now += takes;
        clock.stage_ends({}, now);
    }
    told.push_back({*clock.estimate(0.0, now), 0.0});
    return told;
}

const std::vector<StageTime> kStages = {{"read", 1},    {"filter", 3}, {"triangulate", 30},
                                        {"sights", 30}, {"cut", 15},   {"clean", 6}};

TEST(RunClock, NeverFallsAndEndsFullWhateverTheStagesTake)
{
    std::mt19937_64 random(1);
    for (int run = 0; run < 200; ++run) {
        std::vector<double> factors;
        for (std::size_t i = 0; i < kStages.size(); ++i) {
            factors.push_back(std::exp(even(random, -2.0, 2.0)));
        }
        double share = 0.0;
        for (const Told& told : run_of(kStages, factors, run % 2 == 0)) {
            ASSERT_GE(told.estimate.share, share);
            ASSERT_LE(told.estimate.share, 1.0);
            ASSERT_GE(told.estimate.left_seconds, 0.0);
            share = told.estimate.share;
        }
        EXPECT_DOUBLE_EQ(share, 1.0);
    }
}

TEST(RunClock, IsRightWithinAnEighthOfTheRunOnAMachineOfAnotherSpeedWhenAFifthIsOver)
{
    for (const double factor : {0.3, 1.0, 2.0, 5.0}) {
        const double all = 85.0 * factor;
        for (const Told& told :
             run_of(kStages, std::vector<double>(kStages.size(), factor), true)) {
            if (told.truly_left > 0.8 * all) continue;
            EXPECT_NEAR(told.estimate.left_seconds, told.truly_left, 0.125 * all)
                << factor << " times as slow, " << told.truly_left << " s left";
        }
    }
}

} // namespace
} // namespace vcarve::cli::run_clock_test
