#include "io/formats/mesh_file.h"
#include "support/read_back.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

namespace vcarve::mesh_file_test {
namespace {

namespace fs = std::filesystem;

const std::string kNames[] = {"a.ply", "a.obj", "a.off", "a.stl", "a.glb"};

TEST(WriteMesh, SelectsTheFormatByFileExtension)
{
    const TemporaryFolder folder;
    const TriMesh mesh = sample_sheet();
    const MeshFormat format = {.comments = {"made here"}};
    write_ply(folder / "as.ply", mesh, format);
    write_mesh(folder / "a.ply", mesh, format);
    EXPECT_EQ(bytes_of(folder / "a.ply"), bytes_of(folder / "as.ply"));
    const auto beginning = [&](const char* name) {
        write_mesh(folder / name, mesh, format);
        return bytes_of(folder / name).substr(0, 4);
    };
    EXPECT_EQ(beginning("A.PLY"), "ply\n");
    EXPECT_EQ(beginning("a.b.Obj"), "# ma");
    EXPECT_EQ(beginning("a.OFF"), "COFF");
    EXPECT_EQ(beginning("a.stl"), "STL,");
    EXPECT_EQ(beginning("a.glb"), "glTF");
}

TEST(WriteMesh, RefusesOtherFileExtensions)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.gltf", "ply", ".ply", "a.ply.gz", "a."}) {
        const fs::path path = folder / name;
        EXPECT_EQ(refusal<UsageError>([&] { write_mesh(path, sample_sheet(), {}); }),
                  "cannot write " + path.string() +
                      ": the name of a mesh must end with .ply, .obj, .off, .stl or .glb");
        EXPECT_FALSE(is_mesh_name(path));
    }
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(WriteMesh, RefusesOptionsThatAreForPlyOnly)
{
    const TemporaryFolder folder;
    const Provenance provenance;
    for (const std::string& name : kNames) {
        const fs::path path = folder / name;
        const bool is_ply = name == "a.ply";
        const std::string refused = is_ply ? "no exception" : "cannot write " + path.string();
        const std::string why = is_ply ? "" : ", which is for PLY files only";
        const auto message = [&](const MeshFormat& format) {
            return refusal<UsageError>([&] { write_mesh(path, {}, format); });
        };
        EXPECT_EQ(message({.ascii = true}), refused + (is_ply ? "" : " with --ascii") + why);
        EXPECT_EQ(message({.provenance = &provenance}),
                  refused + (is_ply ? "" : " with --attributes") + why);
    }
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(WriteMesh, LeavesTheFileUnchangedOnFailure)
{
    const TemporaryFolder folder;
    for (const std::string& name : kNames) {
        const fs::path path = folder / name;
        fs::create_symlink("/dev/full", path); // behaves like a full disk
        EXPECT_EQ(refusal<UsageError>([&] { write_mesh(path, sample_sheet(), {}); }),
                  "cannot write " + path.string() + ": No space left on device");
    }
    EXPECT_EQ(folder.num_entries(), std::size(kNames));
}

TEST(RoundingShare, MeasuresTheRoundingOfStl)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    mesh.faces = {{0, 1, 2}};
    EXPECT_EQ(rounding_share("a.stl", mesh, {}), 0.0);
    mesh.offset = {0, 4600000.2, 0}; // floats near 4600000 have steps of half a meter
    EXPECT_NEAR(rounding_share("a.stl", mesh, {}), 0.2 / 5.0, 1e-9);
    EXPECT_EQ(rounding_share("a.obj", mesh, {}), 0.0);
    EXPECT_LT(rounding_share("a.stl", mesh, {.offset = {0, 4600000, 0}}), 1e-7);
}

TEST(WriteMesh, WritesNonManifoldFaces)
{
    const TemporaryFolder folder;
    TriMesh mesh = sample_sheet();
    mesh.faces = {{0, 1, 9}, {0, 1, 10}, {1, 0, 11}, {2, 2, 3}};
    const std::vector<Corner> expected = corners_of(mesh);
    for (const char* name : {"a.obj", "a.off", "a.stl", "a.glb"}) {
        write_mesh(folder / name, mesh, {});
        const std::vector<Corner> back = corners_of(read_by_assimp(folder / name));
        ASSERT_EQ(back.size(), expected.size()) << name;
        for (std::size_t i = 0; i < back.size(); ++i) {
            ASSERT_LT((back[i].position - expected[i].position).norm(), 4e-6) << name;
        }
    }
}

} // namespace
} // namespace vcarve::mesh_file_test
