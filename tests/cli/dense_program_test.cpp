#include "io/ply/ply_file.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace vcarve::dense_program_test {
namespace {

using ::testing::HasSubstr;

const std::string kModel = fixtures_folder() / "desk_photos/sparse";

TEST(DenseProgram, WritesTheSameMeshForAnyThreadCountAndKeepsPoints)
{
    const TemporaryFolder folder;
    const std::string one = folder / "one.ply";
    const std::string two = folder / "two.ply";
    const std::string points = folder / "points.ply";
    const std::string page = folder / "page.html";
    const Outcome outcome = run_program({kModel, one, "--dense", "--dense-size", "160", "--threads",
                                         "1", "--keep-points", points, "--report", page});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("12 depth maps"));
    ASSERT_EQ(
        run_program({kModel, two, "--dense", "--dense-size", "160", "--threads", "2", "--quiet"})
            .exit_code,
        0);
    EXPECT_EQ(bytes_of(one), bytes_of(two));
    EXPECT_THAT(bytes_of(page), HasSubstr(R"("depth":{"name":"view_)"));

    const std::string visibility = bytes_of(points + ".vis");
    std::uint64_t rows = 0;
    ASSERT_GE(visibility.size(), sizeof rows);
    std::memcpy(&rows, visibility.data(), sizeof rows);
    EXPECT_EQ(rows, read_ply_header(points).find("vertex")->count);
    const std::string again = folder / "again.ply";
    EXPECT_EQ(run_program({kModel, again, "--points", points, "--quiet"}).exit_code, 0)
        << "other runs can use the points";
}

TEST(DenseProgram, RejectsOptionsThatNeedDense)
{
    const TemporaryFolder folder;
    const std::string out = folder / "out.ply";
    EXPECT_EQ(sentence_of(2, {kModel, out, "--dense-size", "200"}),
              "colmap-vcarve: --dense-size needs --dense\n");
    EXPECT_EQ(sentence_of(2, {kModel, out, "--keep-points", folder / "p.ply"}),
              "colmap-vcarve: --keep-points needs --dense\n");
    EXPECT_EQ(sentence_of(2, {kModel, out, "--dense", "--points", "dense"}),
              "colmap-vcarve: --dense and --points both supply dense points; remove one of them\n");
    const std::string obj = folder / "p.obj";
    EXPECT_EQ(sentence_of(2, {kModel, out, "--dense", "--keep-points", obj}),
              "colmap-vcarve: cannot write " + obj + ": --keep-points needs .ply\n");
}

TEST(DenseProgram, RejectsAModelWithoutPhotographs)
{
    const TemporaryFolder folder;
    EXPECT_THAT(sentence_of(2, {fixtures_folder() / "air", folder / "out.ply", "--dense"}),
                HasSubstr("found no folder `images`"));
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(DenseProgram, SimplifiesTheRefinedSurfaceToANumberOfFaces)
{
    const TemporaryFolder folder;
    const std::string out = folder / "out.ply";
    ASSERT_EQ(run_program({kModel, out, "--dense", "--dense-size", "160", "--refine-size", "160",
                           "--simplify", "1500", "--images",
                           fixtures_folder() / "desk_photos/images", "--quiet"})
                  .exit_code,
              0);
    // Coloring divides faces that photographs show in part.
    EXPECT_LT(read_ply(out).faces.size(), 3000U);
    EXPECT_GT(read_ply(out).faces.size(), 1000U);
}

TEST(DenseProgram, RejectsRunsAboveTheMemoryLimit)
{
    const TemporaryFolder folder;
    EXPECT_THAT(sentence_of(3, {kModel, folder / "out.ply", "--dense", "--max-memory", "20M"}),
                HasSubstr("but the limit is"));
    EXPECT_EQ(folder.num_entries(), 0U);
}

} // namespace
} // namespace vcarve::dense_program_test
