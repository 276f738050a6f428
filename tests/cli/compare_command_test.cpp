#include "support/ball_model.h"
#include "support/page_parts.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::compare_command_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

/// A model of a ball, and the mesh that this program makes of it.
class CompareOnBall : public ::testing::Test {
  protected:
    CompareOnBall()
    {
        write_ball_model(model, 400);
        EXPECT_EQ(run_program({"--quiet", model, mesh}).exit_code, 0);
    }

    Outcome compare(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {"compare", model, "--samples", "2000"});
        return run_program(more);
    }

    nlohmann::json figures(const std::vector<std::string>& more) const
    {
        std::vector<std::string> words = {"--json", json};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = compare(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(bytes_of(json));
    }

    /// Expects the command to fail with this code and no table. Returns its message.
    std::string refusal_of(int exit_code, const std::vector<std::string>& more) const
    {
        return sentence_of_run(exit_code, compare(more));
    }

    /// A program that replaces COLMAP.
    std::string script(const std::string& body) const
    {
        const std::filesystem::path path = folder.write("mesher", "#!/bin/sh\n" + body + "\n");
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path.string();
    }

    TemporaryFolder folder;
    std::string model = folder / "ball";
    std::string mesh = folder / "mesh.ply";
    std::string json = folder / "figures.json";
};

TEST_F(CompareOnBall, PrintsATableWithOneColumnPerMeshAndALegend)
{
    const Outcome outcome = compare({mesh, mesh});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, StartsWith("| "));
    const std::string head = outcome.out.substr(0, outcome.out.find('\n'));
    EXPECT_EQ(head.substr(head.find("| /")), "| " + mesh + " | " + mesh + " |");
    EXPECT_THAT(outcome.out, HasSubstr("| hidden rays "));
    EXPECT_THAT(outcome.out, HasSubstr("\nhidden rays: fraction of rays"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("seconds")));
    EXPECT_THAT(outcome.err, MatchesRegex("read +400 points, (.|\n)*"
                                          "reference +[0-9]+ points.* s\n"
                                          "closed +[0-9]+ faces of the closed surface .* s\n"
                                          "measure +[0-9]+ faces of .* s\n"
                                          "measure +[0-9]+ faces of .* s\n"));
}

TEST_F(CompareOnBall, NamesColumnsAfterFiles)
{
    const Outcome outcome = compare({"--quiet", mesh});
    EXPECT_THAT(outcome.out, MatchesRegex("\\| +\\| +mesh.ply \\|\n(.|\n)*"));
    EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(CompareOnBall, FindsAMeshEqualToItself)
{
    const nlohmann::json record = figures({mesh, "--truth", mesh});
    const nlohmann::json& truth = record["meshes"][0]["truth"];
    ASSERT_EQ(truth["agreement"].size(), 4U);
    for (const auto& agreement : truth["agreement"]) {
        EXPECT_EQ(agreement["precision"], 1.0);
        EXPECT_EQ(agreement["recall"], 1.0);
        EXPECT_EQ(agreement["f"], 1.0);
    }
    EXPECT_NEAR(truth["mean_accuracy"], 0.0, 1e-12);
    EXPECT_NEAR(truth["mean_completeness"], 0.0, 1e-12);
    EXPECT_EQ(truth["blocked"], 0.0);
    EXPECT_EQ(record["meshes"][0]["size"]["orientation_faults"], 0);
}

TEST_F(CompareOnBall, AppliesTheOffsetOfAFile)
{
    const std::string far_ball = folder / "far";
    write_ball_model(far_ball, 400, {5e5, 4.6e6, 100.0});
    const auto figures_of = [&](const std::string& offset) {
        const std::string written = folder / (offset + ".ply");
        // Vertices stay at the points, so that writing rounds no coordinate.
        const Outcome made =
            run_program({"--quiet", far_ball, written, "--offset", offset, "--denoise", "0"});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        EXPECT_EQ(run_program({"compare", "--quiet", far_ball, written, "--truth", written,
                               "--samples", "2000", "--json", json})
                      .exit_code,
                  0);
        nlohmann::json record = nlohmann::json::parse(bytes_of(json))["meshes"][0];
        record.erase("name");
        return record;
    };
    const nlohmann::json expected = figures_of("none");
    EXPECT_EQ(expected["truth"]["agreement"][0]["f"], 1.0);
    EXPECT_EQ(figures_of("auto"), expected);
    EXPECT_EQ(figures_of("499000,4.5e6,-7"), expected);
    EXPECT_THAT(bytes_of(folder / "none.ply"), Not(HasSubstr("offset")));
    EXPECT_THAT(bytes_of(folder / "auto.ply"), HasSubstr("comment offset 500000 4600000 100\n"));
    EXPECT_THAT(bytes_of(folder / "499000,4.5e6,-7.ply"),
                HasSubstr("comment offset 499000 4500000 -7\n"));
}

TEST_F(CompareOnBall, GivesTheSameFiguresForAnyThreadCount)
{
    const Outcome one = compare({mesh, "--truth", mesh, "--threads", "1"});
    const Outcome three = compare({mesh, "--truth", mesh, "--threads", "3"});
    EXPECT_THAT(one.out, HasSubstr("F 0.25 %"));
    EXPECT_EQ(one.out, three.out);
}

TEST_F(CompareOnBall, RejectsUnreadableAndUnwritableFilesBeforeTheWorkStarts)
{
    const std::string nowhere = folder / "nowhere";
    EXPECT_EQ(refusal_of(3, {mesh, nowhere}),
              "colmap-vcarve: " + nowhere + ": the file does not exist\n");
    EXPECT_EQ(refusal_of(2, {mesh, "other.glb"}),
              "colmap-vcarve: other.glb: compare reads PLY files only\n");
    EXPECT_EQ(refusal_of(2, {mesh, "--json", nowhere + "/a.json"}),
              "colmap-vcarve: cannot write " + nowhere + "/a.json: the folder " + nowhere +
                  " does not exist\n");
    EXPECT_EQ(refusal_of(2, {mesh, "--report", mesh + ".html", "--json", mesh + ".html"}),
              "colmap-vcarve: --report and --json cannot both be written to " + mesh + ".html\n");
    EXPECT_EQ(refusal_of(2, {mesh, "--json", mesh}),
              "colmap-vcarve: --json would replace the mesh " + mesh + "\n");
}

TEST_F(CompareOnBall, RejectsAMeshInAnotherFrame)
{
    const std::string far = folder.write("far.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"
                                                    "property float x\nproperty float y\n"
                                                    "property float z\nelement face 1\n"
                                                    "property list uchar int vertex_indices\n"
                                                    "end_header\n1000 0 0\n1001 0 0\n1000 1 0\n"
                                                    "3 0 1 2\n");
    const Outcome outcome = compare({"--quiet", far});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, StartsWith("colmap-vcarve: " + far + ": "));
    EXPECT_THAT(outcome.err, HasSubstr("frame"));
}

