#include "options/declared.h"
#include "support/ball_model.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/reconstruct.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace vcarve::mesh_command_run_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

/// A folder with a model of a ball in "ball", small enough to be meshed at once.
class ProgramOnBall : public ::testing::Test {
  protected:
    ProgramOnBall() { write_ball_model(ball, 400); }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
    std::string out = folder / "out.ply";
    std::string stats = folder / "stats.json";
};

TEST_F(ProgramOnBall, WritesAMeshAndOneLinePerStage)
{
    const Outcome outcome = run_program({ball, out});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, MatchesRegex("read +400 points, 6 views, [0-9]+ rays +[0-9.]+ s\n"
                                          "memory +[0-9]+ MiB expected +[0-9.]+ s\n"
                                          "filter +[0-9]+ of 400 points kept.* s\n"
                                          "triangulate +[0-9,]+ cells +[0-9.]+ s\n"
                                          "(.|\n)*"
                                          "cut +[0-9,]+ of [0-9,]+ cells are solid +[0-9.]+ s\n"
                                          "(.|\n)*"
                                          "wrote " +
                                          out + ": [0-9,]+ faces, closed\n.*\n"));
    EXPECT_THAT(outcome.err, Not(ContainsRegex("[\r\x1b]"))) << "plain lines in a pipe";
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);) {
        if (line.find(out) == std::string::npos) {
            EXPECT_LE(line.size(), 80U) << line;
        }
    }
    EXPECT_THAT(bytes_of(out), HasSubstr("format binary_little_endian"));
    EXPECT_EQ(folder.num_entries(), 2U);
}

TEST_F(ProgramOnBall, PrintsAllStagesAndCountsIfVerbose)
{
    const Outcome outcome = run_program({"-v", ball, out});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, MatchesRegex("read +400 points \\(6 views, [0-9]+ rays\\) +[0-9.]+ s\n"
                                          "(.|\n)*"
                                          "orient +[0-9,]+ of [0-9,]+ rays on the outside.* s\n"
                                          "write +[0-9,]+ faces \\([0-9,]+ vertices\\) +[0-9.]+ s\n"
                                          "wrote (.|\n)*"));
}

/// Whether pseudo-terminals can be opened. A bare chroot has no /dev/pts.
bool has_pseudo_terminals()
{
    const int ours = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (ours < 0) return false;
    const char* const name = ::unlockpt(ours) == 0 ? ::ptsname(ours) : nullptr;
    const bool has = name != nullptr && std::filesystem::exists(name);
    ::close(ours);
    return has;
}

/// The output of the program on a terminal with this environment.
std::string shown_on_terminal(const std::string& environment,
                              const std::vector<std::string>& arguments)
{
    std::string line = "env -u NO_COLOR " + environment + " '" + built_program() + "'";
    for (const std::string& argument : arguments) {
        line += " '" + argument + "'";
    }
    return Subprocess({"/usr/bin/script", "-qec", line, "/dev/null"}).wait().out;
}

TEST_F(ProgramOnBall, PrintsBoldOnATerminalUnlessNoColorIsSet)
{
    if (!has_pseudo_terminals()) GTEST_SKIP() << "no pseudo-terminals: /dev/pts is not mounted";
    const auto shown = [&](const std::string& environment) {
        return shown_on_terminal(environment, {ball, out});
    };
    const std::string bold = "\x1b[1mwrote " + out + ": ";
    EXPECT_THAT(shown("TERM=xterm"), HasSubstr(bold));
    EXPECT_THAT(shown("TERM=xterm NO_COLOR="), HasSubstr(bold)) << "empty means unset";
    for (const char* plain : {"TERM=xterm NO_COLOR=1", "TERM=dumb"}) {
        EXPECT_THAT(shown(plain), AllOf(HasSubstr(out + ": "), Not(HasSubstr("\x1b["))));
    }
}

TEST_F(ProgramOnBall, CountsBoundaryEdges)
{
    ASSERT_EQ(run_program({ball, out, "--stats", stats, "--crop=-2,-2,-2,2,2,0.3"}).exit_code, 0);
    const auto record = nlohmann::json::parse(bytes_of(stats));
    const auto& stages = record["stages"];
    const auto orient =
        std::ranges::find_if(stages, [](const auto& stage) { return stage["name"] == "orient"; });
    ASSERT_NE(orient, stages.end());
    EXPECT_GT(record["mesh"]["boundary_edges"], 0);
    EXPECT_EQ((*orient)["counts"]["boundary edges"], record["mesh"]["boundary_edges"]);
}

