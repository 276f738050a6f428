#include "base/stage_counts.h"
#include "cli/mesh_report.h"

#include <gtest/gtest.h>

#include <string>

namespace vcarve::cli::renamed_counts_test {
namespace {

CountsOfStages counts_of_a_run()
{
    return {{"filter",
             {{counts::kFilter.points, 20, 100},
              {counts::kFilter.few_views, 50},
              {counts::kFilter.low_angle, 30}}},
            {"open", {{counts::kMesh.open, 400, 4000}, {counts::kMesh.past, 800}}},
            {"orient", {{counts::kMesh.outside, 70, 100}, {counts::kMesh.boundary_edges, 12}}},
            {"write", {{counts::kOutput.faces, 99}, {counts::kOutput.vertices, 50}}}};
}

CountsOfStages renamed(CountsOfStages stages)
{
    for (auto& [stage, counts] : stages) {
        for (Count& count : counts) {
            count.kind.text = "renamed {}";
        }
    }
    return stages;
}

/// The counts of the stages in --stats.
Json recorded_counts(const Json& record)
{
    Json all = Json::object();
    for (const Json& stage : record["stages"]) {
        all[stage["name"].get<std::string>()] = stage["counts"];
    }
    return all;
}

/// The record of a run with these counts.
Json record_of(const CountsOfStages& stages)
{
    Log nothing;
    StageRecorder recorder(nothing);
    for (const auto& [name, counts] : stages) {
        Stage(recorder, name).end(counts);
    }
    checked({}, stages, recorder);
    return recorder.json();
}

std::string closing_line_of(const CountsOfStages& stages)
{
    return closing_line(outcome_of(stages), Options());
}

TEST(RenamedCounts, HaveOtherLinesInTheLog)
{
    const CountsOfStages stages = renamed(counts_of_a_run());
    EXPECT_EQ(stage_words(stages.at("filter")), "renamed 20renamed 50renamed 30");
}

TEST(RenamedCounts, HaveTheSameKeysInTheRecord)
{
    const Json counts = recorded_counts(record_of(counts_of_a_run()));
    EXPECT_EQ(recorded_counts(record_of(renamed(counts_of_a_run()))), counts);
    EXPECT_EQ(counts["filter"].dump(),
              R"({"points":20,"of points":100,"few views":50,"low angle":30})");
    EXPECT_EQ(counts["check"].dump(), R"({"open edges":0,"self-intersections":0,)"
                                      R"("rays from behind":30,"of rays from behind":100})");
}

TEST(RenamedCounts, HaveTheSameClosingLine)
{
    const std::string line = closing_line_of(counts_of_a_run());
    EXPECT_EQ(closing_line_of(renamed(counts_of_a_run())), line);
    EXPECT_EQ(line, "wrote : 99 faces, holes in 10 % of the visible surface (to close: "
                    "--max-closing 0); 20 % of the pixels show sky or surfaces without points\n"
                    "if parts are missing, try --min-views 1 or --rays nearest: 50 % of the "
                    "points were dropped\n"
                    "if parts are missing, try a smaller --min-angle: 30 % of the points were "
                    "dropped");
}

TEST(RenamedCounts, HaveTheSameWarnings)
{
    const auto warnings = warnings_of({}, record_of(counts_of_a_run()));
    EXPECT_EQ(warnings_of({}, record_of(renamed(counts_of_a_run()))), warnings);
    ASSERT_EQ(warnings.size(), 4U);
    EXPECT_EQ(warnings[0],
              "50 % of the points were dropped by --min-views: too few views see them.");
    EXPECT_EQ(warnings[3], "30 % of the rays hit the surface from behind.");
}

} // namespace
} // namespace vcarve::cli::renamed_counts_test
