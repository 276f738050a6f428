#include "io/formats/mesh_file.h"
#include "io/formats/mesh_reader.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace vcarve::mesh_reader_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MeshReader : public ::testing::Test {
  protected:
    TriMesh read(const std::string& name, const std::string& text) const
    {
        return read_mesh(folder.write(name, text));
    }

    /// The message of the error that reading a file throws.
    std::string error_of(const std::string& name, const std::string& text) const
    {
        try {
            read(name, text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder folder;
};

TEST_F(MeshReader, RoundTripsEveryFormat)
{
    TriMesh mesh;
    // 0.1 + 2^20 needs all digits of a double, 2^-3 + 2^20 all digits of a float.
    mesh.positions = {{1048576.125, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1048576.1, 1, 1}};
    mesh.faces = {{0, 1, 2}, {1, 3, 2}};
    for (const std::string end : {".ply", ".obj", ".off", ".OBJ"}) {
        write_mesh(folder / ("mesh" + end), mesh, {});
        const TriMesh same = read_mesh(folder / ("mesh" + end));
        EXPECT_EQ(same.positions, mesh.positions) << end;
        EXPECT_EQ(same.faces, mesh.faces) << end;
    }
    mesh.positions[3].x() = 7.0; // exact as float
    write_mesh(folder / "mesh.stl", mesh, {});
    const TriMesh same = read_mesh(folder / "mesh.stl");
    EXPECT_EQ(same.positions.size(), 4U) << "equal corners are one vertex";
    EXPECT_EQ(same.faces.size(), 2U);
}

TEST_F(MeshReader, SplitsPolygonsAndAcceptsNegativeIndices)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    EXPECT_THAT(read("a.obj", vertices + "f 1 2 3 4\n").faces,
                ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}));
    EXPECT_THAT(read("b.obj", vertices + "f -4/1/1 -3/2/1 -2/3/1\n").faces,
                ElementsAre(Face{0, 1, 2}));
    EXPECT_THAT(read("c.obj", vertices + "f 1 2 2\nf 1 2 3\n").faces, ElementsAre(Face{0, 1, 2}))
        << "a face that uses a vertex twice has no area";
}

TEST_F(MeshReader, RefusesBrokenFiles)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    EXPECT_THAT(error_of("a.obj", vertices), HasSubstr("a.obj"));
    EXPECT_THAT(error_of("b.obj", vertices + "f 1 2 9\n"), HasSubstr("b.obj"));
    EXPECT_THAT(error_of("c.obj", vertices + "f 1 2 0\n"), HasSubstr("c.obj"));
    EXPECT_THAT(error_of("d.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"), HasSubstr("truncated"));
    EXPECT_THAT(error_of("e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 7\n"),
                HasSubstr("e.off"));
    EXPECT_THAT(error_of("f.off", "OFF\n999999999999999999 1 0\n0 0 0\n"), HasSubstr("f.off"));
    EXPECT_THAT(error_of("g.stl", "solid g\n facet normal 0 0 1\n"), HasSubstr("g.stl"));
    EXPECT_THAT(error_of("h.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"), HasSubstr("h.obj"));
    EXPECT_THAT(error_of("i.off", ""), HasSubstr("i.off"));
    EXPECT_THROW(read_mesh(folder / "none.obj"), InputError);
    EXPECT_THROW(read_mesh(folder / "mesh.glb"), UsageError);
}

} // namespace
} // namespace vcarve::mesh_reader_test
