// Tests of the program's operator new through runs of the program.
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vcarve::scratch_new_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::MatchesRegex;

/// A ball that is large enough for arrays in files. It has lumps, because points on one sphere are
/// not divided into blocks.
struct ProgramInBlocks : ::testing::Test {
    ProgramInBlocks() { write_ball_model(ball, 60'000, Eigen::Vector3d::Zero(), 0.05); }

    Outcome run(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {ball, out});
        return run_program(arguments);
    }
    nlohmann::json memory_of(std::vector<std::string> arguments) const
    {
        const std::string stats = folder / "stats.json";
        arguments.insert(arguments.end(), {"--stats", stats});
        EXPECT_EQ(run(arguments).exit_code, 0);
        return nlohmann::json::parse(bytes_of(stats))["memory"];
    }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
    std::string out = folder / "out.ply";
};

TEST_F(ProgramInBlocks, WritesTheSameMesh)
{
    EXPECT_EQ(memory_of({"--blocks", "0"})["scratch_bytes"], 0);
    const std::string in_memory = bytes_of(out);
    const nlohmann::json memory = memory_of({"--blocks", "2", "--work", folder / "work"});
    EXPECT_EQ(memory["blocks"], 2);
    EXPECT_GT(memory["scratch_bytes"], 8 << 20);
    EXPECT_LE(memory["scratch_bytes"], memory["expected_scratch_bytes"]);
    EXPECT_TRUE(bytes_of(out) == in_memory);
    EXPECT_FALSE(std::filesystem::exists(folder / "work"));
}

TEST_F(ProgramInBlocks, UsesBlocksWithANoteIfMemoryIsShort)
{
    const Outcome outcome = run({"--max-memory", "30M", "--threads", "1"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, ContainsRegex("about [0-9.]+M needed, 30M allowed: [0-9]+ blocks, "
                                           "scratch of about [0-9.]+M in .*out.ply.scratch-"));
    EXPECT_EQ(folder.num_entries(), 2U) << "the ball and the mesh";
}

TEST_F(ProgramInBlocks, LeavesNoFilesWhenTerminated)
{
    Subprocess program(program_with({ball, out, "--blocks", "2"}));
    while (program.err_so_far().find("triangulate ") == std::string::npos && program.is_running()) {
        ::usleep(1000);
    }
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().exit_code, 128 + SIGTERM);
    EXPECT_EQ(folder.num_entries(), 1U) << "only the ball";
}

} // namespace
} // namespace vcarve::scratch_new_test
