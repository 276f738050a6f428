#include "cli/option_table.h"
#include "support/ball_model.h"
#include "support/subprocess.h"
#include "support/temporary_folder.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace vcarve {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

const std::string kSeeHelp = " (see colmap-vcarve --help)\n";

std::vector<std::string> command(const std::vector<std::string>& arguments)
{
    std::vector<std::string> words = {VCARVE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
}

Outcome run(const std::vector<std::string>& arguments)
{
    return Subprocess(command(arguments)).wait();
}

/// Runs the program, expects it to fail with this code and nothing on stdout, and gives its
/// sentence.
std::string sentence_of(int exit_code, const std::vector<std::string>& arguments)
{
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_THAT(outcome.out, IsEmpty());
    return outcome.err;
}

/// A folder with a model of a ball in "ball", small enough to be meshed at once.
class ProgramOnBall : public testing::Test {
  protected:
    ProgramOnBall() { write_ball_model(ball, 400); }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
    std::string out = folder / "out.ply";
    std::string stats = folder / "stats.json";
};

TEST_F(ProgramOnBall, WritesASurfaceAndOneLineAStage)
{
    const Outcome outcome = run({ball, out});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err,
                MatchesRegex("read +400 points \\(6 views, [0-9]+ sights\\) +[0-9.]+ s\n"
                             "memory +[0-9]+ MiB expected +[0-9.]+ s\n"
                             "filter +[0-9]+ of 400 points.* s\n"
                             "triangulate +[0-9,]+ cells +[0-9.]+ s\n"
                             "(.|\n)*"
                             "write +[0-9,]+ faces \\([0-9,]+ vertices\\) +[0-9.]+ s\n" +
                             out + ": [0-9,]+ faces, closed; .*\n"));
    EXPECT_THAT(outcome.err, Not(ContainsRegex("[\r\x1b]"))) << "plain lines where piped";
    EXPECT_THAT(bytes_of(out), HasSubstr("format binary_little_endian"));
    EXPECT_EQ(folder.num_entries(), 2U);
}

/// What the program writes to a terminal of this kind.
std::string shown_on_terminal(const std::string& environment,
                              const std::vector<std::string>& arguments)
{
    std::string line = "env -u NO_COLOR " + environment + " '" + VCARVE_PROGRAM + "'";
    for (const std::string& argument : arguments) {
        line += " '" + argument + "'";
    }
    return Subprocess({"/usr/bin/script", "-qec", line, "/dev/null"}).wait().out;
}

TEST_F(ProgramOnBall, EmphasisesOnATerminalUnlessNoColorForbidsIt)
{
    const auto shown = [&](const std::string& environment) {
        return shown_on_terminal(environment, {ball, out});
    };
    const std::string bold = "\x1b[1m" + out + ": ";
    EXPECT_THAT(shown("TERM=xterm"), HasSubstr(bold));
    EXPECT_THAT(shown("TERM=xterm NO_COLOR="), HasSubstr(bold)) << "empty is not set";
    for (const char* plain : {"TERM=xterm NO_COLOR=1", "TERM=dumb"}) {
        EXPECT_THAT(shown(plain), AllOf(HasSubstr(out + ": "), Not(HasSubstr("\x1b["))));
    }
}

TEST_F(ProgramOnBall, CountsTheEdgesAtWhichItsSurfaceIsOpen)
{
    ASSERT_EQ(run({ball, out, "--stats", stats, "--crop=-2,-2,-2,2,2,0.3"}).exit_code, 0);
    const auto record = nlohmann::json::parse(bytes_of(stats));
    const auto& stages = record["stages"];
    const auto orient =
        std::ranges::find_if(stages, [](const auto& stage) { return stage["name"] == "orient"; });
    ASSERT_NE(orient, stages.end());
    EXPECT_GT(record["mesh"]["boundary_edges"], 0);
    EXPECT_EQ((*orient)["counts"]["boundary edges"], record["mesh"]["boundary_edges"]);
}

