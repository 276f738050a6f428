#include "base/stage_counts.h"
#include "cli/mesh_report.h"
#include "support/ball_model.h"
#include "support/page_parts.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace vcarve::cli::mesh_report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

class ReportOfBall : public ::testing::Test {
  protected:
    ReportOfBall() { write_ball_model(ball, 400); }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
    std::string out = folder / "out.ply";
    std::string page = folder / "out.html";
    std::string stats = folder / "stats.json";
};

TEST_F(ReportOfBall, ContainsTheRecordOfStats)
{
    ASSERT_EQ(run_program({ball, out, "--report", page, "--stats", stats}).exit_code, 0);
    const Json record = Json::parse(bytes_of(stats));
    EXPECT_EQ(part_of(bytes_of(page), "record"), record);
    EXPECT_EQ(record["command"],
              fmt::format("colmap-vcarve {} {} --report {} --stats {}", ball, out, page, stats));
    EXPECT_EQ(record["report"]["points"], record["stages"][2]["counts"]["points"]);
    EXPECT_EQ(record["report"]["histograms"]["edge_length"]["values"],
              3 * record["mesh"]["faces"].get<int>());
    const Json scene = part_of(bytes_of(page), "scene");
    EXPECT_EQ(scene["surfaces"][0]["faces"]["count"], record["mesh"]["faces"]);
    EXPECT_EQ(scene["views"].size(), 6U);
}

TEST_F(ReportOfBall, ShowsTheSameForAnyThreadCount)
{
    std::vector<Json> scenes;
    std::vector<Json> reports;
    for (const char* threads : {"1", "2", "3"}) {
        ASSERT_EQ(run_program({ball, out, "--report", page, "--threads", threads}).exit_code, 0);
        scenes.push_back(part_of(bytes_of(page), "scene"));
        reports.push_back(part_of(bytes_of(page), "record")["report"]);
    }
    EXPECT_EQ(scenes[0], scenes[1]);
    EXPECT_EQ(scenes[0], scenes[2]);
    EXPECT_EQ(reports[0], reports[1]);
    EXPECT_EQ(reports[0], reports[2]);
}

TEST_F(ReportOfBall, EscapesImageNamesInHtml)
{
    std::string images = bytes_of(ball + "/images.txt");
    images.replace(images.find("+z"), 2, "</script><img/src=x/onerror=alert(1)>");
    folder.write("ball/images.txt", images);
    ASSERT_EQ(run_program({ball, out, "--report", page}).exit_code, 0);
    const std::string written = bytes_of(page);
    EXPECT_THAT(written, Not(HasSubstr("<img/src")));
    EXPECT_EQ(part_of(written, "scene")["views"][0]["name"],
              "</script><img/src=x/onerror=alert(1)>.jpg");
}

TEST_F(ReportOfBall, QuotesTheCommandForAShell)
{
    const std::string odd = folder / "it's $ours.ply";
    ASSERT_EQ(run_program({ball, odd, "--stats", stats}).exit_code, 0);
    const std::string quoted = fmt::format("'{}/it'\\''s $ours.ply'", folder.path().string());
    EXPECT_EQ(Json::parse(bytes_of(stats))["command"],
              fmt::format("colmap-vcarve {} {} --stats {}", ball, quoted, stats));
}

TriMesh tetrahedron()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

/// The error message for a mesh that breaks a promise; empty if it breaks none.
std::string broken_promise(const TriMesh& mesh)
{
    try {
        Log silent;
        require_promised(checked(mesh, {}, silent), "colmap-vcarve a/model b.ply", "a/model");
        return "";
    } catch (const std::logic_error& error) {
        return error.what();
    }
}

TEST(Checked, CountsFacesAndSelfIntersections)
{
    Log silent;
    const Json json = checked(tetrahedron(), {}, silent);
    EXPECT_EQ(json["faces"], 4);
    EXPECT_EQ(json["self_intersections"], 0);
    EXPECT_TRUE(json["is_closed"]);
    TriMesh crossed = tetrahedron();
    crossed.positions.insert(crossed.positions.end(), {{0.1, 0.1, -1}, {0.1, 0.1, 9}, {9, 9, 9}});
    crossed.faces.push_back({4, 5, 6});
    EXPECT_EQ(checked(crossed, {}, silent)["self_intersections"], 2);
}

