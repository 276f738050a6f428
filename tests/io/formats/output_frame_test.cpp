#include "io/formats/output_frame.h"
#include "io/input/find_input.h"
#include "support/ball_model.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace vcarve::output_frame_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

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

} // namespace
} // namespace vcarve::output_frame_test