TEST_F(ProgramOnBall, IsSilentOnRequest)
{
    const Outcome outcome = run({"--quiet", ball, out});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
}

TEST_F(ProgramOnBall, WritesTextOnRequest)
{
    EXPECT_EQ(run({ball, out, "--ascii"}).exit_code, 0);
    EXPECT_THAT(bytes_of(out), HasSubstr("format ascii"));
}

TEST_F(ProgramOnBall, WritesTheSameBytesForAnyNumberOfThreads)
{
    std::vector<std::string> written;
    for (const char* threads : {"0", "1", "2", "3"}) {
        EXPECT_EQ(run({ball, out, "--threads", threads}).exit_code, 0);
        written.push_back(bytes_of(out));
    }
    EXPECT_FALSE(written[0].empty());
    EXPECT_TRUE(std::ranges::all_of(written, [&](const auto& w) { return w == written[0]; }));
}

TEST_F(ProgramOnBall, RecordsTheRun)
{
    ASSERT_EQ(
        run({ball, out, "--stats", stats, "--min-views=1", "--method", "strict", "--threads", "1"})
            .exit_code,
        0);
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["input"]["points"], 400);
    EXPECT_EQ(record["input"]["views"], 6);
    EXPECT_EQ(record["input"]["format"], "text");
    EXPECT_EQ(record["output"], out);
    EXPECT_EQ(record["threads_used"], 1);
    EXPECT_EQ(record["options"]["min-views"], 1);
    EXPECT_EQ(record["options"]["method"], "strict");
    EXPECT_EQ(record["options"]["ascii"], false);
    EXPECT_EQ(record["program"]["name"], "colmap-vcarve");
    EXPECT_EQ(record["stages"].front()["name"], "read");
    EXPECT_EQ(record["stages"].back()["name"], "write");
    EXPECT_EQ(record["stages"].back()["counts"]["faces"], record["mesh"]["faces"]);
    for (const auto& stage : record["stages"]) {
        EXPECT_GT(stage["seconds"], 0.0);
        EXPECT_GT(stage["peak_memory_bytes"], 0);
        EXPECT_LE(stage["seconds"], record["total"]["seconds"]);
        EXPECT_LE(stage["peak_memory_bytes"], record["total"]["peak_memory_bytes"]);
    }
}

TEST_F(ProgramOnBall, TakesAModelThatNeedsNoMoreMemoryThanAllowed)
{
    EXPECT_EQ(run({ball, out, "--quiet", "--max-memory", "1G"}).exit_code, 0);
}

TEST_F(ProgramOnBall, RefusesAModelThatNeedsTooMuchMemory)
{
    EXPECT_THAT(sentence_of(3, {"--quiet", ball, out, "--max-memory", "1M", "--blocks", "0"}),
                MatchesRegex("colmap-vcarve: .*ball: 400 points with [0-9]+ sights need about "
                             "[0-9.]+M of memory, and --max-memory allows 1M\n"));
    EXPECT_THAT(sentence_of(3, {"--quiet", ball, out, "--max-memory", "1M"}),
                HasSubstr("M of memory even in blocks, and --max-memory allows 1M\n"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ProgramOnBall, RefusesABinaryModelForItsMemoryBeforeReadingIt)
{
    // A file that reading would refuse: its one point lacks the last byte of its track.
    const std::string count = std::string("\1\0\0\0\0\0\0\0", 8);
    folder.write("cut/cameras.bin", count);
    folder.write("cut/images.bin", count);
    folder.write("cut/points3D.bin", count + std::string(51 + 7, '\0'));
    EXPECT_THAT(sentence_of(3, {"--quiet", folder / "cut", out, "--max-memory", "1M"}),
                HasSubstr("1 points with 0 sights need about"));
}

TEST_F(ProgramOnBall, RecordsEveryOption)
{
    ASSERT_EQ(run({ball, out, "--stats", stats}).exit_code, 0);
    const auto record = nlohmann::json::parse(bytes_of(stats));
    Options options;
    cli::OptionTable table;
    options.visit(table);
    for (const cli::OptionRow& row : table.rows()) {
        EXPECT_TRUE(record["options"].contains(row.name)) << row.name;
    }
}

TEST_F(ProgramOnBall, ReplacesAnEarlierSurfaceOnlyWhenItSucceeds)
{
    folder.write("out.ply", "earlier");
    const Outcome failed = run({folder / "nothing", out});
    EXPECT_EQ(failed.exit_code, 3);
    EXPECT_EQ(bytes_of(out), "earlier");
    EXPECT_EQ(run({ball, out}).exit_code, 0);
    EXPECT_THAT(bytes_of(out), HasSubstr("element face"));
}

TEST(Program, SaysWhatItExpectedWhereOperandsAreMissingOrTooMany)
{
    const std::string expected =
        "colmap-vcarve: expected a model and an output, MODEL OUT.ply, but got ";
    EXPECT_EQ(sentence_of(2, {}), expected + "nothing" + kSeeHelp);
    EXPECT_EQ(sentence_of(2, {"sparse/0"}), expected + "sparse/0" + kSeeHelp);
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "c"}), expected + "a b.ply c" + kSeeHelp);
}

