#include "io/formats/mesh_file.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace vcarve::texture_command_test {
namespace {

using ::testing::HasSubstr;

const std::string kModel = fixtures_folder() / "desk_photos/sparse";

/// The mesh of a model, without colors and normals.
class TextureCommand : public ::testing::Test {
  protected:
    TextureCommand()
    {
        EXPECT_EQ(run_program({kModel, folder / "mesh.ply", "--quiet"}).exit_code, 0);
        mesh = read_ply(folder / "mesh.ply");
        mesh.colors.clear();
        mesh.normals.clear();
    }

    TemporaryFolder folder;
    TriMesh mesh;
};

TEST_F(TextureCommand, CoversAMeshOfAnyFormatAsTheRunThatMadeIt)
{
    const std::string whole = folder / "whole.ply";
    ASSERT_EQ(run_program({kModel, whole, "--texture", "--quiet"}).exit_code, 0);
    for (const std::string end : {"ply", "obj", "off"}) {
        const std::string given = folder / ("given." + end);
        write_mesh(given, mesh, {});
        const std::string out = folder / (end + "_out.ply");
        const Outcome outcome = run_program({"texture", kModel, given, out});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("shown by no photograph"));
        EXPECT_EQ(bytes_of(folder / (end + "_out_0.jpg")), bytes_of(folder / "whole_0.jpg")) << end;
        EXPECT_EQ(read_ply(out).faces, read_ply(whole).faces) << end;
    }
}

TEST_F(TextureCommand, TakesAMeshThatIsNotManifold)
{
    mesh.faces.insert(mesh.faces.end(), {mesh.faces[0], mesh.faces[1]});
    mesh.faces.push_back({mesh.faces[0][0], mesh.faces[1][0], mesh.faces[2][1]});
    write_mesh(folder / "given.obj", mesh, {});
    const std::string out = folder / "out.glb";
    const Outcome outcome = run_program({"texture", kModel, folder / "given.obj", out, "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(bytes_of(out), HasSubstr("JFIF"));
}

TEST_F(TextureCommand, IsTheSameForAnyNumberOfThreads)
{
    const std::string given = folder / "mesh.ply";
    const std::string one = folder / "one.glb";
    const std::string two = folder / "two.glb";
    ASSERT_EQ(run_program({"texture", kModel, given, one, "--threads", "1"}).exit_code, 0);
    ASSERT_EQ(run_program({"texture", kModel, given, two, "--threads", "2"}).exit_code, 0);
    EXPECT_EQ(bytes_of(one), bytes_of(two));
}

TEST_F(TextureCommand, SaysWhatIsWrongBeforeTheWorkStarts)
{
    const std::string given = folder / "mesh.ply";
    const std::string out = folder / "out.glb";
    EXPECT_THAT(sentence_of(2, {"texture", kModel, given}),
                HasSubstr("expected MODEL MESH OUT.glb, found 2 arguments"));
    EXPECT_THAT(sentence_of(2, {"texture", kModel, given, folder / "out.stl"}),
                HasSubstr("must end with .glb, .obj or .ply"));
    EXPECT_THAT(sentence_of(2, {"texture", kModel, folder / "mesh.fbx", out}),
                HasSubstr("must end with .ply, .obj, .off or .stl"));
    EXPECT_THAT(sentence_of(3, {"texture", kModel, folder / "none.ply", out}),
                HasSubstr("none.ply"));
    EXPECT_EQ(sentence_of(2, {"texture", kModel, given, given, "--quiet"}),
              "colmap-vcarve: the textured mesh would replace the mesh " + given + "\n");
    EXPECT_FALSE(std::filesystem::exists(out));
}

} // namespace
} // namespace vcarve::texture_command_test
