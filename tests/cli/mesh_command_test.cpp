#include "cli/mesh_output.h"
#include "options/declared.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace vcarve::mesh_command_test {
namespace {

using cli::MeshArguments;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;

const std::string kSeeHelp = " (see colmap-vcarve --help)\n";

TEST(Program, ReportsTheWrongArgument)
{
    const auto sentence = [](const std::vector<std::string>& words) {
        const std::string text = sentence_of(2, words);
        EXPECT_EQ(text.rfind("colmap-vcarve: ", 0), 0U);
        return text.substr(std::min<std::size_t>(15, text.size()));
    };
    EXPECT_EQ(sentence({}), "missing MODEL and OUT.ply" + kSeeHelp);
    EXPECT_EQ(sentence({"sparse/0"}), "missing OUT.ply after sparse/0" + kSeeHelp);
    EXPECT_EQ(sentence({"-o", "x.ply"}), "missing MODEL before x.ply" + kSeeHelp);
    EXPECT_EQ(sentence({"a", "b.ply", "-o", "x.ply"}),
              "the output is given twice, b.ply and -o x.ply; remove one\n");
    const std::string quote = "; quote paths that contain blanks" + kSeeHelp;
    EXPECT_EQ(sentence({"a", "b.ply", "c"}), "unexpected argument \"c\"" + quote);
    EXPECT_EQ(sentence({"my", "model", "b.ply"}), "unexpected argument \"model\"" + quote);
    EXPECT_EQ(sentence({"delaunay_mesher", "--input_path", "a", "--output_path", "b.ply"}),
              "delaunay_mesher is a command of COLMAP; type colmap-vcarve MODEL OUT.ply without "
              "it\n");
    EXPECT_EQ(sentence({"a", ""}), "argument 2 is empty\n");
    EXPECT_EQ(sentence({"--closed", "yes", "a", "b.ply"}),
              "--closed takes no value; remove \"yes\"\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--quiet=no"}), "--quiet takes no value; remove \"no\"\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--textur"}),
              "there is no option --textur; did you mean --texture?" + kSeeHelp);
    EXPECT_EQ(sentence({"a", "b.ply", "--min-vews", "3"}),
              "there is no option --min-vews; did you mean --min-views?" + kSeeHelp);
    EXPECT_EQ(sentence({"a", "b.ply", "--trim", "0"}),
              "--trim can be set from C++ and Python only, not on the command line\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--threads"}),
              "--threads needs a value: a whole number from 0 to 1024 (threads)\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--threads", "many"}),
              "--threads takes a whole number from 0 to 1024 (threads), not \"many\"\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--method=ctu"}),
              "--method takes cut or strict, not \"ctu\"\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--keep-work"}), "--keep-work needs --work FOLDER\n");
    EXPECT_EQ(sentence({"out.ply", "sparse"}),
              "the model comes first and the output second: colmap-vcarve sparse out.ply\n");
    const std::string wrong = "cannot write ";
    for (const std::string out : {"a/out.gltf", "a/out", "out.ply.gz"}) {
        EXPECT_EQ(sentence({"sparse", out}),
                  wrong + out +
                      ": the name of a mesh must end with .ply, .obj, .off, .stl or "
                      ".glb\n");
    }
    EXPECT_EQ(sentence({"a", "b.obj", "--ascii"}),
              wrong + "b.obj with --ascii, which is for PLY files only\n");
    EXPECT_EQ(sentence({"a", "b.GLB", "--attributes"}),
              wrong + "b.GLB with --attributes, which is for PLY files only\n");
    EXPECT_EQ(sentence({"a", "b.stl", "--texture"}),
              wrong + "b.stl with --texture: the name of a textured mesh must end with .glb, "
                      ".obj or .ply\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--preview", "c.jpg"}),
              wrong + "c.jpg: the name of a picture must end with .png\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--report", "c.txt"}),
              wrong + "c.txt: the name of a report must end with .html or .htm\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--view", "top"}), "--view needs --preview OUT.png\n");
    EXPECT_EQ(sentence({"a", "b.glb", "--texture-scale", "2"}),
              "--texture-scale needs --texture\n");
    EXPECT_EQ(sentence({"a", "b.ply", "--preview", "c.png", "--stats", "c.png"}),
              "--stats and --preview cannot both be written to c.png\n");
    EXPECT_EQ(sentence({"compare"}),
              "missing MODEL and meshes (see colmap-vcarve compare --help)\n");
}

