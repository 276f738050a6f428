#include "cli/option_table.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace vcarve {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;

const std::string kSeeHelp = " (see colmap-vcarve --help)\n";

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
    const Outcome help = run_program({"--help"});
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
    std::istringstream help(run_program({"--help"}).out);
    for (std::string line; std::getline(help, line);) {
        EXPECT_LE(line.size(), 100U) << line;
    }
}

TEST(Program, TellsItsVersionAndThoseOfItsLibraries)
{
    const Outcome version = run_program({"--version"});
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
    const std::string man = run_program({"--help-man"}).out;
    const std::string markdown = run_program({"--help-markdown"}).out;
    const std::string completion = run_program({"--help-bash"}).out;
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
    folder.write("complete.bash", run_program({"--help-bash"}).out);
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
        Subprocess program(program_with({folder / "ball", folder / "out.ply", "--threads", "1"}));
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

#ifndef VCARVE_WATCHES_MEMORY // which reserves terabytes of address space
TEST(Program, SaysThatMemoryIsShort)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 200'000);
    const Outcome outcome =
        Subprocess(program_with({"--quiet", folder / "ball", folder / "out.ply", "--threads", "1"}),
                   rlim_t{128} << 20) // of which the libraries' files take half
            .wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "colmap-vcarve: out of memory\n");
    EXPECT_EQ(folder.num_entries(), 1U);
}
#endif

} // namespace
} // namespace vcarve
