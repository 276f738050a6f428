#include "support/ball_model.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vcarve::mesh_command_crop_test {
namespace {

using ::testing::ContainsRegex;

class CropOfScene : public ::testing::Test {
  protected:
    Outcome run(const std::vector<std::string>& words) const
    {
        std::vector<std::string> all = {scene, out};
        all.insert(all.end(), words.begin(), words.end());
        return run_program(all);
    }
    /// Expects the program to fail with this code and to leave nothing behind, and gives its
    /// sentence.
    std::string sentence_of(int exit_code, const std::string& crop) const
    {
        const Outcome outcome = run({"--quiet", "--crop", crop});
        EXPECT_EQ(outcome.exit_code, exit_code);
        EXPECT_FALSE(std::filesystem::exists(out));
        return outcome.err;
    }

    TemporaryFolder folder;
    std::string scene = (fixtures_folder() / "scene/sparse/0").string();
    std::string out = folder / "out.ply";
    std::string stats = folder / "stats.json";
};

TEST_F(CropOfScene, IsCountedAndRecorded)
{
    const Outcome outcome = run({"--crop=auto", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("crop +[0-9,]+ of [0-9,]+ points in the region"));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["options"]["crop"], "auto");
    EXPECT_EQ(record["stages"][4]["name"], "crop");
    const auto& counts = record["stages"][4]["counts"];
    EXPECT_LT(counts["points"], counts["of points"]);
    EXPECT_GT(counts["points"].get<double>(), 0.85 * counts["of points"].get<double>());
}

TEST_F(CropOfScene, ToABoxLeavesWhatLiesInIt)
{
    ASSERT_EQ(run({"--quiet"}).exit_code, 0);
    const TriMesh all = read_ply(out);
    Eigen::AlignedBox3d half;
    for (const Eigen::Vector3d& position : all.positions) {
        half.extend(position);
    }
    half.max() = half.center();
    ASSERT_EQ(
        run({"--quiet", "--stats", stats,
             fmt::format("--crop={},{}", fmt::join(half.min(), ","), fmt::join(half.max(), ","))})
            .exit_code,
        0);
    const TriMesh cropped = read_ply(out);
    EXPECT_GT(cropped.faces.size(), 100U);
    for (const Eigen::Vector3d& position : cropped.positions) {
        ASSERT_TRUE(half.contains(position));
    }
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["options"]["crop"].size(), 6U);
    EXPECT_EQ(record["options"]["crop"][3], half.max().x());
}

TEST_F(CropOfScene, TakesASurfaceOrAPolygonOfAFile)
{
    ASSERT_EQ(run({"--quiet", "--closed"}).exit_code, 0);
    const std::string region = folder / "Region.PLY";
    std::filesystem::rename(out, region);
    EXPECT_EQ(run({"--quiet", "--crop", region}).exit_code, 0);
    EXPECT_GT(read_ply(out).faces.size(), 1000U);

    const std::string corners = folder.write("corners.txt", "-1e3 -1e3\n1e3 -1e3\n0 1e3\n");
    EXPECT_EQ(run({"--quiet", "--crop", corners, "--stats", stats}).exit_code, 0);
    EXPECT_GT(read_ply(out).faces.size(), 1000U);
    EXPECT_EQ(nlohmann::json::parse(bytes_of(stats))["options"]["crop"], corners);
}

TEST_F(CropOfScene, IsRefusedWithOneSentence)
{
    EXPECT_EQ(sentence_of(2, "0,0,0,1,1"), "colmap-vcarve: --crop takes none, auto, "
                                           "x0,y0,z0,x1,y1,z1 or a file, not \"0,0,0,1,1\"\n");
    EXPECT_EQ(sentence_of(2, "0,0,0,1,1,0"),
              "colmap-vcarve: --crop takes a box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and "
              "z0 < z1, not 0,0,0,1,1,0\n");
    EXPECT_EQ(sentence_of(3, "gone.txt"), "colmap-vcarve: gone.txt: the file does not exist\n");
    EXPECT_EQ(sentence_of(3, "gone.ply"), "colmap-vcarve: gone.ply: the file does not exist\n");
    const std::string corners = folder.write("corners.txt", "1 2\n3\n");
    EXPECT_EQ(sentence_of(3, corners),
              "colmap-vcarve: " + corners +
                  ": line 2: the line ends where the y of a corner should stand\n");
}

TEST_F(CropOfScene, IsRefusedWhereNoPointLies)
{
    scene = folder / "ball";
    write_ball_model(scene, 400);
    EXPECT_THAT(sentence_of(3, "5,5,5,6,6,6.5"),
                ::testing::MatchesRegex(
                    "colmap-vcarve: " + scene +
                    ": no point lies within the region of --crop \\(x 5 to 6, y 5 to 6, z 5 to "
                    "6\\.5\\); the points lie in x -0\\.9[0-9]+ to 0\\.9[0-9]+, y "
                    "-0\\.9[0-9]+ to 0\\.9[0-9]+, z -0\\.9425 to 0\\.9425\n"));
}

} // namespace
} // namespace vcarve::mesh_command_crop_test