TEST_F(ProgramOnBall, ContinuesIfItsLogCannotBeWritten)
{
    ASSERT_EQ(run_program({ball, out}).exit_code, 0);
    const std::string usual = bytes_of(out);
    for (const std::string to :
         {"2>/dev/full", "2>&-", ">&- 2>&- <&-", "2>&1 | true", "2>&1 | head -n 1"}) {
        std::filesystem::remove(out);
        std::vector<std::string> words = program_with({ball, out, "--verbose"});
        const std::string script = "\"$@\" " + to + "; exit ${PIPESTATUS[0]}";
        words.insert(words.begin(), {"/bin/bash", "-c", script, "bash"});
        EXPECT_EQ(Subprocess(words).wait().exit_code, 0) << to;
        EXPECT_EQ(bytes_of(out), usual) << to;
    }
}

TEST_F(ProgramOnBall, TreatsAFileSizeLimitAsAFullDisk)
{
    std::vector<std::string> words = program_with({ball, out, "--quiet"});
    words.insert(words.begin(), {"/bin/bash", "-c", "ulimit -f 1; exec \"$@\"", "bash"});
    EXPECT_EQ(sentence_of_run(2, Subprocess(words).wait()),
              "colmap-vcarve: cannot write " + out + ": File too large\n");
    EXPECT_EQ(folder.num_entries(), 1U) << "the model only";
}

TEST_F(ProgramOnBall, DropsPointsWithExcessiveCoordinatesWithANote)
{
    ASSERT_EQ(run_program({ball, out}).exit_code, 0);
    const std::string usual = bytes_of(out);
    const std::string points = bytes_of(ball + "/points3D.txt");
    folder.write("ball/points3D.txt", points + "9001 1e300 0 0 9 9 9 0.5 1 0 2 0 3 0\n"
                                               "9002 0 -1e160 0 9 9 9 0.5 1 0 2 0 3 0\n"
                                               "9003 0 0 2e100 9 9 9 0.5 1 0 2 0 3 0\n");
    for (const char* method : {"cut", "strict"}) {
        const Outcome outcome = run_program({ball, out, "--method", method});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("note: 3 of 403 points are dropped: a coordinate is "
                                           "not finite, or beyond 1e+100\n"));
        if (std::string(method) == "cut") {
            EXPECT_EQ(bytes_of(out), usual);
        }
    }
}

TEST_F(ProgramOnBall, WritesTextOnRequest)
{
    EXPECT_EQ(run_program({ball, out, "--ascii"}).exit_code, 0);
    EXPECT_THAT(bytes_of(out), HasSubstr("format ascii"));
}

TEST_F(ProgramOnBall, WritesTheSameBytesForAnyThreadCount)
{
    std::vector<std::string> written;
    for (const char* threads : {"0", "1", "2", "3"}) {
        EXPECT_EQ(run_program({ball, out, "--threads", threads}).exit_code, 0);
        written.push_back(bytes_of(out));
    }
    EXPECT_FALSE(written[0].empty());
    EXPECT_TRUE(std::ranges::all_of(written, [&](const auto& w) { return w == written[0]; }));
}

