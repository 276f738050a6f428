#include "cli/placing.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

namespace vcarve::cli::placing_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(TransformOf, IsAScaleOrAFile)
{
    EXPECT_FALSE(transform_of(""));
    EXPECT_EQ(transform_of("0.25")->linear, 0.25 * Eigen::Matrix3d::Identity());
    EXPECT_EQ(transform_of("0.25")->scale, 0.25);
    const TemporaryFolder folder;
    EXPECT_EQ(transform_of(folder.write("2", "1 1 0 0 0 5 6 7"))->translation, Vector3d(5, 6, 7));
    for (const char* const text : {"0", "-2", "nan", "inf", "1e999"}) {
        EXPECT_EQ(refusal<UsageError>([&] { transform_of(text); }),
                  "--transform takes a file or a scale above 0, not \"" + std::string(text) + "\"");
    }
    EXPECT_NE(refusal<InputError>([] { transform_of("2m"); }).find("2m"), std::string::npos);
}

TEST(OffsetFor, IsRoundOnceTheModelIsTransformed)
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

TEST(UpFor, IsOfTheFrameThatIsWritten)
{
    Scene scene = make_scene({{0, 0, 0}}, {});
    Similarity quarter; // around x: what was -y is -z
    quarter.scale = 2.0;
    quarter.linear << 2, 0, 0, 0, 0, -2, 0, 2, 0;
    EXPECT_EQ(up_for(scene, UpWord::automatic, std::nullopt), Vector3d(0, -1, 0));
    EXPECT_EQ(up_for(scene, UpWord::automatic, quarter), Vector3d(0, 0, -1));
    EXPECT_EQ(up_for(scene, UpWord::z, quarter), Vector3d(0, 0, 1));
    EXPECT_EQ(up_for(scene, UpWord::none, quarter), Vector3d(0, 0, 0));
}

TEST(Transformed, TurnsNormalsWithoutScalingThem)
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
} // namespace vcarve::cli::placing_test