TEST_F(CompareOnBall, MeasuresColmapsMeshBesideItsOwn)
{
    const std::string mesher = script("cp '" + mesh + "' \"$7\"");
    const nlohmann::json record = figures({"--colmap", mesher});
    ASSERT_EQ(record["meshes"].size(), 2U);
    EXPECT_EQ(record["meshes"][0]["name"], "COLMAP");
    EXPECT_EQ(record["meshes"][1]["name"], "colmap-vcarve");
    EXPECT_EQ(record["meshes"][0]["size"], record["meshes"][1]["size"]);
    for (const auto& column : record["meshes"]) {
        EXPECT_GT(column["cost"]["seconds"], 0.0);
        EXPECT_GE(column["cost"]["cpu_seconds"], 0.0);
        EXPECT_GT(column["cost"]["peak_memory_bytes"], 0);
    }
}

TEST_F(CompareOnBall, RunsColmapsMesherOnTheFoundModel)
{
    const std::string words = folder / "words";
    const Outcome outcome = compare({"--colmap", script("echo \"$@\" > '" + words + "'; exit 1")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(bytes_of(words), StartsWith("delaunay_mesher --input_type sparse --input_path " +
                                            model + " --output_path /"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("| COLMAP |")));
}

TEST_F(CompareOnBall, NotesThatColmapLacksCgalAndContinues)
{
    const std::string mesher =
        script("echo 'ERROR: Delaunay meshing requires CGAL, which is not available.'; exit 1");
    const Outcome outcome = compare({mesh, "--colmap", mesher});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("note: " + mesher +
                                       " was built without CGAL, so it has no Delaunay mesher; "
                                       "its column is omitted\n"));
    EXPECT_THAT(outcome.out, MatchesRegex("\\| +\\| colmap-vcarve \\| +mesh.ply \\|\n(.|\n)*"));
}

TEST_F(CompareOnBall, NotesTheLastOutputOfColmapIfItFails)
{
    const std::string mesher = script("echo first; echo 'out of luck'; exit 4");
    EXPECT_THAT(compare({"--colmap", mesher}).err,
                HasSubstr("note: " + mesher +
                          " exited with code 4 and wrote no mesh, its last "
                          "output: out of luck; its column is omitted\n"));
    const std::string nowhere = folder / "nowhere";
    EXPECT_THAT(compare({"--colmap", nowhere}).err,
                HasSubstr("note: " + nowhere +
                          " could not be started and wrote no mesh; its column is omitted\n"));
}

TEST_F(CompareOnBall, DetectsThatColmapFailsEvenIfSigchldIsIgnored)
{
    const std::string mesher = script("cp '" + mesh + "' \"$7\"; exit 4");
    const Outcome outcome = Subprocess({"/usr/bin/env", "--ignore-signal=CHLD", built_program(),
                                        "compare", model, "--samples", "2000", "--colmap", mesher})
                                .wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("exited with code 4"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("| COLMAP |")));
}

