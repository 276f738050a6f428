#include "cli/closing_line.h"

#include <gtest/gtest.h>

namespace vcarve::cli::closing_line_test {
namespace {

/// A surface of which nothing is to be said.
RunOutcome usual()
{
    return {.out = "out.ply",
            .faces = 22268,
            .boundary_edges = 990,
            .open = 0.001,
            .long_area = 0.1,
            .points = 20000,
            .points_before = 22000};
}

RunOutcome closed()
{
    RunOutcome outcome = usual();
    outcome.boundary_edges = 0;
    return outcome;
}

std::string line(const RunOutcome& outcome, const Options& options = {})
{
    return closing_line(outcome, options);
}

TEST(ClosingLine, ShowsTheReportWhereNothingStandsOut)
{
    EXPECT_EQ(line(usual()),
              "wrote out.ply: 22,268 faces, less than 1 % of what cameras see is open"
              "\nSee it: --report out.html");
    RunOutcome outcome = usual();
    outcome.open = 0.0;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, no visible holes. See it: --report "
                             "out.html");
    outcome.has_report = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, no visible holes");
}

TEST(ClosingLine, SaysWhatClosesWhatIsOpen)
{
    RunOutcome outcome = usual();
    outcome.has_report = true;
    outcome.open = 0.035;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, 4 % of what cameras see is open (to "
                             "close: --max-closing 0)");
    Options options;
    options.surface.rules.max_closing = 0.0;
    EXPECT_EQ(line(outcome, options), "wrote out.ply: 22,268 faces, 4 % of what cameras see is "
                                      "open (to close: --closed)");
}

TEST(ClosingLine, ProposesNothingForAClosedSurface)
{
    RunOutcome outcome = closed();
    outcome.has_report = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed");
}

TEST(ClosingLine, CountsEdgesWhereItIsNotKnownWhatTheViewsLookAt)
{
    RunOutcome outcome = usual();
    outcome.open.reset();
    outcome.has_report = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, 990 open edges");
}

TEST(ClosingLine, ProposesToCropLargeFacesUnlessThatIsDone)
{
    RunOutcome outcome = closed();
    outcome.long_area = 0.7;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\n"
                             "if its large faces are in the way, try --crop auto");
    Options options;
    options.surface.closed = true;
    EXPECT_EQ(line(outcome, options), "wrote out.ply: 22,268 faces, closed\n"
                                      "if its large faces are in the way, leave out --closed");
    options = {};
    options.crop.region.kind = RegionChoice::Kind::looked_at;
    EXPECT_EQ(line(outcome, options),
              "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
}

TEST(ClosingLine, NamesTheLimitThatManyPointsFellTo)
{
    const std::string begin = "wrote out.ply: 22,268 faces, closed\nif parts are missing, try a ";
    RunOutcome outcome = closed();
    outcome.low_angle = 11000;
    EXPECT_EQ(line(outcome), begin + "smaller --min-angle: 50 % of the points fell to it");
    outcome.high_error = 4400;
    outcome.low_angle = 0;
    EXPECT_EQ(line(outcome), begin + "larger --max-error: 20 % of the points fell to it");
    outcome.high_error = 0;
    outcome.stray = 6600;
    EXPECT_EQ(line(outcome), begin + "larger --stray-spacing: 30 % of the points fell to it");
}

TEST(ClosingLine, SaysAtTheDefaultsHowToKeepPointsOfOneView)
{
    RunOutcome outcome = closed();
    outcome.few_views = 11000;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\nif parts are missing, try "
                             "--min-views 1 or --sights nearest: 50 % of the points fell to it");
    outcome.few_views = 4000; // 18 %
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
    Options options;
    options.points.min_views = 3;
    outcome.few_views = 11000;
    EXPECT_EQ(line(outcome, options),
              "wrote out.ply: 22,268 faces, closed\nif parts are missing, try a smaller "
              "--min-views: 50 % of the points fell to it");
}

TEST(ClosingLine, NamesFirstWhereMostPointsWereLost)
{
    const std::string begin = "\nif parts are missing, try ";
    const std::string angle = "a smaller --min-angle: 23 % of the points fell to it";
    const std::string stray = "a larger --stray-spacing: 25 % of the points fell to it";
    RunOutcome outcome = closed();
    outcome.high_error = 4500;
    outcome.low_angle = 5000;
    outcome.stray = 5500;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed" + begin + stray + begin + angle);
}

TEST(ClosingLine, ProposesAtMostTwoThings)
{
    RunOutcome outcome = closed();
    outcome.high_error = outcome.low_angle = 8000;
    outcome.long_area = 1.0;
    EXPECT_EQ(line(outcome).find("--crop"), std::string::npos);
    EXPECT_NE(line(outcome).find("--min-angle"), std::string::npos);
}

TEST(ClosingLine, SaysThatSparsePointsAreFew)
{
    RunOutcome outcome = closed();
    outcome.points = outcome.points_before = 114;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\n"
                             "114 points are few, more images or dense points (stereo_fusion) "
                             "show more");
    outcome.is_dense = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
}

TEST(ClosingLine, NamesThePageBesideTheSurface)
{
    RunOutcome outcome = closed();
    outcome.out = "a b/mesh.v2.glb";
    EXPECT_EQ(line(outcome),
              "wrote a b/mesh.v2.glb: 22,268 faces, closed. See it: --report a b/mesh.v2.html");
}

TEST(RunOutcome, IsMadeOfWhatTheStagesCount)
{
    const RunOutcome outcome =
        outcome_of({{"filter",
                     {{"points", 70},
                      {"of", 100},
                      {"few views", 10},
                      {"high error", 15},
                      {"low angle", 5},
                      {"stray", 3}}},
                    {"open", {{"rays of the views", 40}, {"of", 4000}}},
                    {"orient", {{"sights on the outside", 9}, {"of", 10}, {"boundary edges", 12}}},
                    {"write", {{"faces", 99}, {"vertices", 50}}}});
    EXPECT_EQ(outcome.points, 70);
    EXPECT_EQ(outcome.points_before, 100);
    EXPECT_EQ(outcome.few_views, 10);
    EXPECT_EQ(outcome.high_error, 15);
    EXPECT_EQ(outcome.low_angle, 5);
    EXPECT_EQ(outcome.stray, 3);
    EXPECT_EQ(outcome.open, 0.01);
    EXPECT_EQ(outcome.boundary_edges, 12);
    EXPECT_EQ(outcome.faces, 99);
    EXPECT_FALSE(outcome_of({}).open);
}

} // namespace
} // namespace vcarve::cli::closing_line_test
