// Tests of colmap-vcarve --work DIR.
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
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
        std::vector<std::string> all = {scene, out, "--tile-points", "2000", "--work", work};
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
    ASSERT_EQ(run_program({scene, out, "--tile-points", "2000", "--quiet"}).exit_code, 0);
    const std::string expected = bytes_of(out);
    const Outcome outcome = run({});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("digest +3 input files"));
    EXPECT_THAT(outcome.err, ContainsRegex("surfaces +[0-9]+ of [0-9]+ tiles"));
    EXPECT_TRUE(bytes_of(out) == expected);
    EXPECT_FALSE(fs::exists(work));
}

TEST_F(WorkOfProgram, KeepsFinishedTilesAfterAnInputError)
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
    const Outcome outcome =
        run_program({folder / "plane", out, "--tile-points", "9", "--work", work});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("no surface found"));
    EXPECT_TRUE(fs::exists(work + "/tiles.stage"));
}

TEST_F(WorkOfProgram, IsKeptAndResumedOnRequest)
{
    ASSERT_EQ(run({"--quiet", "--keep-work"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(work + "/tile-1-surface.stage"));
    const std::string expected = bytes_of(out);
    fs::remove(work + "/tile-1-surface.stage");
    const Outcome outcome = run({"--threads=1"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("points +0 of [0-9]+ tiles"));
    EXPECT_THAT(outcome.err, ContainsRegex("surfaces +1 of [0-9]+ tiles"));
    EXPECT_FALSE(fs::exists(work));
    EXPECT_TRUE(bytes_of(out) == expected);
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
    EXPECT_TRUE(fs::exists(work + "/tiles.stage"));
}

TEST_F(WorkOfProgram, IsSharedByProcessesWithTheSameCommand)
{
    ASSERT_EQ(run_program({scene, out, "--tile-points", "500", "--quiet"}).exit_code, 0);
    const std::string expected = bytes_of(out);
    const std::vector<std::string> command =
        program_with({scene, out, "--tile-points", "500", "--work", work});
    Subprocess first(command);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!fs::exists(work + "/job") && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    Subprocess second(command);
    EXPECT_EQ(second.wait().exit_code, 0);
    EXPECT_EQ(first.wait().exit_code, 0);
    EXPECT_TRUE(bytes_of(out) == expected);
    EXPECT_FALSE(fs::exists(work));
}

TEST_F(WorkOfProgram, IsRemovedWithTheFilesOfTilesBySignals)
{
    Subprocess program(program_with({scene, out, "--tile-points", "100"}));
    while (program.err_so_far().find("points ") == std::string::npos && program.is_running()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().exit_code, 128 + SIGTERM);
    EXPECT_EQ(folder.num_entries(), 0U);
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
