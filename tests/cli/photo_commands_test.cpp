#include "io/formats/mesh_file.h"
#include "support/photographed_wall.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::photo_commands_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST_F(TextureCommand, TexturesAMeshOfAnyFormatLikeTheRunThatMadeIt)
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

TEST_F(TextureCommand, AcceptsANonManifoldMesh)
{
    mesh.faces.insert(mesh.faces.end(), {mesh.faces[0], mesh.faces[1]});
    mesh.faces.push_back({mesh.faces[0][0], mesh.faces[1][0], mesh.faces[2][1]});
    write_mesh(folder / "given.obj", mesh, {});
    const std::string out = folder / "out.glb";
    const Outcome outcome = run_program({"texture", kModel, folder / "given.obj", out, "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(bytes_of(out), HasSubstr("JFIF"));
}

TEST_F(TextureCommand, WritesTheSameBytesForAnyThreadCount)
{
    const std::string given = folder / "mesh.ply";
    const std::string one = folder / "one.glb";
    const std::string two = folder / "two.glb";
    ASSERT_EQ(run_program({"texture", kModel, given, one, "--threads", "1"}).exit_code, 0);
    ASSERT_EQ(run_program({"texture", kModel, given, two, "--threads", "2"}).exit_code, 0);
    EXPECT_EQ(bytes_of(one), bytes_of(two));
}

TEST_F(TextureCommand, ReportsErrorsBeforeTheWorkStarts)
{
    const std::string given = folder / "mesh.ply";
    const std::string out = folder / "out.glb";
    EXPECT_THAT(sentence_of(2, {"texture", kModel, given}),
                HasSubstr("expected MODEL MESH OUT.glb, found 2 arguments"));
    EXPECT_THAT(sentence_of(2, {"texture", kModel, given, folder / "out.stl"}),
                HasSubstr("must end with .glb, .obj or .ply"));
    EXPECT_THAT(sentence_of(2, {"texture", kModel, folder / "mesh.fbx", out}),
                HasSubstr("must end with .ply, .obj, .off or .stl"));
    folder.write("broken.ply", "no mesh");
    EXPECT_THAT(sentence_of(2, {"texture", kModel, folder / "broken.ply",
                                folder / "nowhere/out.glb", "--quiet"}),
                HasSubstr("nowhere/out.glb"));
    EXPECT_THAT(sentence_of(3, {"texture", kModel, folder / "none.ply", out, "--quiet"}),
                HasSubstr("none.ply"));
    EXPECT_EQ(sentence_of(2, {"texture", kModel, given, given, "--quiet"}),
              "colmap-vcarve: the textured mesh would replace the mesh " + given + "\n");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(TextureCommand, SaysInItsHelpWhatItDoesWithPhotographsAndMasks)
{
    const std::string help = run_program({"texture", "--help-all"}).out;
    EXPECT_THAT(help, HasSubstr("No faces are removed."));
    EXPECT_THAT(help, Not(HasSubstr("dense points")));
}

using RefineCommand = TextureCommand;

TEST_F(RefineCommand, MovesAndColorsTheVerticesOfAMeshTheSameForAnyThreadCount)
{
    const std::string given = folder / "given.obj";
    write_mesh(given, mesh, {});
    const auto refined = [&](const std::string& threads) {
        const std::string out = folder / (threads + ".ply");
        const Outcome outcome = run_program(
            {"refine", kModel, given, out, "--refine-size", "160", "--threads", threads});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("measured by photographs"));
        return out;
    };
    const std::string one = refined("1");
    const TriMesh sharp = read_ply(one);
    EXPECT_EQ(sharp.colors.size(), sharp.positions.size());
    EXPECT_GT(sharp.faces.size(), 500U);
    EXPECT_NE(sharp.positions[0], mesh.positions[0]);
    EXPECT_EQ(bytes_of(one), bytes_of(refined("2")));
}

TEST_F(RefineCommand, ReportsErrorsBeforeTheWorkStarts)
{
    const std::string given = folder / "mesh.ply";
    const std::string out = folder / "out.ply";
    EXPECT_THAT(sentence_of(2, {"refine", kModel, given}),
                HasSubstr("expected MODEL MESH OUT.ply, found 2 arguments"));
    EXPECT_EQ(sentence_of(2, {"refine", kModel, given, given, "--quiet"}),
              "colmap-vcarve: the refined mesh would replace the mesh " + given + "\n");
    EXPECT_THAT(sentence_of(3, {"refine", kModel, given, out, "--images", folder / "none"}),
                HasSubstr("none"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

/// Writes masks for the photographs of the desk. They are black right of this share of the width.
void write_masks(const TemporaryFolder& folder, double share)
{
    Log log;
    const Scene scene = read_model(kModel, log);
    for (const View& view : scene.views) {
        const Camera& camera = scene.cameras[view.camera];
        const auto width = static_cast<int>(camera.width_px / 4);
        const auto height = static_cast<int>(camera.height_px / 4);
        const Photograph mask =
            mask_image(width, height, [&](int x, int) { return x >= share * width; });
        const auto file = folder.path() / "masks" / (view.name + ".png");
        std::filesystem::create_directories(file.parent_path());
        write_photograph(file, mask);
    }
}

/// A folder with one of the masks.
std::string one_mask_of(const TemporaryFolder& folder)
{
    namespace fs = std::filesystem;
    const fs::path one = folder.path() / "one_mask";
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(folder.path() / "masks")) {
        if (!entry.is_regular_file()) continue;
        const fs::path copy = one / fs::relative(entry.path(), folder.path() / "masks");
        fs::create_directories(copy.parent_path());
        fs::copy_file(entry.path(), copy);
        break;
    }
    return one.string();
}

TEST_F(TextureCommand, LeavesFacesInMaskedPixelsUntextured)
{
    const std::string given = folder / "mesh.ply";
    const std::string masks = folder / "masks";
    const auto bare_with = [&](double share) {
        write_masks(folder, share);
        const Outcome outcome =
            run_program({"texture", kModel, given, folder / "out.glb", "--masks", masks});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        std::string count = outcome.err.substr(outcome.err.rfind("faces, ") + 7);
        std::erase(count, ',');
        return std::stoi(count);
    };
    const int whole = bare_with(1.0);
    EXPECT_GT(bare_with(0.3), whole + 100);
}

TEST_F(TextureCommand, RemovesMaskedFacesWithAndWithoutPhotographs)
{
    write_masks(folder, 0.5);
    const std::string masks = folder / "masks";
    const auto num_faces = [&](const std::vector<std::string>& more) {
        std::vector<std::string> line = {kModel, folder / "out.ply", "--quiet", "--check"};
        line.insert(line.end(), more.begin(), more.end());
        const Outcome outcome = run_program(line);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read_ply(folder / "out.ply").faces.size();
    };
    const std::size_t all = num_faces({});
    const std::size_t kept = num_faces({"--masks", masks});
    EXPECT_LT(kept, all);
    EXPECT_GT(kept, all / 4);
    EXPECT_GT(num_faces({"--masks", one_mask_of(folder)}), all * 9 / 10) << "other views see them";
    const std::string images = fixtures_folder() / "desk_photos/images"; // divides faces
    EXPECT_LT(num_faces({"--masks", masks, "--images", images}), num_faces({"--images", images}));
    write_masks(folder, 0.0);
    EXPECT_EQ(sentence_of(3, {kModel, folder / "none.ply", "--masks", masks, "--quiet"}),
              "colmap-vcarve: " + kModel + ": the masks in " + masks +
                  " exclude all faces; black pixels are excluded, so the masks may need to be "
                  "inverted\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "none.ply"));
    EXPECT_EQ(sentence_of(3, {kModel, folder / "none.ply", "--masks", folder / "gone", "--quiet"}),
              "colmap-vcarve: " + (folder / "gone").string() +
                  ": the folder does not exist or cannot be opened; expected the folder of the "
                  "masks\n");
}

} // namespace
} // namespace vcarve::photo_commands_test
