#include "options/declared.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace vcarve::mesh_command_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;

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
    std::filesystem::create_symlink("loop.ply", folder / "loop.ply");
    const std::string endless = folder / (std::string(300, 'n') + ".ply");
    for (const std::string& path : {(folder / "loop.ply").string(), endless}) {
        for (const std::string option : {"", "--stats", "--work"}) {
            std::vector<std::string> words = {nowhere, path};
            if (!option.empty()) words = {nowhere, folder / "out.ply", option, path};
            EXPECT_THAT(sentence_of(2, words),
                        MatchesRegex("colmap-vcarve: cannot (write|make the work folder) [^:]+: "
                                     "([^:]+: )?(Too many levels of symbolic links|File name too "
                                     "long)\n"));
        }
    }
    EXPECT_THAT(sentence_of(2, {nowhere, endless, "--stats", endless + ".json"}),
                HasSubstr("cannot write " + endless + ": "))
        << "not: both to one file";
    std::filesystem::remove(folder / "loop.ply");
    EXPECT_EQ(sentence_of(2, {nowhere, "out.ply", "--stats", "out.ply"}),
              "colmap-vcarve: --stats and the surface cannot both be written to out.ply\n");
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(Program, SaysThatNobodyTookWhatItWasToPrint)
{
    for (const std::string words : {"--help", "--help-all", "--version", "--help-man",
                                    "help compare", "compare --help-all"}) {
        const std::string script = built_program() + " " + words + " >/dev/full";
        EXPECT_EQ(sentence_of_run(2, Subprocess({"/bin/sh", "-c", script}).wait()),
                  "colmap-vcarve: cannot write to the standard output\n")
            << words;
    }
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
    const Outcome help = run_program({"--help-all"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.err, IsEmpty());
    Options options;
    for (const Option& option : options_of(options)) {
        EXPECT_THAT(help.out, HasSubstr("\n" + std::string(option.stage) + ":\n"));
        const std::string left = "\n  --" + option.info.name + (is_flag(option) ? "" : " ");
        ASSERT_THAT(help.out, HasSubstr(left));
        const std::string rest = help.out.substr(help.out.find(left) + 1);
        const std::string entry = rest.substr(0, rest.find("\n  -"));
        if (!is_flag(option)) {
            EXPECT_THAT(entry, HasSubstr("[default " + value_text(option)));
        }
    }
    for (const char* name : {"--ascii", "--threads", "--quiet", "--stats", "--help", "--version"}) {
        EXPECT_THAT(help.out, HasSubstr(name));
    }
}

TEST(Program, LeavesWhatIsForTuningOutOfItsHelp)
{
    const std::string help = run_program({"--help"}).out;
    Options options;
    for (const Option& option : options_of(options)) {
        const bool is_listed = help.find("\n  --" + option.info.name) != std::string::npos;
        EXPECT_EQ(is_listed, !option.info.tuning) << option.info.name;
    }
    std::size_t listed = 0;
    for (std::size_t at = help.find("\n  -"); at != std::string::npos;
         at = help.find("\n  -", at + 1)) {
        ++listed;
    }
    EXPECT_LE(listed, 30U);
}

TEST(Program, UnderstandsHelpAndVersionAsWords)
{
    EXPECT_EQ(run_program({"help"}).out, run_program({"--help"}).out);
    EXPECT_EQ(run_program({"help", "compare"}).out, run_program({"compare", "-h"}).out);
    EXPECT_EQ(run_program({"version"}).out, run_program({"--version"}).out);
}

TEST(Program, TakesOptionsBeforeACommand)
{
    const std::string said = run_program({"compare", "--threads", "3", "--quiet", "m"}).err;
    EXPECT_THAT(said, HasSubstr("expected a model and meshes"));
    EXPECT_EQ(run_program({"--threads", "3", "compare", "--quiet", "m"}).err, said);
    EXPECT_EQ(run_program({"--quiet", "--threads=3", "compare", "m"}).err, said);
    EXPECT_EQ(run_program({"--help", "compare"}).out, run_program({"compare", "--help"}).out);
    // Behind an operand it is one, and no option of compare makes it one.
    EXPECT_THAT(run_program({"a", "compare"}).err, HasSubstr("compare: "));
    EXPECT_THAT(run_program({"--closed", "compare"}).err, HasSubstr("MODEL OUT.ply"));
}

TEST(Program, KeepsItsHelpWithinEightyColumns)
{
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--help-all"}, {"compare", "--help-all"}}) {
        std::istringstream help(run_program(words).out);
        for (std::string line; std::getline(help, line);) {
            EXPECT_LE(line.size(), 80U) << line;
        }
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
    const std::string man = run_program({"--help-man"}).out;
    const std::string markdown = run_program({"--help-markdown"}).out;
    const std::string completion = run_program({"--help-bash"}).out;
    for (const Option& option : options_of(options)) {
        EXPECT_THAT(markdown, HasSubstr("| `--" + option.info.name));
        if (option.info.tuning) continue;
        std::string in_roff = "\\-\\-";
        for (const char letter : option.info.name) {
            in_roff += letter == '-' ? "\\-" : std::string(1, letter);
        }
        EXPECT_THAT(man, HasSubstr(in_roff));
        EXPECT_THAT(completion, HasSubstr("--" + option.info.name));
    }
}

TEST(Program, CompletesOptionsAndChoicesInBash)
{
    const TemporaryFolder folder;
    folder.write("complete.bash", run_program({"--help-bash"}).out);
    const std::string script = "source '" + (folder / "complete.bash").string() +
                               "'; COMP_WORDS=(colmap-vcarve a --sigh); COMP_CWORD=2; "
                               "_colmap_vcarve; echo \"${COMPREPLY[@]}\"; "
                               "COMP_WORDS=(colmap-vcarve --sights ne); COMP_CWORD=2; "
                               "_colmap_vcarve; echo \"${COMPREPLY[@]}\"";
    const Outcome completed = Subprocess({"/bin/bash", "-c", script}).wait();
    EXPECT_EQ(completed.out, "--sights\nnearest\n");
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
        EXPECT_THAT(outcome.err, Not(HasSubstr("wrote")));
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
} // namespace vcarve::mesh_command_test