TEST_F(ProgramOnBall, RecordsTheRun)
{
    ASSERT_EQ(run_program({ball, out, "--stats", stats, "--min-views=1", "--method", "strict",
                           "--threads", "1"})
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
    EXPECT_EQ(record["schema"], 3);
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

TEST_F(ProgramOnBall, RejectsAModelThatNeedsTooMuchMemory)
{
    EXPECT_THAT(sentence_of(3, {"--quiet", ball, out, "--max-memory", "1M", "--closed"}),
                MatchesRegex("colmap-vcarve: .*ball: 400 points with [0-9]+ rays need about "
                             "[0-9.]+M of memory, and --max-memory allows 1M\n"));
    EXPECT_THAT(sentence_of(3, {"--quiet", ball, out, "--max-memory", "1M"}),
                HasSubstr("M of memory even in tiles, and --max-memory allows 1M\n"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ProgramOnBall, RespectsMaxMemoryIfPointsHaveManyCells)
{
    // Memory of libraries counts, too, and depends on the system. A small run measures it.
    ASSERT_EQ(run_program({ball, out, "--quiet", "--threads", "4", "--stats", stats}).exit_code, 0);
    [[maybe_unused]] const double program =
        nlohmann::json::parse(bytes_of(stats))["total"]["peak_memory_bytes"];
    std::filesystem::remove(out);
    // Points on two skew lines have 2,250,000 cells, which need about 160 MB in CGAL alone.
    std::string points;
    for (int i = 0; i < 3000; ++i) {
        const double along = (i / 2) / 1500.0 - 0.5;
        points += i % 2 == 0 ? fmt::format("{} {} 0 -0.3", i + 1, along)
                             : fmt::format("{} 0 {} 0.3", i + 1, along);
        points += " 1 2 3 0.5 1 0 3 0 5 0\n";
    }
    folder.write("ball/points3D.txt", points);
    [[maybe_unused]] constexpr double kMost = 70 << 20; // 80M less 10M for the program itself
    const Outcome outcome =
        run_program({"--quiet", ball, out, "--max-memory", "80M", "--threads", "4"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err,
                MatchesRegex("colmap-vcarve: .*ball: the points have more than [0-9]+ cells, "
                             "all that --max-memory allows, because many lie on few lines or "
                             "curves; raise --max-memory\n"));
#ifndef VCARVE_SANITIZED // sanitizers need additional memory
    EXPECT_LT(outcome.peak_memory_bytes - program, kMost);
#endif
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_THAT(
        sentence_of(3, {"--quiet", ball, out, "--max-memory", "80M", "--tile-points", "2000"}),
        HasSubstr("cells, all that --max-memory allows"));
}

TEST_F(ProgramOnBall, MakesTheSurfaceInTilesWithoutLeavingTheirFiles)
{
    const Outcome outcome = run_program({ball, out, "--tile-points", "120", "--check"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("4 of 4 tiles"));
    EXPECT_THAT(outcome.err, HasSubstr("wrote " + out));
    EXPECT_THAT(bytes_of(out), HasSubstr("comment option tile-points=120\n"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2)
        << "the model and the mesh";
}

TEST_F(ProgramOnBall, RejectsOptionsThatNeedTheModelInOnePiece)
{
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--closed"}, {"--crop", "auto"}, {"--smooth", "1"}}) {
        std::vector<std::string> all = {ball, out, "--tile-points", "120"};
        all.insert(all.end(), words.begin(), words.end());
        EXPECT_THAT(sentence_of(2, all), HasSubstr(words[0] + " needs the model in one piece"));
    }
}

TEST_F(ProgramOnBall, RejectsABinaryModelThatNeedsTooMuchMemoryBeforeReadingIt)
{
    // Reading this file would fail: the last byte of its only track is missing.
    const std::string count = std::string("\1\0\0\0\0\0\0\0", 8);
    folder.write("cut/cameras.bin", count);
    folder.write("cut/images.bin", count);
    folder.write("cut/points3D.bin", count + std::string(51 + 7, '\0'));
    EXPECT_THAT(sentence_of(3, {"--quiet", folder / "cut", out, "--max-memory", "1M"}),
                HasSubstr("1 points with 0 rays need about"));
}

TEST_F(ProgramOnBall, ReplacesAnEarlierMeshOnlyIfItSucceeds)
{
    folder.write("out.ply", "earlier");
    const Outcome failed = run_program({folder / "nothing", out});
    EXPECT_EQ(failed.exit_code, 3);
    EXPECT_EQ(bytes_of(out), "earlier");
    EXPECT_EQ(run_program({ball, out}).exit_code, 0);
    EXPECT_THAT(bytes_of(out), HasSubstr("element face"));
}

TEST_F(ProgramOnBall, NotesTheSubtractedOffset)
{
    write_ball_model(ball, 400, {5e5, 4.6e6, 1.0});
    const Outcome outcome = run_program({ball, out, "--offset", "auto", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err,
                HasSubstr("output coordinates are those of the model minus 500000, 4600000, 0\n"));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["offset"], nlohmann::json::parse("[500000.0, 4600000.0, 0.0]"));
    EXPECT_EQ(sentence_of(2, {ball, out, "--offset", "5e5,4.6e6"}),
              "colmap-vcarve: --offset takes none, auto or x,y,z, not \"5e5,4.6e6\"\n");
}

TEST_F(ProgramOnBall, TransformsCoordinatesBeforeSubtractingTheOffset)
{
    EXPECT_EQ(run_program({ball, out}).exit_code, 0);
    const TriMesh plain = read_ply(out);
    const std::string file = folder.write("sim3.txt", "2 0 0 0 1 500000 0 0"); // half a turn
    const Outcome outcome =
        run_program({ball, out, "--transform", file, "--offset", "auto", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("output coordinates are those of the model transformed by " +
                                       file + "\n"));
    EXPECT_THAT(outcome.err, HasSubstr("of the model, transformed, minus 500000, 0, 0\n"));
    EXPECT_THAT(bytes_of(out), HasSubstr("comment transform 2 0 0 0 1 500000 0 0\n"));
    const TriMesh moved = read_ply(out);
    ASSERT_EQ(moved.positions.size(), plain.positions.size());
    EXPECT_EQ(moved.faces, plain.faces);
    EXPECT_EQ(moved.offset, Eigen::Vector3d(500000, 0, 0));
    for (std::size_t i = 0; i < moved.positions.size(); ++i) {
        const Eigen::Vector3d& p = plain.positions[i];
        EXPECT_LT((moved.positions[i] - Eigen::Vector3d(-2, -2, 2).cwiseProduct(p)).norm(), 1e-9);
        const Eigen::Vector3f& n = plain.normals[i];
        EXPECT_LT((moved.normals[i] - Eigen::Vector3f(-1, -1, 1).cwiseProduct(n)).norm(), 1e-6F);
    }
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["transform"], "2 0 0 0 1 500000 0 0");
    EXPECT_EQ(record["options"]["transform"], file);
    EXPECT_NEAR(record["mesh"]["area"], 4.0 * 4.0 * std::numbers::pi, 1.0);
}

TEST_F(ProgramOnBall, RotatesCoordinatesUpright)
{
    ASSERT_EQ(run_program({ball, out, "--quiet"}).exit_code, 0);
    const TriMesh plain = read_ply(out);
    const Outcome outcome =
        run_program({ball, out, "--upright", "--up", "0,-2,0", "--transform", "3"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("those of the model transformed by 3, rotated so that z is "
                                       "up\n"));
    const TriMesh turned = read_ply(out);
    ASSERT_EQ(turned.positions.size(), plain.positions.size());
    for (std::size_t i = 0; i < plain.positions.size(); ++i) {
        const Eigen::Vector3d& p = plain.positions[i];
        EXPECT_LT((turned.positions[i] - 3.0 * Eigen::Vector3d(p.x(), p.z(), -p.y())).norm(), 1e-9);
    }
    EXPECT_THAT(bytes_of(out), HasSubstr("comment transform 3 "));
    EXPECT_EQ(sentence_of(2, {ball, out, "--upright", "--up", "none"}),
              "colmap-vcarve: --upright needs an up direction, but --up is none\n");
}

/// Writes a model of a floor and three images from 5 above it, straight down with equal heading.
void write_pictures_from_above(const TemporaryFolder& folder)
{
    std::string images;
    std::string points;
    for (int image = 1; image <= 3; ++image) {
        images += fmt::format("{} 1 0 0 0 {} 0 0 1 {}.jpg\n", image, 2 - image, image);
        for (int point = 0; point < 25; ++point) {
            const int x = 50 + 20 * (point % 5 - image);
            images += fmt::format("{} {} {} ", x, 50 + 20 * (point / 5 - 2), point + 1);
        }
        images += "\n";
    }
    for (int point = 0; point < 25; ++point) {
        points += fmt::format("{} {} {} {} 0 0 0 0.5 1 {} 2 {} 3 {}\n", point + 1, point % 5 - 2,
                              point / 5 - 2, point % 3 == 1 ? 4.8 : 5.0, point, point, point);
    }
    folder.write("above/cameras.txt", "1 PINHOLE 200 200 100 100 100 100\n");
    folder.write("above/images.txt", images);
    folder.write("above/points3D.txt", points);
}

TEST_F(ProgramOnBall, NotesTheUpDirectionIfAllCamerasLookOneWay)
{
    write_pictures_from_above(folder);
    const std::string above = folder / "above";
    const std::string glb = folder / "out.glb";
    EXPECT_THAT(run_program({above, glb}).err,
                HasSubstr("all cameras look one way, so the top of their images is used as up, "
                          "direction 0.00, -1.00, 0.00; if they look straight down, use --up "
                          "back\n"));
    EXPECT_THAT(run_program({above, glb, "--up", "back"}).err, Not(HasSubstr("one way")));
    EXPECT_THAT(bytes_of(glb), HasSubstr("\"up\":[0.0,0.0,-1.0]"));
    EXPECT_THAT(run_program({above, out}).err, Not(HasSubstr("one way"))) << "PLY has no up";
    EXPECT_THAT(run_program({ball, glb}).err, Not(HasSubstr("one way")));
}

TEST_F(ProgramOnBall, RejectsAReflectionAndReplacingTheTransformation)
{
    const std::string mirror = folder.write("mirror.ply", "1 0 0 0 0 1 0 0 0 0 -1 0");
    EXPECT_EQ(sentence_of(3, {ball, out, "--transform", mirror}),
              "colmap-vcarve: " + mirror +
                  ": the transformation is a reflection, which turns "
                  "surfaces inside out, expected a rotation with a scale and a translation\n");
    EXPECT_EQ(sentence_of(2, {ball, mirror, "--transform", mirror}),
              "colmap-vcarve: the mesh would replace the transformation " + mirror + "\n");
}

TEST_F(ProgramOnBall, WarnsOfFloatsFarFromTheOrigin)
{
    write_ball_model(ball, 400, {5e5, 4.6e6, 1.0});
    const std::string stl = folder / "out.stl";
    EXPECT_THAT(run_program({ball, stl}).err,
                ContainsRegex("32-bit floats in [^ ]*out.stl move vertices by up "
                              "to [0-9.]+e-02 of the mesh's size; "
                              "use --offset auto\n"));
    EXPECT_THAT(run_program({ball, stl, "--offset", "auto"}).err, Not(HasSubstr("floats")));
}

} // namespace
} // namespace vcarve::mesh_command_run_test