TEST(Program, RejectsUnwritableOutputsBeforeReadingInput)
{
    const TemporaryFolder folder;
    const std::string nowhere = folder / "nowhere";
    const std::string there = folder.path();
    // The model is missing, too, but that would be detected later.
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
                        MatchesRegex("colmap-vcarve: cannot (write|create the work folder) [^:]+: "
                                     "([^:]+[(])?(Too many levels of symbolic links|File name too "
                                     "long)[)]?\n"));
        }
    }
    EXPECT_THAT(sentence_of(2, {nowhere, endless, "--stats", endless + ".json"}),
                HasSubstr("cannot write " + endless + ": "))
        << "not the message about two outputs with one file";
    std::filesystem::remove(folder / "loop.ply");
    EXPECT_EQ(sentence_of(2, {nowhere, "out.ply", "--stats", "out.ply"}),
              "colmap-vcarve: --stats and the mesh cannot both be written to out.ply\n");
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(Program, ReportsThatStandardOutputCannotBeWritten)
{
    for (const std::string words :
         {"--help", "--help-all", "--version", "help compare", "compare --help-all"}) {
        const std::string script = built_program() + " " + words + " >/dev/full";
        EXPECT_EQ(sentence_of_run(2, Subprocess({"/bin/sh", "-c", script}).wait()),
                  "colmap-vcarve: cannot write to the standard output\n")
            << words;
    }
}

TEST(Program, ExitsWithThreeIfTheInputIsWrong)
{
    const TemporaryFolder folder;
    const std::string nowhere = folder / "nowhere";
    EXPECT_THAT(sentence_of(3, {nowhere, folder / "out.ply"}),
                AllOf(HasSubstr("colmap-vcarve: "), HasSubstr(nowhere)));
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(Program, FitsItsHelpOnOneScreen)
{
    for (const std::string command : {"", "compare"}) {
        const Outcome help = run_program({command.empty() ? "--quiet" : command, "--help"});
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_THAT(help.err, IsEmpty());
        EXPECT_LE(std::ranges::count(help.out, '\n'), 60) << help.out;
        EXPECT_THAT(help.out, Not(HasSubstr("\n" + std::string(30, ' ')))) << "one line per option";
        const Outcome all = run_program({command.empty() ? "--quiet" : command, "--help-all"});
        std::istringstream lines(help.out + all.out);
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 80U) << line;
        }
    }
}

TEST(Program, ListsEachOptionAtItsLevel)
{
    const std::string help = run_program({"--help"}).out;
    const std::string all = run_program({"--help-all"}).out;
    const std::string markdown = run_program({"--help-markdown"}).out;
    Options options;
    for (const Option& option : options_of(options)) {
        const std::string& name = option.info.name;
        const std::string usage = "\n  --" + name;
        EXPECT_EQ(help.find(usage) != help.npos, option.info.level == OptionLevel::common) << name;
        EXPECT_EQ(all.find(usage) != all.npos, option.info.level != OptionLevel::library) << name;
        EXPECT_THAT(markdown, HasSubstr(name));
    }
    EXPECT_THAT(help, HasSubstr("\nCleanup options:\n"
                                "  --max-hole N                "
                                "Fill holes up to N edges [default: 12, max: 1000]\n"));
    EXPECT_THAT(help, HasSubstr("  --min-views N               "
                                "Drop points with fewer views [default: 2, min: 1]\n"));
    for (const char* name : {"--ascii", "--stats", "--verbose", "--view"}) {
        EXPECT_THAT(all, HasSubstr(name));
    }
}

TEST(Program, AcceptsHelpAndVersionAsWords)
{
    EXPECT_EQ(run_program({"help"}).out, run_program({"--help"}).out);
    EXPECT_EQ(run_program({"help", "compare"}).out, run_program({"compare", "-h"}).out);
    EXPECT_EQ(run_program({"version"}).out, run_program({"--version"}).out);
}