TEST(Program, RecognisesASwappedInputAndOutput)
{
    EXPECT_EQ(sentence_of(2, {"out.ply", "sparse"}),
              "colmap-vcarve: the model comes first and the output second: colmap-vcarve sparse "
              "out.ply\n");
}

TEST_F(ProgramOnBall, LeavesModelsNearTheOriginWhereTheyAre)
{
    EXPECT_EQ(run({ball, out}).exit_code, 0);
    const std::string before = bytes_of(out);
    const Outcome outcome = run({ball, out, "--offset", "auto", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(bytes_of(out), before);
    EXPECT_THAT(outcome.err, Not(HasSubstr("minus")));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["offset"], nlohmann::json::parse("[0.0, 0.0, 0.0]"));
    EXPECT_EQ(record["options"]["offset"], "auto");
}

TEST_F(ProgramOnBall, SaysWhichOffsetItSubtracts)
{
    write_ball_model(ball, 400, {5e5, 4.6e6, 1.0});
    const Outcome outcome = run({ball, out, "--offset", "auto", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err,
                HasSubstr("the coordinates written are those of the model minus 500000, 4600000, "
                          "0\n"));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["offset"], nlohmann::json::parse("[500000.0, 4600000.0, 0.0]"));
    EXPECT_EQ(sentence_of(2, {ball, out, "--offset", "5e5,4.6e6"}),
              "colmap-vcarve: --offset takes none, auto or x,y,z, not \"5e5,4.6e6\"\n");
}

TEST_F(ProgramOnBall, WarnsOfFloatsFarFromTheOrigin)
{
    write_ball_model(ball, 400, {5e5, 4.6e6, 1.0});
    const std::string stl = folder / "out.stl";
    EXPECT_THAT(run({ball, stl}).err,
                ContainsRegex("the floats of [^ ]*out.stl move vertices by up "
                              "to [0-9.]+e-02 of the surface's size; "
                              "--offset auto avoids that\n"));
    EXPECT_THAT(run({ball, stl, "--offset", "auto"}).err, Not(HasSubstr("floats")));
}

TEST(Program, NamesTheEndsOfTheFilesItWrites)
{
    const std::string ends = ": the name of a surface must end with .ply, .obj, .off, .stl or .glb";
    for (const std::string out : {"a/out.gltf", "a/out", "a/obj", "out.ply.gz"}) {
        EXPECT_EQ(sentence_of(2, {"sparse", out}),
                  "colmap-vcarve: cannot write " + out + ends + "\n");
    }
}

TEST(Program, RefusesWhatOnlyPlyHolds)
{
    EXPECT_EQ(sentence_of(2, {"sparse", "out.obj", "--ascii"}),
              "colmap-vcarve: cannot write out.obj with --ascii, which is for PLY files only\n");
    EXPECT_EQ(sentence_of(2, {"sparse", "out.GLB", "--attributes"}),
              "colmap-vcarve: cannot write out.GLB with --attributes, which is for PLY files "
              "only\n");
}

TEST_F(ProgramOnBall, WritesTheFormatThatTheNameMeans)
{
    const std::string obj = folder / "out.obj";
    const std::string glb = folder / "out.glb";
    EXPECT_EQ(run({ball, obj}).exit_code, 0);
    EXPECT_EQ(run({ball, glb}).exit_code, 0);
    EXPECT_THAT(bytes_of(obj), StartsWith("# made by colmap-vcarve "));
    EXPECT_THAT(bytes_of(glb), StartsWith("glTF"));
    EXPECT_EQ(folder.num_entries(), 3U);
}

TEST(Program, RefusesWrongOptionsInOneSentence)
{
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--min-vews", "3"}),
              "colmap-vcarve: there is no option --min-vews; did you mean --min-views?" + kSeeHelp);
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--web-edge=0"}),
              "colmap-vcarve: there is no option --web-edge; did you mean --bridging-edge?" +
                  kSeeHelp);
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--softness", "1"}),
              "colmap-vcarve: there is no option --softness; did you mean --distance-sigma?" +
                  kSeeHelp);
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--threads"}),
              "colmap-vcarve: --threads needs a value: a whole number from 0 to 1024 (threads)\n");
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--threads", "many"}),
              "colmap-vcarve: --threads takes a whole number from 0 to 1024 (threads), not "
              "\"many\"\n");
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--method=ctu"}),
              "colmap-vcarve: --method takes cut or strict, not \"ctu\"\n");
    EXPECT_EQ(sentence_of(2, {"a", "b.ply", "--quiet=no"}),
              "colmap-vcarve: --quiet takes no value\n");
}

