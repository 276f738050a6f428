// Tests of colmap-vcarve --work DIR.
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <map>
#include <string_view>
#include <thread>

namespace vcarve::mesh_command_work_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class WorkOfProgram : public ::testing::Test {
  protected:
    std::vector<std::string> words(const std::vector<std::string>& more) const
    {
        std::vector<std::string> all = {scene, out, "--work", work};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Outcome run(const std::vector<std::string>& more) const { return run_program(words(more)); }

    TemporaryFolder folder;
    std::string scene = (fixtures_folder() / "scene/sparse/0").string();
    std::string out = folder / "out.ply";
    std::string work = folder / "work";
};

} // namespace

TEST_F(WorkOfProgram, DoesNotChangeTheMeshAndIsRemoved)
{
    ASSERT_EQ(run_program({scene, out, "--quiet"}).exit_code, 0);
    const std::string expected = bytes_of(out);
    const Outcome outcome = run({});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("digest +3 input files"));
    EXPECT_THAT(outcome.err, ContainsRegex("keep +[0-9]+ MiB of cells"));
    EXPECT_TRUE(bytes_of(out) == expected);
    EXPECT_FALSE(fs::exists(work));
}

TEST_F(WorkOfProgram, IsEmptyAfterAnInputError)
{
    // Points in one plane pass the filter but have no cells.
    folder.write("plane/cameras.txt", "1 SIMPLE_PINHOLE 1000 1000 1000 500 500\n");
    folder.write("plane/images.txt", "1 1 0 0 0 1 0 5 1 a\n\n2 1 0 0 0 -1 0 5 1 b\n\n");
    std::string points;
    for (int i = 0; i < 25; ++i) {
        points +=
            fmt::format("{} {} {} 0 9 9 9 0.5 1 0 2 0\n", i + 1, 0.1 * (i % 5), 0.1 * (i / 5));
    }
    folder.write("plane/points3D.txt", points);
    fs::create_directory(work);
    const Outcome outcome = run_program({folder / "plane", out, "--work", work});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("all lie in one plane"));
    EXPECT_THAT(outcome.err, HasSubstr("keep "));
    EXPECT_TRUE(fs::is_empty(work));
}

TEST_F(WorkOfProgram, IsKeptAndResumedOnRequest)
{
    ASSERT_EQ(run({"--quiet", "--keep-work"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(work + "/surface.stage"));
    const std::string expected = bytes_of(out);
    const std::string stats = folder / "stats.json";
    const Outcome outcome = run({"--threads=1", "--ascii", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("note: checkpoint surface in the folder " + work +
                                       " replaces the stages triangulate, rays, "
                                       "cut, surface"));
    EXPECT_THAT(outcome.err, ContainsRegex("resume +[0-9]+ MiB of surface"));
    EXPECT_FALSE(fs::exists(work));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    std::vector<std::string> stages;
    for (const auto& stage : record["stages"]) {
        stages.push_back(stage["name"]);
    }
    EXPECT_THAT(stages, testing::IsSupersetOf({"resume", "triangulate", "cut", "surface"}));
    ASSERT_EQ(run({"--quiet"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(out) == expected);
}

TEST_F(WorkOfProgram, GivesTheSameFiguresFromEveryCheckpoint)
{
    const auto figures = [&](const std::vector<std::string>& words) {
        const std::string stats = folder / "stats.json";
        std::vector<std::string> all = words;
        all.insert(all.end(), {"--quiet", "--stats", stats});
        EXPECT_EQ(run_program(all).exit_code, 0);
        std::map<std::string, nlohmann::json> counts;
        const auto record = nlohmann::json::parse(bytes_of(stats));
        for (const auto& stage : record["stages"]) {
            counts[stage["name"]] = stage["counts"];
        }
        std::erase_if(counts, [](const auto& stage) {
            return stage.first == "digest" || stage.first == "keep" || stage.first == "resume";
        });
        return counts;
    };
    // These options fill holes that views look through. Whether views look through a hole follows
    // from data of an earlier stage.
    const std::vector<std::string> torn = {"--hardly-seen=0.9", "--max-hole=60"};
    const auto alone = figures({scene, out, torn[0], torn[1]});
    const auto unfilled = figures({scene, out, torn[0], "--max-hole=0"});
    ASSERT_LT(alone.at("open").at("rays of the views"),
              unfilled.at("open").at("rays of the views"));
    const std::vector<std::string> kept_on = words({torn[0], torn[1], "--keep-work"});
    EXPECT_EQ(figures(kept_on), alone);
    for (const char* const kept : {"surface", "rays", "cells", "points"}) {
        EXPECT_EQ(figures(kept_on), alone) << "after " << kept;
        // The next run resumes from the checkpoint before this one.
        for (const char* const later : {"surface", "rays", "cells", "points"}) {
            EXPECT_TRUE(fs::remove(work + "/" + later + ".stage"));
            if (std::string_view(later) == kept) break;
        }
    }
    EXPECT_EQ(figures(words(torn)), alone) << "without checkpoints";
}

TEST_F(WorkOfProgram, IsRejectedForOtherOptionsOrInput)
{
    ASSERT_EQ(run({"--quiet", "--keep-work"}).exit_code, 0);
    Outcome outcome = run({"--quiet", "--quality=2"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.err, "colmap-vcarve: the work folder " + work +
                               " belongs to another run: --quality was 1 and is now 2; choose "
                               "another folder with --work, or remove this one to start over\n");
    scene = (fixtures_folder() / "room").string();
    outcome = run({"--quiet"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr(" belongs to another run: "));
    EXPECT_THAT(outcome.err, EndsWith("to start over\n"));
    EXPECT_TRUE(fs::exists(work + "/surface.stage"));
}

TEST_F(WorkOfProgram, IsUsedByOneRunAtATime)
{
    // Many virtual viewpoints make the run slow.
    Subprocess first(program_with(words({"--virtual-views=300"})));
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!fs::exists(work + "/points.stage") && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    const Outcome second = run({"--quiet"});
    EXPECT_EQ(second.exit_code, 3);
    EXPECT_EQ(second.err, "colmap-vcarve: another run uses the work folder " + work +
                              "; wait until it ends, or choose another folder with --work\n");
    EXPECT_EQ(first.wait().exit_code, 0);
}

TEST_F(WorkOfProgram, MustBeASeparateFolder)
{
    Outcome outcome = run_program({scene, out, "--keep-work"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--keep-work needs --work FOLDER\n"));
    outcome = run_program({scene, out, "--work="});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--work"));
    folder.write("work/mine.txt", "mine");
    outcome = run({});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("is not a work folder: it contains mine.txt"));
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(WorkOfProgram, IsNotLeftBehindIfTheInputCannotBeRead)
{
    for (const char* const model : {"/broken", "/nowhere"}) {
        scene = fixtures_folder().string() + model;
        EXPECT_EQ(run({"--quiet"}).exit_code, 3) << model;
        EXPECT_FALSE(fs::exists(work)) << model;
    }
}

} // namespace vcarve::mesh_command_work_test