TEST(RequirePromised, AcceptsHolesAndSelfIntersections)
{
    EXPECT_EQ(broken_promise(tetrahedron()), "");
    TriMesh open = tetrahedron();
    open.faces.pop_back();
    open.positions.insert(open.positions.end(), {{0.1, 0.1, -1}, {0.1, 0.1, 9}, {9, 9, 9}});
    open.faces.push_back({4, 5, 6});
    EXPECT_EQ(broken_promise(open), "");
}

TEST(RequirePromised, ReportsTheFaultAndTheCommand)
{
    TriMesh turned = tetrahedron();
    turned.faces[0] = {0, 1, 2};
    EXPECT_EQ(broken_promise(turned), "the mesh has 3 orientation_faults and was not written; the "
                                      "command was colmap-vcarve a/model b.ply, the model a/model");
    TriMesh thrice = tetrahedron();
    thrice.positions.emplace_back(5, 5, 5);
    thrice.faces.push_back({0, 1, 4});
    EXPECT_THAT(broken_promise(thrice), HasSubstr("1 nonmanifold_edges"));
    TriMesh degenerate = tetrahedron();
    degenerate.faces.push_back({0, 1, 1});
    EXPECT_THAT(broken_promise(degenerate), HasSubstr("1 degenerate_faces"));
    TriMesh touching = tetrahedron();
    touching.positions.insert(touching.positions.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
    touching.faces.insert(touching.faces.end(), {{0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
    EXPECT_THAT(broken_promise(touching), HasSubstr("1 nonmanifold_vertices"));
}

TEST(Program, ChecksTheMeshOnRequest)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 200);
    const std::string out = folder / "out.ply";
    const Outcome outcome = run_program({folder / "ball", out, "--check", "-v"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                ::testing::ContainsRegex("\ncheck +0 open edges [^\n]*[0-9,]+ of [0-9,]+ rays from "
                                         "behind[^\n]*\nwrite "));
    EXPECT_THAT(run_program({folder / "ball", out, "--check"}).err,
                ::testing::ContainsRegex("\ncheck +0 boundary edges[^\n]*\nwrote "));
}

/// The outcome of a run without proposals.
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

TEST(ClosingLine, SuggestsAReportIfThereAreNoProposals)
{
    EXPECT_EQ(line(usual()),
              "wrote out.ply: 22,268 faces, holes in less than 1 % of the visible surface"
              "\nSee it: --report out.html");
    RunOutcome outcome = usual();
    outcome.open = 0.0;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, no visible holes. See it: --report "
                             "out.html");
    outcome.has_report = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, no visible holes");
    outcome.past = 0.08;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, no visible holes; 8 % of the pixels "
                             "show sky or surfaces without points");
    outcome.open.reset();
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, 990 boundary edges");
    outcome.boundary_edges = 0;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed");
}

TEST(ClosingLine, NamesTheOptionThatClosesHoles)
{
    RunOutcome outcome = usual();
    outcome.has_report = true;
    outcome.open = 0.035;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, holes in 4 % of the visible surface (to "
                             "close: --max-closing 0)");
    Options options;
    options.surface.rules.max_closing = 0.0;
    EXPECT_EQ(line(outcome, options), "wrote out.ply: 22,268 faces, holes in 4 % of the visible "
                                      "surface (to close: --closed)");
}

TEST(ClosingLine, ProposesCroppingOfLargeFacesUnlessCropped)
{
    RunOutcome outcome = closed();
    outcome.long_area = 0.7;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\n"
                             "if large faces are in the way, try --crop auto");
    Options options;
    options.surface.closed = true;
    EXPECT_EQ(line(outcome, options), "wrote out.ply: 22,268 faces, closed\n"
                                      "if large faces are in the way, leave out --closed");
    options = {};
    options.crop.region.kind = RegionChoice::Kind::looked_at;
    EXPECT_EQ(line(outcome, options),
              "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
}

TEST(ClosingLine, NamesTheLimitThatDroppedManyPoints)
{
    const std::string begin = "wrote out.ply: 22,268 faces, closed\nif parts are missing, try a ";
    RunOutcome outcome = closed();
    outcome.low_angle = 11000;
    EXPECT_EQ(line(outcome), begin + "smaller --min-angle: 50 % of the points were dropped");
    outcome.high_error = 4400;
    outcome.low_angle = 0;
    EXPECT_EQ(line(outcome), begin + "larger --max-error: 20 % of the points were dropped");
    outcome.high_error = 0;
    outcome.stray = 6600;
    EXPECT_EQ(line(outcome), begin + "larger --stray-spacing: 30 % of the points were dropped");
}

TEST(ClosingLine, ProposesOptionsThatKeepPointsOfOneView)
{
    RunOutcome outcome = closed();
    outcome.few_views = 11000;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\nif parts are missing, try "
                             "--min-views 1 or --rays nearest: 50 % of the points were dropped");
    outcome.takes_nearest_views = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\nif parts are missing, try "
                             "--min-views 1: 50 % of the points were dropped");
    Options one_view;
    one_view.points.min_views = 1;
    EXPECT_EQ(line(outcome, one_view),
              "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
    outcome.takes_nearest_views = false;
    EXPECT_EQ(line(outcome, one_view),
              "wrote out.ply: 22,268 faces, closed\nif parts are missing, try --rays nearest: "
              "50 % of the points were dropped");
    outcome.few_views = 4000; // 18 %
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
    Options options;
    options.points.min_views = 3;
    outcome.few_views = 11000;
    EXPECT_EQ(line(outcome, options),
              "wrote out.ply: 22,268 faces, closed\nif parts are missing, try a smaller "
              "--min-views: 50 % of the points were dropped");
}