TEST(Program, SaysBeforeItReadsAnythingThatAnOutputCannotBeWritten)
{
    const TemporaryFolder folder;
    const std::string nowhere = folder / "nowhere";
    const std::string there = folder.path();
    // There is no model either, which would be found out only later.
    EXPECT_EQ(sentence_of(2, {nowhere, nowhere + "/out.ply"}),
              "colmap-vcarve: cannot write " + nowhere + "/out.ply: the folder " + nowhere +
                  " does not exist\n");
    EXPECT_EQ(sentence_of(2, {nowhere, there}),
              "colmap-vcarve: cannot write " + there + ": it is a folder\n");
    EXPECT_EQ(sentence_of(2, {nowhere, folder / "out.ply", "--stats", nowhere + "/s.json"}),
              "colmap-vcarve: cannot write " + nowhere + "/s.json: the folder " + nowhere +
                  " does not exist\n");
    EXPECT_EQ(sentence_of(2, {nowhere, "out.ply", "--stats", "out.ply"}),
              "colmap-vcarve: --stats and the surface cannot both be written to out.ply\n");
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(Program, ExitsWithThreeWhereTheInputIsWrong)
{
    const TemporaryFolder folder;
    const std::string nowhere = folder / "nowhere";
    EXPECT_THAT(sentence_of(3, {nowhere, folder / "out.ply"}),
                AllOf(HasSubstr("colmap-vcarve: "), HasSubstr(nowhere)));
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(Program, ListsEveryOptionWithItsDefaultInItsHelp)
{
    const Outcome help = run({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.err, IsEmpty());
    Options options;
    cli::OptionTable table;
    options.visit(table);
    for (const cli::OptionRow& row : table.rows()) {
        EXPECT_THAT(help.out, HasSubstr("\n" + row.stage + ":\n"));
        const std::string left =
            "\n  --" + row.name + (row.kind == cli::OptionKind::flag ? "" : " ");
        ASSERT_THAT(help.out, HasSubstr(left));
        const std::string rest = help.out.substr(help.out.find(left) + 1);
        const std::string entry = rest.substr(0, rest.find("\n  -"));
        const std::string initial = row.initial.empty() ? "" : "[default " + row.initial;
        EXPECT_THAT(entry, HasSubstr(initial));
    }
    for (const char* name : {"--ascii", "--threads", "--quiet", "--stats", "--help", "--version"}) {
        EXPECT_THAT(help.out, HasSubstr(name));
    }
}

TEST(Program, KeepsItsHelpWithinAHundredColumns)
{
    std::istringstream help(run({"--help"}).out);
    for (std::string line; std::getline(help, line);) {
        EXPECT_LE(line.size(), 100U) << line;
    }
}

TEST(Program, TellsItsVersionAndThoseOfItsLibraries)
{
    const Outcome version = run({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, MatchesRegex("colmap-vcarve [0-9.]+( \\([^)\n]+\\))?\n"
                                          "[A-Za-z]+ build, [A-Za-z]+ [0-9.]+\n"
                                          "CGAL [0-9.]+, OpenMesh [0-9.]+, Eigen [0-9.]+, oneTBB "
                                          "[0-9.]+\nLicence: GPL-3.0-or-later\n"));
}

TEST(Program, MakesItsManPageTablesAndCompletionFromTheSameOptions)
{
    Options options;
    cli::OptionTable table;
    options.visit(table);
    const std::string man = run({"--help-man"}).out;
    const std::string markdown = run({"--help-markdown"}).out;
    const std::string completion = run({"--help-bash"}).out;
    for (const cli::OptionRow& row : table.rows()) {
        std::string in_roff = "\\-\\-";
        for (const char letter : row.name) {
            in_roff += letter == '-' ? "\\-" : std::string(1, letter);
        }
        EXPECT_THAT(man, HasSubstr(in_roff));
        EXPECT_THAT(markdown, HasSubstr("| `--" + row.name));
        EXPECT_THAT(completion, HasSubstr("--" + row.name));
    }
}

TEST(Program, CompletesOptionsAndChoicesInBash)
{
    const TemporaryFolder folder;
    folder.write("complete.bash", run({"--help-bash"}).out);
    const std::string script = "source '" + (folder / "complete.bash").string() +
                               "'; COMP_WORDS=(colmap-vcarve a --meth); COMP_CWORD=2; "
                               "_colmap_vcarve; echo \"${COMPREPLY[@]}\"; "
                               "COMP_WORDS=(colmap-vcarve --method st); COMP_CWORD=2; "
                               "_colmap_vcarve; echo \"${COMPREPLY[@]}\"";
    const Outcome completed = Subprocess({"/bin/bash", "-c", script}).wait();
    EXPECT_EQ(completed.out, "--method\nstrict\n");
    EXPECT_THAT(completed.err, IsEmpty());
}

TEST(Program, LeavesNothingBehindWhenItIsInterrupted)
{
    for (const auto& [signal, code] : {std::pair(SIGINT, 130), {SIGTERM, 143}}) {
        const TemporaryFolder folder;
        write_ball_model(folder / "ball", 60'000);
        Subprocess program(command({folder / "ball", folder / "out.ply", "--threads", "1"}));
        // "read" is over, so it works on the surface now.
        while (program.err_so_far().empty() && program.is_running()) {
            ::usleep(1000);
        }
        program.send(signal);
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exit_code, code);
        EXPECT_THAT(outcome.err, Not(HasSubstr("write")));
        EXPECT_EQ(folder.num_entries(), 1U);
    }
}

#ifndef __SANITIZE_ADDRESS__ // which reserves terabytes of address space
TEST(Program, SaysThatMemoryIsShort)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 200'000);
    const Outcome outcome =
        Subprocess(command({"--quiet", folder / "ball", folder / "out.ply", "--threads", "1"}),
                   rlim_t{128} << 20) // of which the libraries' files take half
            .wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "colmap-vcarve: out of memory\n");
    EXPECT_EQ(folder.num_entries(), 1U);
}
#endif

} // namespace
} // namespace vcarve
