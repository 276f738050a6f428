#include "cli/input_output.h"
#include "io/formats/output_frame.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::cli::input_output_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3f;
using ::testing::EndsWith;

/// A project with a dense workspace in "p/dense", and a photograph that its model names.
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

    /// The error message for an output; empty if it may be written.
    std::string refused(const fs::path& out, const PointsOptions& options = {}) const
    {
        const std::vector<Output> outputs = {{"--stats", folder / "new.json"}, {"the mesh", out}};
        const std::string said = refusal<UsageError>([&] {
            const RunInput input = {.path = dense, .found = find_input(dense, options)};
            keep_inputs(outputs, input, {});
        });
        return said == "no exception" ? "" : said;
    }

    TemporaryFolder folder;
    fs::path dense = folder / "p/dense";
};

TEST_F(KeepInputs, RejectsAnyFileOfTheWorkspace)
{
    for (const char* name : {"fused.ply", "fused.ply.vis", "images/a.png", "stereo/fusion.cfg",
                             "sparse/images.txt", "sparse/points3D.txt"}) {
        const std::string path = dense / name;
        EXPECT_EQ(refused(path), "the mesh would replace the input " + path);
    }
    EXPECT_THAT(refused(dense / "fused.ply", {.points = "sparse"}), EndsWith("fused.ply"));
    EXPECT_THAT(refused(folder / "p/database.db"), EndsWith("database.db"));
    EXPECT_EQ(refused(folder / "p/shots/+z.jpg"),
              "the mesh would replace the image " + (folder / "p/shots/+z.jpg").string());
}

TEST_F(KeepInputs, RejectsOtherPathsAndLinksToAnInput)
{
    EXPECT_THAT(refused(dense / "sparse/.././fused.ply"), EndsWith("fused.ply"));
    fs::create_symlink(dense / "fused.ply", folder / "soft.ply");
    EXPECT_THAT(refused(folder / "soft.ply"), EndsWith("fused.ply"));
    fs::create_hard_link(dense / "fused.ply", folder / "hard.ply");
    EXPECT_THAT(refused(folder / "hard.ply"), EndsWith("fused.ply"));
    fs::create_directory_symlink(dense, folder / "way");
    EXPECT_THAT(refused(folder / "way/images/a.png"), EndsWith("a.png"));
}

TEST_F(KeepInputs, RejectsTheGivenCloud)
{
    const fs::path other = folder / "p/other.ply";
    EXPECT_EQ(refused(other), "");
    EXPECT_THAT(refused(other, {.points = other, .rays = RaysFrom::nearest}),
                EndsWith("other.ply"));
    const fs::path mine = folder.write("mine.vis", "precious");
    EXPECT_THAT(refused(mine, {.points = other, .visibility = mine}), EndsWith("mine.vis"));
}

TEST_F(KeepInputs, AllowsReplacingEarlierOutputs)
{
    for (const char* name : {"sparse/mesh.ply", "mesh.ply", "sparse/preview.png"}) {
        EXPECT_EQ(refused(folder.write(std::string("p/dense/") + name, "")), "");
    }
}

TEST_F(KeepInputs, ChecksEveryOutputOfARun)
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

TEST(RequireDistinct, DetectsTheSameFileByAnotherPath)
{
    const TemporaryFolder folder;
    const std::vector<Output> outputs = {{"a", folder / "x.ply"}, {"b", folder.path() / "./x.ply"}};
    EXPECT_THAT(refusal<UsageError>([&] { require_distinct(outputs); }),
                ::testing::StartsWith("b and a cannot both be written to "));
}

TEST(TransformOf, AcceptsAScaleOrAFile)
{
    EXPECT_FALSE(transform_of("", {}));
    EXPECT_EQ(transform_of("0.25", {})->linear, 0.25 * Eigen::Matrix3d::Identity());
    EXPECT_EQ(transform_of("0.25", {})->scale, 0.25);
    const TemporaryFolder folder;
    EXPECT_EQ(transform_of(folder.write("2", "1 1 0 0 0 5 6 7"), {})->translation,
              Vector3d(5, 6, 7));
    for (const char* const text : {"0", "-2", "nan", "inf", "1e999"}) {
        EXPECT_EQ(refusal<UsageError>([&] { transform_of(text, {}); }),
                  "--transform takes a file or a scale above 0, not \"" + std::string(text) + "\"");
    }
    EXPECT_NE(refusal<InputError>([] { transform_of("2m", {}); }).find("2m"), std::string::npos);
}

TEST(TransformOf, TransformsTheModelToTheFrameOfNerfstudio)
{
    const TemporaryFolder folder;
    const std::string file =
        folder.write("dataparser_transforms.json",
                     R"({"transform": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]], "scale": 2})");
    write_ball_model(folder / "sparse/0", 20);
    const FoundModel colmap = find_input(folder / "sparse/0", {}).model;
    EXPECT_EQ(transform_of(file, colmap)->translation, Vector3d(2, 4, 6));
    const std::string transforms = folder.write(
        "transforms.json",
        R"({"frames": [{}], "applied_transform": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]]})");
    folder.write("sparse_pc.ply", "ply\n");
    EXPECT_EQ(transform_of(file, find_input(transforms, {}).model)->translation, Vector3d(0, 2, 4));
}

