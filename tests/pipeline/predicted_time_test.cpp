#include "cli/expected_run.h"
#include "pipeline/predicted_time.h"
#include "support/scenes.h"
#include "vcarve/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vcarve::predicted_time_test {
namespace {

constexpr SceneSize kMillion = {.points = 1'000'000, .sights = 3'700'000, .views = 300};

double sum(const PredictedTimes& times)
{
    double seconds = 0.0;
    for (const StageTime& stage : times.stages) {
        seconds += stage.seconds;
    }
    return seconds;
}

double seconds_of(const PredictedTimes& times, const std::string& name)
{
    return std::ranges::find(times.stages, name, &StageTime::stage)->seconds;
}

/// Options one by one that change which stages run.
std::vector<std::pair<std::string, Options>> options_of_runs()
{
    std::vector<std::pair<std::string, Options>> runs(7);
    runs[0].first = "default";
    runs[1].first = "--closed";
    runs[1].second.surface.closed = true;
    runs[2].first = "--method strict";
    runs[2].second.labels.method = Method::strict;
    runs[3].first = "--virtual-views 3";
    runs[3].second.labels.virtual_views.count = 3;
    runs[4].first = "--smooth 1";
    runs[4].second.refine.smooth.iterations = 1;
    runs[5].first = "--simplify 100";
    runs[5].second.refine.simplify.faces = 100;
    runs[6].first = "--crop auto";
    runs[6].second.crop.region.kind = RegionChoice::Kind::looked_at;
    return runs;
}

TEST(PredictedTimes, NameTheStagesOfTheLogWhateverTheOptions)
{
    struct Names : Log {
        std::vector<std::string> heard;
        void stage_begins(std::string_view name) override { heard.emplace_back(name); }
    };
    for (const bool is_dense : {false, true}) {
        Scene scene = bumpy_sphere(300, 1);
        scene.is_dense = is_dense;
        for (const auto& [name, options] : options_of_runs()) {
            Names log;
            const SceneSize size = size_of(scene);
            reconstruct(scene, options, log);
            std::erase(log.heard, "memory"); // takes no time
            std::erase(log.heard, "thin");   // a part of reading, in the program
            std::vector<std::string> expected;
            for (const StageTime& stage : predicted_times(size, options, 1).stages) {
                expected.push_back(stage.stage);
                EXPECT_GE(stage.seconds, 0.0);
            }
            log.heard.insert(log.heard.begin(), "read");
            log.heard.emplace_back("write");
            EXPECT_EQ(expected, log.heard) << name;
        }
    }
}

TEST(PredictedTimes, GrowWithPointsAndSightsAndShrinkWithThreads)
{
    const double usual = sum(predicted_times(kMillion, {}, 1));
    SceneSize more = kMillion;
    more.points += 1000;
    EXPECT_GT(sum(predicted_times(more, {}, 1)), usual);
    more = kMillion;
    more.sights += 1000;
    EXPECT_GT(sum(predicted_times(more, {}, 1)), usual);
    EXPECT_LT(sum(predicted_times(kMillion, {}, 2)), 0.6 * usual);
}

TEST(PredictedTimes, TakeHalfOfACloudForMergedUnlessNothingIs)
{
    SceneSize cloud = kMillion;
    cloud.is_dense = true;
    EXPECT_EQ(predicted_times(cloud, {}, 1).points, 5e5);
    Options unmerged;
    unmerged.thin.merge_px = 0.0;
    EXPECT_EQ(predicted_times(cloud, unmerged, 1).points, 1e6);
}

TEST(PredictedTimes, TriangulateFewPointsOnOneThread)
{
    const SceneSize few = {.points = 40'000, .sights = 150'000, .views = 20};
    EXPECT_DOUBLE_EQ(seconds_of(predicted_times(few, {}, 1), "triangulate"),
                     seconds_of(predicted_times(few, {}, 4), "triangulate"));
}

TEST(ExpectedRun, EndsWithWhatIsWritten)
{
    using cli::expected_run;
    const auto last = [](const PredictedTimes& times) { return times.stages.back().stage; };
    EXPECT_EQ(last(expected_run(kMillion, {}, {}, 1)), "write");
    EXPECT_EQ(last(expected_run(kMillion, {}, {.preview = true}, 1)), "preview");
    EXPECT_EQ(last(expected_run(kMillion, {}, {.preview = true, .report = true}, 1)), "report");
}

} // namespace
} // namespace vcarve::predicted_time_test
