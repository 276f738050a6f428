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

TEST_F(ReportOfBall, HoldsTheRecordThatStatsWrites)
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
    EXPECT_EQ(scene["surface"]["faces"]["count"], record["mesh"]["faces"]);
    EXPECT_EQ(scene["views"].size(), 6U);
}

TEST_F(ReportOfBall, ShowsTheSameForAnyNumberOfThreads)
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

TEST_F(ReportOfBall, LetsNoNameOfAnImageBreakOut)
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

TEST_F(ReportOfBall, QuotesTheCommandAsAShellNeedsIt)
{
    const std::string odd = folder / "it's $ours.ply";
    ASSERT_EQ(run_program({ball, odd, "--stats", stats}).exit_code, 0);
    const std::string quoted = fmt::format("'{}/it'\\''s $ours.ply'", folder.path().string());
    EXPECT_EQ(Json::parse(bytes_of(stats))["command"],
              fmt::format("colmap-vcarve {} {} --stats {}", ball, quoted, stats));
}

TEST_F(ReportOfBall, IsRefusedUnderAnotherName)
{
    const Outcome outcome = run_program({ball, out, "--report", "out.txt"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "colmap-vcarve: cannot write out.txt: the name of a report must end with "
              ".html or .htm\n");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ReportOfBall, IsRefusedBeforeTheWorkWhereItCannotBeWritten)
{
    const Outcome outcome = run_program({ball, out, "--report", folder / "none/out.html"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("none"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ReportOfBall, IsRefusedWhereTheRecordIsWritten)
{
    const Outcome outcome = run_program({ball, out, "--report", page, "--stats", page});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "colmap-vcarve: --report and --stats cannot both be written to " + page + "\n");
}

TriMesh tetrahedron()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

/// What is said of a surface where a promise is broken; empty where none is.
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

TEST(Checked, CountsWhatASurfaceIs)
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

TEST(RequirePromised, TakesSurfacesWithHolesAndThroughThemselves)
{
    EXPECT_EQ(broken_promise(tetrahedron()), "");
    TriMesh open = tetrahedron();
    open.faces.pop_back();
    open.positions.insert(open.positions.end(), {{0.1, 0.1, -1}, {0.1, 0.1, 9}, {9, 9, 9}});
    open.faces.push_back({4, 5, 6});
    EXPECT_EQ(broken_promise(open), "");
}

TEST(RequirePromised, NamesWhatIsBrokenAndWhatRepeatsIt)
{
    TriMesh turned = tetrahedron();
    turned.faces[0] = {0, 1, 2};
    EXPECT_EQ(broken_promise(turned), "the surface has 3 orientation_faults and was not written; "
                                      "colmap-vcarve a/model b.ply reproduces it with a/model");
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

TEST(Program, ChecksTheSurfaceWhereAsked)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 200);
    const std::string out = folder / "out.ply";
    const Outcome outcome = run_program({folder / "ball", out, "--check", "-v"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                ::testing::ContainsRegex("\ncheck +[0-9,]+ of [0-9,]+ sights from behind [^\n]*\n"
                                         "write "));
    EXPECT_THAT(run_program({folder / "ball", out, "--check"}).err,
                ::testing::ContainsRegex("\ncheck +0 open edges[^\n]*\nwrote "));
}

} // namespace
} // namespace vcarve::cli::mesh_report_test