TEST(OffsetFor, RoundsTheOffsetAfterTheTransformation)
{
    Scene scene;
    for (int i = 0; i < 27; ++i) {
        scene.positions.emplace_back(i % 3, i / 3 % 3, i / 9);
    }
    const WordOrVector automatic = {.word = static_cast<int>(OffsetWord::automatic)};
    EXPECT_EQ(offset_for(scene, automatic, std::nullopt), Vector3d(0, 0, 0));
    Similarity far;
    far.translation = {500'000.0, 0, 0};
    EXPECT_EQ(offset_for(scene, automatic, far), Vector3d(500'000, 0, 0));
    const WordOrVector given = {.word = WordOrVector::kNoWord, .vector = {1, 2, 3}};
    EXPECT_EQ(offset_for(scene, given, far), Vector3d(1, 2, 3));
    EXPECT_EQ(offset_for(scene, {}, far), Vector3d(0, 0, 0));
}

WordOrVector word(UpWord up)
{
    return {.word = static_cast<int>(up)};
}

TEST(UpFor, ReturnsADirectionInTheOutputFrame)
{
    Scene scene = make_scene({{0, 0, 0}}, {});
    Similarity quarter; // around x: maps -y to -z
    quarter.scale = 2.0;
    quarter.linear << 2, 0, 0, 0, 0, -2, 0, 2, 0;
    EXPECT_EQ(up_for(scene, word(UpWord::automatic), std::nullopt), Vector3d(0, -1, 0));
    EXPECT_EQ(up_for(scene, word(UpWord::automatic), quarter), Vector3d(0, 0, -1));
    EXPECT_EQ(up_for(scene, word(UpWord::back), std::nullopt), Vector3d(0, 0, -1));
    EXPECT_EQ(up_for(scene, word(UpWord::back), quarter), Vector3d(0, 1, 0));
    EXPECT_EQ(up_for(scene, word(UpWord::z), quarter), Vector3d(0, 0, 1));
    EXPECT_EQ(up_for(scene, word(UpWord::none), quarter), Vector3d(0, 0, 0));
    const WordOrVector given = {.word = WordOrVector::kNoWord, .vector = {0, 3e-200, -4e-200}};
    EXPECT_TRUE(up_for(scene, given, quarter).isApprox(Vector3d(0, 0.6, -0.8), 1e-15));
    const WordOrVector nowhere = {.word = WordOrVector::kNoWord};
    EXPECT_THROW(up_for(scene, nowhere, quarter), UsageError);
}

TEST(TurnedUpright, RotatesUpToZAfterATransformation)
{
    Similarity moved;
    moved.scale = 2.0;
    moved.linear *= 2.0;
    moved.translation = {0, 5, 0};
    const Similarity turned = turned_upright(moved, Vector3d::UnitY());
    const Vector3d place = turned.linear * Vector3d(0, 1, 0) + turned.translation;
    EXPECT_TRUE(place.isApprox(Vector3d(0, 0, 7), 1e-15)) << place.transpose();
    EXPECT_EQ(turned.scale, 2.0);
    const Similarity alone = turned_upright(std::nullopt, -Vector3d::UnitZ());
    EXPECT_TRUE((alone.linear * Vector3d(0, 0, -1)).isApprox(Vector3d::UnitZ(), 1e-15));
    EXPECT_NEAR(alone.linear.determinant(), 1.0, 1e-15) << "a rotation, not a reflection";
}

TEST(Transformed, RotatesNormalsWithoutScalingThem)
{
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 1, 2}};
    mesh.normals = {{1, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    mesh.offset = {0, 0, 4};
    Similarity to; // a quarter turn around z, ten times as large
    to.scale = 10.0;
    to.linear << 0, -10, 0, 10, 0, 0, 0, 0, 10;
    to.translation = {1, 1, 1};
    const TriMesh moved = transformed(mesh, to);
    EXPECT_EQ(moved.positions, (std::vector<Vector3d>{{0, 10, 0}, {-10, 0, 0}, {0, 0, 10}}));
    EXPECT_EQ(moved.offset, Vector3d(1, 1, 41));
    EXPECT_EQ(moved.normals, (std::vector<Vector3f>{{0, 1, 0}, {0, 0, 1}, {0, 0, 0}}));
    EXPECT_EQ(moved.faces, mesh.faces);
}

TEST(FolderBeside, IsNotInTheFolderOfADevice)
{
    EXPECT_THAT(cli::folder_beside("a/out.ply").string(), MatchesRegex("a/out.ply.tiles-[0-9]+"));
    EXPECT_NE(cli::folder_beside("/dev/null").parent_path(), "/dev");
}

} // namespace
} // namespace vcarve::cli::input_output_test
