#include "cli/replay.h"
#include "support/ball_model.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace vcarve::cli::replay_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

struct ProgramThatTells : ::testing::Test {
    ProgramThatTells() { write_ball_model(ball, 200); }

    std::string replay(const std::string& surface) const
    {
        const Outcome outcome = run_program({"--replay", surface});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
};

TEST(RecordComments, TellOptionsThatCountAndDifferFromTheDefaults)
{
    MeshArguments arguments;
    EXPECT_THAT(record_comments(arguments, {1, 2}),
                ElementsAre(MatchesRegex("made by colmap-vcarve [0-9.]+.*"),
                            "input 01020000000000000000000000000000"));
    arguments.options.surface.closed = true;
    arguments.options.refine.smooth.iterations = 2;
    arguments.options.threads = 3;
    arguments.options.memory.most = 1 << 30;
    arguments.output.quiet = true;
    arguments.output.transform = "2.5";
    arguments.texture.texture = true;
    const auto told = record_comments(arguments, {});
    EXPECT_THAT(
        std::vector(told.begin() + 2, told.end()),
        ElementsAre("option closed", "option smooth=2", "option transform=2.5", "option texture"));
}

TEST(RecordComments, TellNoPaths)
{
    MeshArguments arguments;
    arguments.options.crop.region = {.kind = RegionChoice::Kind::file, .file = "my house.ply"};
    arguments.output.transform = "2 to here.txt";
    arguments.texture.images = "photos";
    const auto told = record_comments(arguments, {});
    EXPECT_THAT(std::vector(told.begin() + 2, told.end()),
                ElementsAre("option crop=FILE", "option transform=FILE", "option images=FILE"));
}

TEST_F(ProgramThatTells, MakesTheSameFileByTheCommandItPrints)
{
    for (const char* const name : {"a.ply", "a.obj", "a.off", "a.glb"}) {
        const std::string first = folder / name;
        const Outcome made = run_program(
            {ball, first, "--max-hole", "7", "--offset", "1,2,3", "--threads", "1", "--quiet"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        const std::string told = replay(first);
        EXPECT_THAT(told, MatchesRegex("colmap-vcarve MODEL .*" + std::string(name) +
                                       " --max-hole=7 --offset=1,2,3\n# with version [0-9.]+.*, "
                                       "of a MODEL, .*, with the digest [0-9a-f]{32}, .*\n"));
        std::istringstream words(told.substr(0, told.find('\n')));
        std::vector<std::string> command;
        for (std::string word; words >> word;) {
            command.push_back(word);
        }
        command.erase(command.begin());
        command.at(0) = ball;
        command.at(1) = folder / ("again-" + std::string(name));
        ASSERT_EQ(run_program(command).exit_code, 0);
        EXPECT_TRUE(bytes_of(first) == bytes_of(command[1])) << name;
    }
}

TEST_F(ProgramThatTells, KnowsOtherInputsAndTheSameElsewhere)
{
    const std::string first = folder / "a.ply";
    const std::string second = folder / "b.ply";
    ASSERT_EQ(run_program({ball, first}).exit_code, 0);
    write_ball_model(folder / "moved/ball", 200);
    ASSERT_EQ(run_program({folder / "moved/ball", second}).exit_code, 0);
    EXPECT_TRUE(bytes_of(first) == bytes_of(second));
    write_ball_model(folder / "moved/ball", 199);
    ASSERT_EQ(run_program({folder / "moved/ball", second}).exit_code, 0);
    const auto digest = [&](const std::string& file) {
        const std::string told = replay(file);
        return told.substr(told.find("digest"));
    };
    EXPECT_NE(digest(first), digest(second));
}

TEST_F(ProgramThatTells, MakesTheSameFileOfTextAndBinary)
{
    const auto scene = fixtures_folder() / "scene";
    const std::string binary = folder / "a.ply";
    const std::string text = folder / "b.ply";
    ASSERT_EQ(run_program({scene / "sparse/0", binary}).exit_code, 0);
    ASSERT_EQ(run_program({scene / "sparse_txt", text}).exit_code, 0);
    EXPECT_TRUE(bytes_of(binary) == bytes_of(text));
}

TEST_F(ProgramThatTells, SaysWhereAFileTellsNothing)
{
    const std::string other = folder.write("other.ply", "ply\nformat ascii 1.0\nend_header\n");
    const Outcome outcome = run_program({"--replay", other});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.err,
              "colmap-vcarve: " + other + ": found no record of the run that made it\n");
    EXPECT_THAT(run_program({"--replay", folder / "none.ply"}).err, HasSubstr("does not exist"));
    for (const char* const broken : {"", "glTF", "glTF\2AAA{\"asset\":\"made by colmap-vcarve "}) {
        EXPECT_EQ(run_program({"--replay", folder.write("b.glb", broken)}).exit_code, 3);
    }
}

TEST_F(ProgramThatTells, QuotesWhatAForeignFileTells)
{
    const std::string crafted = folder.write(
        "a.obj", "# made by colmap-vcarve 1\x1b[2J\n# input 0\n# option x; rm -r $HOME\n");
    EXPECT_EQ(replay(crafted),
              "colmap-vcarve MODEL " + crafted +
                  " '--x; rm -r $HOME'\n"
                  "# with version 1?[2J, of a MODEL, as --points and the like have "
                  "it read, with the digest 0, which --stats tells\n");
}

} // namespace
} // namespace vcarve::cli::replay_test
