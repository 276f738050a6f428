#include "cli/input_output.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::cli::input_output_test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;

/// A project with a dense workspace in "p/dense", and a photograph that its model tells of.
class KeepInputs : public ::testing::Test {
  protected:
    KeepInputs()
    {
        write_ball_model(dense / "sparse", 30);
        for (const char* name :
             {"fused.ply", "fused.ply.vis", "images/a.png", "stereo/fusion.cfg"}) {
            folder.write(std::string("p/dense/") + name, "precious");
        }
        folder.write("p/shots/+z.jpg", "precious");
        folder.write("p/database.db", "precious");
        fs::copy_file(dense / "fused.ply", folder / "p/other.ply");
    }

    /// What is said of an output; empty where it may be written.
    std::string refused(const fs::path& out, const PointsOptions& options = {}) const
    {
        const std::vector<Output> outputs = {{"--stats", folder / "new.json"},
                                             {"the surface", out}};
        const std::string said = refusal<UsageError>([&] {
            keep_inputs(outputs, {{.points = options, .scanner = {}}, dense}, {});
        });
        return said == "no exception" ? "" : said;
    }

    TemporaryFolder folder;
    fs::path dense = folder / "p/dense";
};

TEST_F(KeepInputs, RefusesWhateverTheWorkspaceHolds)
{
    for (const char* name : {"fused.ply", "fused.ply.vis", "images/a.png", "stereo/fusion.cfg",
                             "sparse/images.txt", "sparse/points3D.txt"}) {
        const std::string path = dense / name;
        EXPECT_EQ(refused(path), "the surface would replace the input " + path);
    }
    EXPECT_THAT(refused(dense / "fused.ply", {.points = "sparse"}), EndsWith("fused.ply"));
    EXPECT_THAT(refused(folder / "p/database.db"), EndsWith("database.db"));
    EXPECT_EQ(refused(folder / "p/shots/+z.jpg"),
              "the surface would replace the image " + (folder / "p/shots/+z.jpg").string());
}

TEST_F(KeepInputs, RefusesOtherPathsAndLinksToTheSameFile)
{
    EXPECT_THAT(refused(dense / "sparse/.././fused.ply"), EndsWith("fused.ply"));
    fs::create_symlink(dense / "fused.ply", folder / "soft.ply");
    EXPECT_THAT(refused(folder / "soft.ply"), EndsWith("fused.ply"));
    fs::create_hard_link(dense / "fused.ply", folder / "hard.ply");
    EXPECT_THAT(refused(folder / "hard.ply"), EndsWith("fused.ply"));
    fs::create_directory_symlink(dense, folder / "way");
    EXPECT_THAT(refused(folder / "way/images/a.png"), EndsWith("a.png"));
}

TEST_F(KeepInputs, RefusesTheCloudThatIsNamed)
{
    const fs::path other = folder / "p/other.ply";
    EXPECT_EQ(refused(other), "");
    EXPECT_THAT(refused(other, {.points = other, .sights = SightsFrom::nearest}),
                EndsWith("other.ply"));
    const fs::path mine = folder.write("mine.vis", "precious");
    EXPECT_THAT(refused(mine, {.points = other, .visibility = mine}), EndsWith("mine.vis"));
}

TEST_F(KeepInputs, LetsEarlierOutputsBeReplaced)
{
    for (const char* name : {"sparse/mesh.ply", "mesh.ply", "sparse/preview.png"}) {
        EXPECT_EQ(refused(folder.write(std::string("p/dense/") + name, "")), "");
    }
}

TEST_F(KeepInputs, IsAskedOfEveryOutputOfARun)
{
    const std::string model = dense / "sparse";
    const std::string points = dense / "sparse/points3D.txt";
    const std::string region = folder.write("region.txt", "-1 -1\n1 -1\n0 1\n");
    const std::string bytes = bytes_of(points);
    const auto run = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {model, folder / "out.ply"});
        return sentence_of(2, more);
    };
    EXPECT_THAT(run({"--stats", points}),
                EndsWith("--stats would replace the input " + points + "\n"));
    const std::string photo = dense / "images/a.png";
    EXPECT_THAT(run({"--preview", photo}),
                EndsWith("--preview would replace the input " + photo + "\n"));
    EXPECT_THAT(run({"--crop", region, "--stats", region}),
                EndsWith("--stats would replace the region " + region + "\n"));
    fs::create_symlink(points, folder / "r.html");
    EXPECT_THAT(run({"--report", folder / "r.html"}),
                EndsWith("--report would replace the input " + points + "\n"));
    const std::string truth = folder / "p/other.ply";
    EXPECT_THAT(sentence_of(2, {"compare", model, truth, "--json", points}),
                EndsWith("--json would replace the input " + points + "\n"));
    EXPECT_EQ(bytes_of(points), bytes);
}

TEST(RequireDistinct, KnowsAFileByAnotherPath)
{
    const TemporaryFolder folder;
    const std::vector<Output> outputs = {{"a", folder / "x.ply"}, {"b", folder.path() / "./x.ply"}};
    EXPECT_THAT(refusal<UsageError>([&] { require_distinct(outputs); }),
                ::testing::StartsWith("b and a cannot both be written to "));
}

} // namespace
} // namespace vcarve::cli::input_output_test
