#include "support/ball_model.h"
#include "support/page_parts.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace vcarve::mesh_report_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

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
    EXPECT_EQ(scene["surfaces"][0]["faces"]["count"], record["mesh"]["faces"]);
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

} // namespace
} // namespace vcarve::mesh_report_test