TEST(Program, AcceptsOptionsBeforeACommand)
{
    const std::string said = run_program({"compare", "--threads", "3", "--quiet", "m"}).err;
    EXPECT_THAT(said, HasSubstr("missing meshes after m"));
    EXPECT_EQ(run_program({"--threads", "3", "compare", "--quiet", "m"}).err, said);
    EXPECT_EQ(run_program({"--quiet", "--threads=3", "compare", "m"}).err, said);
    EXPECT_EQ(run_program({"--help", "compare"}).out, run_program({"compare", "--help"}).out);
    // After an operand, or an option that `compare` lacks, the word is an operand.
    EXPECT_THAT(run_program({"a", "compare"}).err, HasSubstr("compare: "));
    EXPECT_THAT(run_program({"--closed", "compare"}).err, HasSubstr("OUT.ply after compare"));
}

TEST(Program, PrintsVersionsOfTheProgramAndItsLibraries)
{
    const Outcome version = run_program({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, MatchesRegex("colmap-vcarve [0-9.]+( \\([^)\n]+\\))?\n"
                                          "[A-Za-z]+ build, [A-Za-z]+ [0-9.]+\n"
                                          "CGAL [0-9.]+, OpenMesh [0-9.]+, Eigen [0-9.]+, oneTBB "
                                          "[0-9.]+\nLicense: GPL-3.0-or-later\n"));
}

TEST(Program, LeavesNoFilesWhenInterrupted)
{
    for (const auto& [signal, code] : {std::pair(SIGINT, 130), {SIGTERM, 143}}) {
        const TemporaryFolder folder;
        write_ball_model(folder / "ball", 60'000);
        Subprocess program(program_with({folder / "ball", folder / "out.ply", "--threads", "1"}));
        // The stage "read" has ended, so the program makes the mesh now.
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

#ifndef VCARVE_WATCHES_MEMORY // AddressSanitizer reserves terabytes of address space
TEST(Program, ReportsThatMemoryIsShort)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 200'000);
    const Outcome outcome =
        Subprocess(program_with({"--quiet", folder / "ball", folder / "out.ply", "--threads", "1"}),
                   rlim_t{128} << 20) // the mapped libraries use half of it
            .wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "colmap-vcarve: out of memory\n");
    EXPECT_EQ(folder.num_entries(), 1U);
}
#endif

TEST(CommentsOf, ListRelevantOptionsThatDifferFromTheDefaults)
{
    MeshArguments arguments;
    const cli::OutputFrame frame = {std::nullopt, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    EXPECT_THAT(cli::comments_of({1, 2}, arguments, frame, 0),
                ElementsAre(MatchesRegex("made by colmap-vcarve [0-9.]+.*"),
                            "input 01020000000000000000000000000000"));
    arguments.options.surface.closed = true;
    arguments.options.refine.smooth.iterations = 2;
    arguments.options.threads = 3;
    arguments.options.memory.limit = 1 << 30;
    arguments.output.quiet = true;
    arguments.output.transform = "2.5";
    arguments.output.offset.word = 1; // has no effect, because the offset is zero
    arguments.options.texture.texture = true;
    const auto comments = cli::comments_of({}, arguments, frame, 500);
    EXPECT_THAT(std::vector(comments.begin() + 2, comments.end()),
                ElementsAre("option closed", "option smooth=2", "option texture",
                            "option transform=2.5", "option tile-points=500"));
}

TEST(CommentsOf, ContainNoPaths)
{
    MeshArguments arguments;
    arguments.options.crop.region = {.kind = RegionChoice::Kind::file, .file = "my house.ply"};
    arguments.output.transform = "2 to here.txt";
    arguments.options.images = "photos";
    const auto comments = cli::comments_of({}, arguments, {}, 0);
    EXPECT_THAT(std::vector(comments.begin() + 2, comments.end()),
                ElementsAre("option crop=FILE", "option images=FILE", "option transform=FILE"));
}

TEST(CommentsOf, AreTheSameForTextAndBinaryModels)
{
    const TemporaryFolder folder;
    const auto scene = fixtures_folder() / "scene";
    const std::string binary = folder / "a.ply";
    const std::string text = folder / "b.ply";
    ASSERT_EQ(run_program({scene / "sparse/0", binary}).exit_code, 0);
    ASSERT_EQ(run_program({scene / "sparse_txt", text}).exit_code, 0);
    EXPECT_TRUE(bytes_of(binary) == bytes_of(text));
}

} // namespace
} // namespace vcarve::mesh_command_test
