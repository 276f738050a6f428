// The option --report of compare, run as the user runs it.
#include "support/ball_model.h"
#include "support/page_parts.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::compare_report_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

/// A model of a ball, its surface, and a coarser one.
class CompareReportOfBall : public ::testing::Test {
  protected:
    CompareReportOfBall()
    {
        write_ball_model(ball, 400);
        EXPECT_EQ(run_program({"--quiet", ball, mesh}).exit_code, 0);
        EXPECT_EQ(run_program({"--quiet", ball, coarse, "--simplify", "100"}).exit_code, 0);
    }

    Outcome compare(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {"compare", ball, "--samples", "2000"});
        return run_program(more);
    }

    /// Expects the command to fail with this code and no table, and gives its sentence.
    std::string refusal_of(int exit_code, const std::vector<std::string>& more) const
    {
        return sentence_of_run(exit_code, compare(more));
    }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
    std::string mesh = folder / "mesh.ply";
    std::string coarse = folder / "coarse.ply";
    std::string page = folder / "out.html";
    std::string json = folder / "out.json";
};

TEST_F(CompareReportOfBall, HoldsTheFiguresThatJsonWrites)
{
    ASSERT_EQ(compare({mesh, coarse, "--truth", mesh, "--report", page, "--json", json}).exit_code,
              0);
    const Json record = part_of(bytes_of(page), "record");
    EXPECT_EQ(record["comparison"], Json::parse(bytes_of(json)));
    EXPECT_EQ(record["command"], "colmap-vcarve compare " + ball + " --samples 2000 " + mesh + " " +
                                     coarse + " --truth " + mesh + " --report " + page +
                                     " --json " + json);
    EXPECT_EQ(record["program"]["name"], "colmap-vcarve");
}

TEST_F(CompareReportOfBall, HasTheRowsOfTheTable)
{
    const Outcome outcome = compare({mesh, coarse, "--truth", mesh, "--report", page});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("surfaces shown"));
    std::string words;
    const auto add = [&](const std::string& text) {
        for (const char letter : text) {
            if (letter != ' ') words += letter;
        }
        words += '|';
    };
    const Json record = part_of(bytes_of(page), "record");
    for (const Json& row : record["rows"]) {
        words += '|';
        add(row["title"]);
        for (const Json& cell : row["cells"]) {
            add(cell);
        }
        words += '\n';
    }
    std::string table;
    for (const char letter : outcome.out) {
        if (letter != ' ') table += letter;
    }
    EXPECT_THAT(table, HasSubstr(":|\n" + words + "\n"));
    EXPECT_EQ(record["rows"][1]["place"], "/size/faces");
    EXPECT_EQ(record["rows"][1]["better"], nullptr);
    EXPECT_EQ(record["rows"][5]["better"], "lower");
}

TEST_F(CompareReportOfBall, DrawsEverySurface)
{
    ASSERT_EQ(compare({mesh, coarse, "--truth", mesh, "--report", page}).exit_code, 0);
    const std::string written = bytes_of(page);
    const Json record = part_of(written, "record");
    const Json scene = part_of(written, "scene");
    ASSERT_EQ(scene["surfaces"].size(), 3U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(scene["surfaces"][i]["name"], record["comparison"]["meshes"][i]["name"]);
        EXPECT_EQ(scene["surfaces"][i]["faces"]["count"],
                  record["comparison"]["meshes"][i]["size"]["faces"]);
        EXPECT_NE(scene["surfaces"][i]["colors"], nullptr);
    }
    EXPECT_EQ(scene["diagonal"], record["comparison"]["truth"]["diagonal"]);
    EXPECT_EQ(scene["views"].size(), 6U);
    EXPECT_EQ(scene["surfaces"][0]["wrong"].size(), 0U);
    EXPECT_GE(scene["surfaces"][1]["wrong"].size(), 3U);
    EXPECT_GE(scene["surfaces"][1]["missing"].size(), 3U);
}

TEST_F(CompareReportOfBall, ShowsTheSameForAnyNumberOfThreads)
{
    std::vector<Json> scenes;
    for (const char* threads : {"1", "2", "3"}) {
        ASSERT_EQ(compare({mesh, coarse, "--report", page, "--threads", threads}).exit_code, 0);
        scenes.push_back(part_of(bytes_of(page), "scene"));
    }
    EXPECT_EQ(scenes[0], scenes[1]);
    EXPECT_EQ(scenes[0], scenes[2]);
}

TEST_F(CompareReportOfBall, ChangesNoFigure)
{
    const Outcome without = compare({"--quiet", mesh, coarse});
    const Outcome with = compare({"--quiet", mesh, coarse, "--report", page});
    EXPECT_EQ(with.exit_code, 0);
    EXPECT_EQ(with.out, without.out);
}

TEST_F(CompareReportOfBall, ShowsWhatIsLeftWhereAMeshCouldNotBeMade)
{
    const std::filesystem::path mesher = folder.write("mesher", "#!/bin/sh\nsleep 60\n");
    std::filesystem::permissions(mesher, std::filesystem::perms::owner_all);
    const Outcome outcome =
        compare({mesh, "--colmap", mesher.string(), "--colmap-timeout", "1", "--report", page});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json record = part_of(bytes_of(page), "record");
    const Json scene = part_of(bytes_of(page), "scene");
    EXPECT_EQ(record["comparison"]["meshes"].size(), 3U);
    EXPECT_EQ(scene["surfaces"].size(), 2U);
    EXPECT_EQ(record["rows"][0]["cells"][0], record["comparison"]["meshes"][0]["failure"]);
}

TEST_F(CompareReportOfBall, IsRefusedWhereAnotherOutputOrAnInputIs)
{
    EXPECT_EQ(refusal_of(2, {mesh, "--report", page, "--json", page}),
              "colmap-vcarve: --report and --json cannot both be written to " + page + "\n");
    std::filesystem::copy(mesh, page);
    EXPECT_EQ(refusal_of(2, {page, coarse, "--report", page}),
              "colmap-vcarve: --report would replace the mesh " + page + "\n");
    EXPECT_EQ(refusal_of(2, {mesh, "--truth", page, "--report", page}),
              "colmap-vcarve: --report would replace the mesh " + page + "\n");
    EXPECT_EQ(bytes_of(page), bytes_of(mesh));
}

TEST_F(CompareReportOfBall, IsRefusedBeforeTheWorkWhereItCannotBeWritten)
{
    EXPECT_THAT(refusal_of(2, {mesh, "--report", folder / "none/out.html"}),
                HasSubstr("the folder " + (folder / "none").string() + " does not exist"));
}

TEST_F(CompareReportOfBall, IsNotLeftBehindByARunThatFails)
{
    folder.write("empty.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty double x\n"
                              "property double y\nproperty double z\nelement face 0\n"
                              "property list uchar int vertex_indices\nend_header\n");
    const std::size_t before = folder.num_entries();
    EXPECT_THAT(refusal_of(3, {mesh, folder / "empty.ply", "--report", page, "--json", json}),
                HasSubstr("no faces"));
    EXPECT_EQ(folder.num_entries(), before);
}

} // namespace
} // namespace vcarve::compare_report_test