TEST(ClosingLine, SortsLimitsByTheNumberOfDroppedPoints)
{
    const std::string begin = "\nif parts are missing, try ";
    const std::string angle = "a smaller --min-angle: 23 % of the points were dropped";
    const std::string stray = "a larger --stray-spacing: 25 % of the points were dropped";
    RunOutcome outcome = closed();
    outcome.high_error = 4500;
    outcome.low_angle = 5000;
    outcome.stray = 5500;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed" + begin + stray + begin + angle);
}

TEST(ClosingLine, ShowsAtMostTwoProposals)
{
    RunOutcome outcome = closed();
    outcome.high_error = outcome.low_angle = 8000;
    outcome.long_area = 1.0;
    EXPECT_EQ(line(outcome).find("--crop"), std::string::npos);
    EXPECT_NE(line(outcome).find("--min-angle"), std::string::npos);
}

TEST(ClosingLine, NotesThatSparsePointsAreFew)
{
    RunOutcome outcome = closed();
    outcome.points = outcome.points_before = 114;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed\n"
                             "only 114 points; add images, or use a dense cloud");
    outcome.is_dense = true;
    EXPECT_EQ(line(outcome), "wrote out.ply: 22,268 faces, closed. See it: --report out.html");
}

TEST(ClosingLine, NamesThePageAfterTheMesh)
{
    RunOutcome outcome = closed();
    outcome.out = "a b/mesh.v2.glb";
    EXPECT_EQ(line(outcome),
              "wrote a b/mesh.v2.glb: 22,268 faces, closed. See it: --report a b/mesh.v2.html");
}

TEST(RunOutcome, CollectsCountsOfTheStages)
{
    const RunOutcome outcome = outcome_of(
        {{"filter",
          {{counts::kFilter.points, 70, 100},
           {counts::kFilter.few_views, 10},
           {counts::kFilter.high_error, 15},
           {counts::kFilter.low_angle, 5},
           {counts::kFilter.stray, 3}}},
         {"open", {{counts::kMesh.open, 40, 4000}, {counts::kMesh.past, 400}}},
         {"orient", {{counts::kMesh.outside, 9, 10}, {counts::kMesh.boundary_edges, 12}}},
         {"write", {{counts::kOutput.faces, 99}, {counts::kOutput.vertices, 50}}}});
    EXPECT_EQ(outcome.points, 70);
    EXPECT_EQ(outcome.points_before, 100);
    EXPECT_EQ(outcome.few_views, 10);
    EXPECT_EQ(outcome.high_error, 15);
    EXPECT_EQ(outcome.low_angle, 5);
    EXPECT_EQ(outcome.stray, 3);
    EXPECT_EQ(outcome.open, 0.01);
    EXPECT_EQ(outcome.past, 0.1);
    EXPECT_EQ(outcome.boundary_edges, 12);
    EXPECT_EQ(outcome.faces, 99);
    EXPECT_FALSE(outcome_of({}).open);
}

} // namespace
} // namespace vcarve::cli::mesh_report_test