TEST_F(CompareOnBall, KillsColmapAfterTheTimeout)
{
    const std::string pid = folder / "pid";
    const std::string mesher = script("sleep 600 & echo $! > '" + pid + "'; wait");
    const nlohmann::json record = figures({"--colmap", mesher, "--colmap-timeout", "1"});
    EXPECT_EQ(record["meshes"][0],
              nlohmann::json({{"name", "COLMAP"}, {"failure", "timed out after 1 s"}}));
    EXPECT_EQ(record["meshes"][1]["name"], "colmap-vcarve");
    // The program's child is gone, too, or a zombie.
    std::ifstream status("/proc/" + std::to_string(std::stoi(bytes_of(pid))) + "/stat");
    std::string number;
    std::string name;
    std::string state = "gone";
    status >> number >> name >> state;
    EXPECT_THAT(state, ::testing::AnyOf("gone", "Z", "X"));
}

TEST_F(CompareOnBall, LeavesNothingBehind)
{
    const TemporaryFolder temporary;
    const std::string command = "TMPDIR='" + temporary.path().string() + "' exec '" +
                                built_program() + "' compare '" + model + "' --colmap '" +
                                script("cp '" + mesh + "' \"$7\"") + "'";
    EXPECT_EQ(Subprocess({"/bin/sh", "-c", command}).wait().exit_code, 0);
    EXPECT_EQ(temporary.num_entries(), 0U);
}

TEST_F(CompareOnBall, LeavesNothingBehindWhenItIsInterrupted)
{
    const TemporaryFolder temporary;
    const std::string ready = folder / "ready";
    const std::string command = "TMPDIR='" + temporary.path().string() + "' exec '" +
                                built_program() + "' compare '" + model + "' --colmap '" +
                                script("echo > '" + ready + "'; exec sleep 600") + "'";
    Subprocess program({"/bin/sh", "-c", command});
    while (!std::filesystem::exists(ready) && program.is_running()) {
        ::usleep(1000);
    }
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().exit_code, 143);
    EXPECT_EQ(temporary.num_entries(), 0U);
}

/// Adds a coarser mesh and a page.
class CompareReportOfBall : public CompareOnBall {
  protected:
    CompareReportOfBall()
    {
        EXPECT_EQ(run_program({"--quiet", model, coarse, "--simplify", "100"}).exit_code, 0);
    }

    std::string coarse = folder / "coarse.ply";
    std::string page = folder / "out.html";
};

TEST_F(CompareReportOfBall, ContainsTheFiguresOfJson)
{
    ASSERT_EQ(compare({mesh, coarse, "--truth", mesh, "--report", page, "--json", json}).exit_code,
              0);
    const Json record = part_of(bytes_of(page), "record");
    EXPECT_EQ(record["comparison"], Json::parse(bytes_of(json)));
    EXPECT_EQ(record["command"], "colmap-vcarve compare " + model + " --samples 2000 " + mesh +
                                     " " + coarse + " --truth " + mesh + " --report " + page +
                                     " --json " + json);
    EXPECT_EQ(record["program"]["name"], "colmap-vcarve");
}

TEST_F(CompareReportOfBall, ContainsTheRowsOfTheTable)
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

TEST_F(CompareReportOfBall, DrawsEveryMesh)
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

TEST_F(CompareReportOfBall, ShowsTheSameForAnyThreadCount)
{
    std::vector<Json> scenes;
    for (const char* threads : {"1", "2", "3"}) {
        ASSERT_EQ(compare({mesh, coarse, "--report", page, "--threads", threads}).exit_code, 0);
        scenes.push_back(part_of(bytes_of(page), "scene"));
    }
    EXPECT_EQ(scenes[0], scenes[1]);
    EXPECT_EQ(scenes[0], scenes[2]);
}

TEST_F(CompareReportOfBall, EscapesNamesInHtml)
{
    const std::string nasty = folder / "<img src=x onerror=y()>.ply";
    std::filesystem::copy(mesh, nasty);
    ASSERT_EQ(compare({nasty, coarse, "--report", page}).exit_code, 0);
    EXPECT_THAT(bytes_of(page), Not(HasSubstr("<img src")));
    EXPECT_EQ(part_of(bytes_of(page), "scene")["surfaces"][0]["name"],
              "<img src=x onerror=y()>.ply");
}

TEST_F(CompareReportOfBall, ShowsTheOtherMeshesIfOneCouldNotBeMade)
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

TEST_F(CompareReportOfBall, IsNotWrittenByAFailedRun)
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
} // namespace vcarve::compare_command_test
