// Dense workspaces, given to the program as the user gives them.
#include "io/colmap/colmap_model.h"
#include "support/ball_model.h"
#include "support/dense_workspace.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace vcarve::mesh_command_dense_test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

/// A workspace of a ball: 300 sparse points, and 600 dense ones with normals.
class ProgramOnDenseBall : public ::testing::Test {
  protected:
    ProgramOnDenseBall()
    {
        write_ball_model(folder / "dense/sparse", 300);
        write_ball_model(folder / "more", 600);
        cloud = read_colmap_model(folder / "more", ModelFormat::text);
        for (const Eigen::Vector3d& position : cloud.positions) {
            cloud.normals.emplace_back(position.cast<float>());
        }
        write_cloud(CloudEncoding::binary);
        folder.write("dense/fused.ply.vis", visibility_bytes(cloud.tracks));
    }

    void write_cloud(CloudEncoding encoding) const
    {
        folder.write("dense/fused.ply", cloud_bytes(cloud, encoding));
    }

    std::string bytes_made_of(const std::vector<std::string>& input) const
    {
        std::vector<std::string> arguments = input;
        arguments.insert(arguments.end(), {out, "--quiet"});
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return bytes_of(out);
    }

    /// What compare says the mesh is measured against, and no figures.
    std::string measured_against(const std::vector<std::string>& input) const
    {
        std::vector<std::string> arguments = {"compare", "--quiet"};
        arguments.insert(arguments.end(), input.begin(), input.end());
        const std::string printed = run_program(arguments).out;
        const std::size_t begin = printed.find("Measured against");
        return begin == std::string::npos ? printed : printed.substr(begin, 30);
    }

    TemporaryFolder folder;
    Scene cloud;
    std::string dense = folder / "dense";
    std::string fused = folder / "dense/fused.ply";
    std::string out = folder / "out.ply";
};

TEST_F(ProgramOnDenseBall, MeshesTheDensePointsAndSaysSo)
{
    const std::string stats = folder / "stats.json";
    const Outcome outcome = run_program({dense, out, "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, StartsWith("note: the points are those of " + fused));
    EXPECT_THAT(outcome.err, HasSubstr("\nread         600 points, 6 views, "));
    const auto input = nlohmann::json::parse(bytes_of(stats))["input"];
    EXPECT_EQ(input["cloud"], fused);
    EXPECT_EQ(input["folder"], dense + "/sparse");
    EXPECT_EQ(input["points"], 600);
}

TEST_F(ProgramOnDenseBall, MeshesTheSparsePointsOnRequest)
{
    const std::string sparse = bytes_made_of({dense + "/sparse"});
    EXPECT_TRUE(bytes_made_of({dense, "--points", "sparse"}) == sparse);
    EXPECT_FALSE(bytes_made_of({dense}) == sparse);
}

TEST_F(ProgramOnDenseBall, MakesTheSameBytesOfTextAndOfTheCloudNamedAnyWay)
{
    const std::string made = bytes_made_of({dense});
    EXPECT_TRUE(bytes_made_of({fused}) == made);
    EXPECT_TRUE(bytes_made_of({dense, "--points", "dense"}) == made);
    const auto other = folder.write("other.ply", cloud_bytes(cloud, CloudEncoding::ascii));
    const std::string named =
        bytes_made_of({dense + "/sparse", "--points", other, "--visibility", fused + ".vis"});
    EXPECT_TRUE(named == made);
    write_cloud(CloudEncoding::ascii);
    EXPECT_TRUE(bytes_made_of({dense}) == made);
}

TEST_F(ProgramOnDenseBall, MeshesACloudWithoutAFileByTheNearestViews)
{
    std::filesystem::remove(fused + ".vis");
    const Outcome outcome = run_program({dense, out, "--sights", "nearest"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no file tells which views saw them"));
    EXPECT_THAT(outcome.err, HasSubstr("\nread         600 points, 6 views, "));
    EXPECT_EQ(run_program({fused, out}).exit_code, 3);
    EXPECT_EQ(run_program({dense, out, "--sights", "nearest", "--points", "sparse"}).exit_code, 0);
}

TEST_F(ProgramOnDenseBall, DropsAPointThatIsNotFinite)
{
    cloud.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
    write_cloud(CloudEncoding::binary);
    EXPECT_THAT(run_program({dense, out}).err,
                HasSubstr("493 of 600 points kept, 106 of few views, 1 not finite"));
}

TEST_F(ProgramOnDenseBall, RefusesBrokenInputWithASentenceAndLeavesNothing)
{
    folder.write("dense/fused.ply.vis", std::string(8, '\0'));
    const Outcome outcome = run_program({dense, out});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("colmap-vcarve: " + fused + ".vis: tells of 0 points, but " +
                                       fused + " has 600; "));
    EXPECT_THAT(outcome.err, ::testing::EndsWith("(--crop cuts a part out of the whole)\n"));
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(run_program({fused, out, "--points", "sparse"}).exit_code, 2);
}

TEST_F(ProgramOnDenseBall, RefusesWhatNeedsTooMuchMemoryBeforeItIsRead)
{
    const Outcome outcome = run_program({dense, out, "--max-memory", "1M"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("dense: 600 points with "));
    EXPECT_THAT(outcome.err, Not(HasSubstr("\nread ")));
}

TEST_F(ProgramOnDenseBall, IsMeasuredByTheDensePoints)
{
    bytes_made_of({dense});
    // Of all points those that two views saw.
    EXPECT_THAT(measured_against({dense, out}), StartsWith("Measured against 493 points "));
    EXPECT_THAT(measured_against({dense, out, "--points", "sparse"}),
                StartsWith("Measured against 247 points "));
}

TEST_F(ProgramOnDenseBall, IsComparedWithWhatColmapMakesOfTheWorkspace)
{
    const auto words = folder / "words.txt";
    const auto script =
        folder.write("mesher", "#!/bin/sh\necho \"$@\" > '" + words.string() + "'; exit 1\n");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const std::string colmap = script.string();
    const Outcome outcome = run_program({"compare", dense, "--colmap", colmap});
    EXPECT_THAT(bytes_of(words), StartsWith("delaunay_mesher --input_type dense --input_path " +
                                            dense + " --output_path "));
    EXPECT_THAT(outcome.out, MatchesRegex("\\| +\\| colmap-vcarve \\|\n(.|\n)*"));
    EXPECT_THAT(outcome.out, HasSubstr("\nMeasured against 493 points "));
    run_program({"compare", dense, "--points", "sparse", "--colmap", colmap});
    EXPECT_THAT(bytes_of(words), StartsWith("delaunay_mesher --input_type sparse --input_path " +
                                            dense + "/sparse --output_path "));
    const Outcome other =
        run_program({"compare", dense + "/sparse", "--points", fused, "--colmap", colmap});
    EXPECT_THAT(other.out, HasSubstr("\nMeasured against 493 points "));
}

TEST_F(ProgramOnDenseBall, IsNotComparedWithColmapWhereThatCannotBeToldOfThePoints)
{
    std::filesystem::rename(fused, folder / "dense/other.ply");
    const Outcome outcome = run_program({"compare", dense, "--points", folder / "dense/other.ply",
                                         "--visibility", fused + ".vis", "--colmap", "colmap"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "colmap-vcarve: --colmap cannot be told to take the points of " + dense +
                               "/other.ply: COLMAP's mesher reads fused.ply, fused.ply.vis and "
                               "sparse in one folder\n");
}

} // namespace
} // namespace vcarve::mesh_command_dense_test
