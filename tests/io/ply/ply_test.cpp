#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

namespace vcarve::ply_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3f;

TriMesh two_triangles()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.1, 1.0 / 3.0, 0}, {-2.5, 1e-7, 12}};
    mesh.faces = {{0, 1, 2}, {2, 1, 3}};
    return mesh;
}

TriMesh random_mesh(int num_vertices, int num_faces)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    TriMesh mesh;
    for (int v = 0; v < num_vertices; ++v) {
        mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
        mesh.normals.push_back(mesh.positions.back().cast<float>().normalized());
        mesh.colors.push_back({static_cast<std::uint8_t>(random()),
                               static_cast<std::uint8_t>(random()),
                               static_cast<std::uint8_t>(random())});
    }
    for (int f = 0; f < num_faces; ++f) {
        const auto vertex = [&] {
            return static_cast<std::uint32_t>(random() % mesh.positions.size());
        };
        mesh.faces.push_back({vertex(), vertex(), vertex()});
    }
    return mesh;
}

TEST(WritePly, WritesExpectedText)
{
    const TemporaryFolder folder;
    TriMesh mesh = two_triangles();
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0.6F, 0.8F}, {1, 0, 0}};
    mesh.colors = {{0, 1, 2}, {255, 254, 253}, {9, 8, 7}, {128, 0, 128}};
    write_ply(folder / "out.ply", mesh, {.ascii = true, .comments = {"one", "two\nlines"}});
    EXPECT_EQ(bytes_of(folder / "out.ply"), "ply\n"
                                            "format ascii 1.0\n"
                                            "comment one\n"
                                            "comment two lines\n"
                                            "element vertex 4\n"
                                            "property double x\n"
                                            "property double y\n"
                                            "property double z\n"
                                            "property float nx\n"
                                            "property float ny\n"
                                            "property float nz\n"
                                            "property uchar red\n"
                                            "property uchar green\n"
                                            "property uchar blue\n"
                                            "element face 2\n"
                                            "property list uchar int vertex_indices\n"
                                            "end_header\n"
                                            "0 0 0 0 0 1 0 1 2\n"
                                            "1 0 0 0 0 1 255 254 253\n"
                                            "0.1 0.3333333333333333 0 0 0.6 0.8 9 8 7\n"
                                            "-2.5 1e-07 12 1 0 0 128 0 128\n"
                                            "3 0 1 2\n"
                                            "3 2 1 3\n");
}

TEST(WritePly, WritesExpectedBytes)
{
    const TemporaryFolder folder;
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}};
    mesh.colors = {{1, 2, 3}};
    mesh.faces = {{0, 0, 0}};
    write_ply(folder / "out.ply", mesh, {});
    using namespace std::string_literals;
    EXPECT_EQ(bytes_of(folder / "out.ply"),
              "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\n"
              "property double y\nproperty double z\nproperty uchar red\nproperty uchar green\n"
              "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n"s +
                  "\0\0\0\0\0\0\xf0\x3f"s + std::string(16, '\0') + "\1\2\3"s + "\3"s +
                  std::string(12, '\0'));
}

Provenance provenance_of_two_triangles()
{
    return {.point_ids = {5, 9007199254740992, -1, 0},
            .num_views = {3, 2, 0, 70000},
            .errors_px = {0.5F, 0.1F, -1.0F, 12.25F},
            .supports = {2, 0}};
}

TEST(WritePly, AppendsProvenance)
{
    const TemporaryFolder folder;
    const Provenance provenance = provenance_of_two_triangles();
    write_ply(folder / "out.ply", two_triangles(),
              {.ascii = true, .comments = {}, .provenance = &provenance});
    EXPECT_EQ(bytes_of(folder / "out.ply"), "ply\n"
                                            "format ascii 1.0\n"
                                            "element vertex 4\n"
                                            "property double x\n"
                                            "property double y\n"
                                            "property double z\n"
                                            "property double point3d_id\n"
                                            "property int num_views\n"
                                            "property float error_px\n"
                                            "element face 2\n"
                                            "property list uchar int vertex_indices\n"
                                            "element face_support 2\n"
                                            "property int support\n"
                                            "end_header\n"
                                            "0 0 0 5 3 0.5\n"
                                            "1 0 0 9007199254740992 2 0.1\n"
                                            "0.1 0.3333333333333333 0 -1 0 -1\n"
                                            "-2.5 1e-07 12 0 70000 12.25\n"
                                            "3 0 1 2\n"
                                            "3 2 1 3\n"
                                            "2\n"
                                            "0\n");
}

TEST(WritePly, IsReadByOpenMesh)
{
    const TemporaryFolder folder;
    TriMesh mesh = two_triangles();
    mesh.colors = {{0, 1, 2}, {255, 254, 253}, {9, 8, 7}, {128, 0, 128}};
    const Provenance provenance = provenance_of_two_triangles();
    const std::array<const Provenance*, 2> with_and_without = {&provenance, nullptr};
    for (int i = 0; i < 4; ++i) {
        write_ply(folder / "out.ply", mesh,
                  {.ascii = i < 2,
                   .comments = {"made by a test"},
                   .provenance = with_and_without[static_cast<std::size_t>(i % 2)]});
        OpenMesh::TriMesh_ArrayKernelT<> back;
        back.request_vertex_colors();
        OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexColor);
        ASSERT_TRUE(OpenMesh::IO::read_mesh(back, (folder / "out.ply").string(), options));
        ASSERT_EQ(back.n_vertices(), 4U);
        EXPECT_EQ(back.n_faces(), 2U);
        EXPECT_EQ(back.point(OpenMesh::VertexHandle(3)), OpenMesh::Vec3f(-2.5F, 1e-7F, 12.0F));
        EXPECT_EQ(back.color(OpenMesh::VertexHandle(1)), OpenMesh::Vec3uc(255, 254, 253));
    }
}

TEST(ReadPly, RoundTrips)
{
    const TemporaryFolder folder;
    const TriMesh mesh = random_mesh(300, 500);
    Provenance provenance;
    provenance.point_ids.assign(300, 17);
    provenance.num_views.assign(300, 4);
    provenance.errors_px.assign(300, 0.5F);
    provenance.supports.assign(500, 3);
    const std::array<const Provenance*, 2> with_and_without = {&provenance, nullptr};
    for (int i = 0; i < 4; ++i) {
        write_ply(folder / "out.ply", mesh,
                  {.ascii = i < 2,
                   .comments = {},
                   .provenance = with_and_without[static_cast<std::size_t>(i % 2)]});
        const TriMesh back = read_ply(folder / "out.ply");
        EXPECT_EQ(back.positions, mesh.positions);
        EXPECT_EQ(back.normals, mesh.normals);
        EXPECT_EQ(back.colors, mesh.colors);
        EXPECT_EQ(back.faces, mesh.faces);
        EXPECT_EQ(back.offset, Vector3d::Zero());
    }
}

TEST(ReadPly, RestoresTheSubtractedOffset)
{
    const TemporaryFolder folder;
    TriMesh mesh = two_triangles();
    mesh.offset = {500000.5, 4.6e6, 100.1};
    for (const bool ascii : {false, true}) {
        write_ply(folder / "out.ply", mesh, {.ascii = ascii, .offset = {5e5, 4.6e6, 0.1}});
        EXPECT_NE(bytes_of(folder / "out.ply").find("\ncomment offset 500000 4600000 0.1\n"),
                  std::string::npos);
        const TriMesh back = read_ply(folder / "out.ply");
        EXPECT_EQ(back.offset, Vector3d(5e5, 4.6e6, 0.1));
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            EXPECT_EQ(back.positions[v], mesh.positions[v] + Vector3d(0.5, 0.0, 100.1 - 0.1));
        }
    }
}

TEST(ReadPly, IgnoresOtherComments)
{
    const TemporaryFolder folder;
    for (const std::string comment :
         {"offset", "offset 1 2", "offset 1 2 3 4", "offset 1 2 x", "offset 1 2 inf",
          "offsets 1 2 3", "the offset 1 2 3", "offset 1,2,3", "offset 1 2 3m"}) {
        write_ply(folder / "out.ply", two_triangles(), {.comments = {comment}});
        EXPECT_EQ(read_ply(folder / "out.ply").offset, Vector3d(0, 0, 0)) << comment;
    }
    write_ply(folder / "out.ply", two_triangles(), {.comments = {"offset -1.5  2e3 3"}});
    EXPECT_EQ(read_ply(folder / "out.ply").offset, Vector3d(-1.5, 2000, 3));
}

TEST(ReadPly, ReadsEmptyMeshes)
{
    const TemporaryFolder folder;
    write_ply(folder / "out.ply", {}, {});
    const TriMesh back = read_ply(folder / "out.ply");
    EXPECT_TRUE(back.positions.empty());
    EXPECT_TRUE(back.faces.empty());
}

const std::string kTextHeader = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                "property float y\nproperty float z\nelement face 1\n"
                                "property list uchar int vertex_index\nend_header\n";
const std::string kFourVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(ReadPly, SplitsPolygonsIntoFans)
{
    const TemporaryFolder folder;
    const TriMesh mesh =
        read_ply(folder.write("a.ply", kTextHeader + kFourVertices + "4 3 0 1 2\n"));
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{3, 0, 1}, {3, 1, 2}}));
}

TEST(ReadPly, AcceptsAnyTextLayout)
{
    const TemporaryFolder folder;
    const std::string text =
        "ply\r\nformat ascii 1.0\r\ncomment element vertex 99\r\nobj_info hi\r\n"
        "element camera 2\r\nproperty float x\r\nproperty list int int y\r\n"
        "element nothing 5\r\n"
        "element vertex 3\r\nproperty int z\r\nproperty list uchar float tags\r\n"
        "property double x\r\nproperty float confidence\r\nproperty float y\r\n"
        "property float diffuse_red\r\nproperty ushort green\r\n"
        "property int blue\r\n"
        "element face 2\r\nproperty uchar flag\r\n"
        "property list uint8 uint16 vertex_index\r\n"
        "property list uchar float texcoord\r\nend_header\r\n"
        "1.5 0\r\n2 3 4 5 6\r\n"
        "30 2 7 8 10 0.5 +20 0 65535 300\r\n"
        "31 0 11 0.5 21 1 257 -4\r\n"
        "32 1 5 12 0.5\t22 0.5 514\n 7\r\n\r\n"
        "1 3 0 1 2 6 0 0 1 0 1 1\r\n"
        "0 3 2 1 0 0";
    const TriMesh mesh = read_ply(folder.write("a.ply", text));
    EXPECT_EQ(mesh.positions, (std::vector<Vector3d>{{10, 20, 30}, {11, 21, 31}, {12, 22, 32}}));
    EXPECT_EQ(mesh.colors, (std::vector<Color>{{0, 255, 255}, {255, 1, 0}, {128, 2, 7}}));
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}, {2, 1, 0}}));
}

/// The bytes of `value` in the given byte order, on a little endian machine.
template <typename Number>
std::string raw(Number value, bool big)
{
    std::string bytes(sizeof(Number), '\0');
    std::memcpy(bytes.data(), &value, sizeof(Number));
    return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

TEST(ReadPly, ReadsEveryNumberTypeInBothByteOrders)
{
    const TemporaryFolder folder;
    for (const bool big : {false, true}) {
        std::string text = "ply\nformat binary_";
        text += big ? "big" : "little";
        text += "_endian 1.0\nelement vertex 3\nproperty float32 x\nproperty float64 y\n"
                "property int16 z\nproperty char nx\nproperty short ny\nproperty int32 nz\n"
                "property uint8 red\nproperty uint16 green\nproperty uint32 blue\n"
                "element face 1\nproperty list uint32 uint16 vertex_indices\nend_header\n";
        for (int v = 0; v < 3; ++v) {
            text += raw(0.5F + static_cast<float>(v), big) + raw(1e-300, big) +
                    raw(static_cast<std::int16_t>(-300), big) +
                    raw(static_cast<std::int8_t>(-1), big) +
                    raw(static_cast<std::int16_t>(-2), big) + raw(-3, big) +
                    raw(static_cast<std::uint8_t>(200), big) +
                    raw(static_cast<std::uint16_t>(257), big) + raw(7U, big);
        }
        text += raw(3U, big);
        for (const std::uint16_t corner : {2, 0, 1}) {
            text += raw(corner, big);
        }
        const TriMesh mesh = read_ply(folder.write("a.ply", text));
        EXPECT_EQ(
            mesh.positions,
            (std::vector<Vector3d>{{0.5, 1e-300, -300}, {1.5, 1e-300, -300}, {2.5, 1e-300, -300}}));
        EXPECT_EQ(mesh.normals, std::vector<Vector3f>(3, Vector3f(-1, -2, -3)));
        EXPECT_EQ(mesh.colors, std::vector<Color>(3, Color{200, 1, 7}));
        EXPECT_EQ(mesh.faces, (std::vector<Face>{{2, 0, 1}}));
    }
}

std::string refusal_of(const TemporaryFolder& folder, const std::string& bytes)
{
    const fs::path path = folder.write("a.ply", bytes);
    const std::string message = refusal<InputError>([&] { read_ply(path); });
    return message.starts_with(path.string()) ? message.substr(folder.path().string().size() + 1)
                                              : message;
}

TEST(ReadPly, RefusesBrokenHeaders)
{
    const TemporaryFolder folder;
    const std::string begin = "ply\nformat ascii 1.0\n";
    EXPECT_EQ(refusal_of(folder, ""),
              "a.ply: the first line is not \"ply\", so this is no PLY file");
    EXPECT_EQ(refusal_of(folder, "solid x\n"),
              "a.ply: the first line is not \"ply\", so this is no PLY file");
    EXPECT_EQ(refusal_of(folder, begin + "element vertex 3\n"),
              "a.ply: the PLY header has no line end_header");
    EXPECT_EQ(
        refusal_of(folder, "ply\nformat binary 1.0\nend_header\n"),
        "a.ply: line 2 of the PLY header is \"format binary 1.0\", expected \"format ascii 1.0\" "
        "or one of the two binary formats");
    EXPECT_EQ(refusal_of(folder, begin + "element vertex -1\nend_header\n"),
              "a.ply: line 3 of the PLY header is \"element vertex -1\", expected \"element NAME "
              "COUNT\"");
    EXPECT_EQ(
        refusal_of(folder, begin + "element vertex 1\nproperty half x\nend_header\n"),
        "a.ply: line 4 of the PLY header is \"property half x\", expected a number type of PLY");
    EXPECT_EQ(
        refusal_of(folder, begin + "property float x\nend_header\n"),
        "a.ply: line 3 of the PLY header is \"property float x\", expected element, property, "
        "comment or end_header");
    EXPECT_EQ(
        refusal_of(folder, begin + "element face 1\nproperty list float int v\nend_header\n"),
        "a.ply: line 4 of the PLY header is \"property list float int v\", expected a length of "
        "integer type");
    EXPECT_EQ(
        refusal_of(folder, begin + "element face 1\nproperty float\nend_header\n"),
        "a.ply: line 4 of the PLY header is \"property float\", expected \"property TYPE NAME\"");
    EXPECT_EQ(refusal_of(folder, begin + "end_header\n"), "a.ply: has no element \"vertex\"");
    EXPECT_EQ(refusal_of(folder, begin + "element vertex 0\nend_header\n"),
              "a.ply: has no element \"face\", expected a mesh");
    EXPECT_EQ(refusal_of(folder, begin + "element vertex 0\nproperty float x\nproperty float y\n"
                                         "element face 0\nend_header\n"),
              "a.ply: the vertices lack one of the properties x, y and z");
    EXPECT_EQ(refusal_of(folder, begin + "element vertex 0\nproperty float x\nproperty float y\n"
                                         "property float z\nelement face 0\nproperty int "
                                         "vertex_indices\nend_header\n"),
              "a.ply: the faces have no list \"vertex_indices\" of integers");
}

TEST(ReadPly, RefusesBrokenText)
{
    const TemporaryFolder folder;
    const std::string good = kTextHeader + kFourVertices;
    EXPECT_EQ(
        refusal_of(folder, kTextHeader + "0 0 0 1 0 0 1"),
        "a.ply: the header declares 4 entries \"vertex\" of at least 6 bytes, but only 13 bytes "
        "follow");
    EXPECT_EQ(refusal_of(folder, kTextHeader + "0 0 0 1 0 0 1 1" + std::string(20, ' ')),
              "a.ply: vertex 2 of 4: the file ends there");
    EXPECT_EQ(refusal_of(folder, kTextHeader + "0 0 0 1 zero 0 1 1 0 0 1 0 3 0 1 2"),
              "a.ply: vertex 1 of 4: found \"zero\", expected a number");
    for (const std::string word : {"1e400", "-1e400", "1e-400"}) { // out of the range of double
        EXPECT_EQ(refusal_of(folder, kTextHeader + "0 0 0 1 " + word + " 0 1 1 0 0 1 0 3 0 1 2"),
                  "a.ply: vertex 1 of 4: found \"" + word + "\", expected a number");
    }
    EXPECT_EQ(refusal_of(folder, kTextHeader + "0 0 0 1 0 0 1 nan 0 0 1 0 3 0 1 2"),
              "a.ply: vertex 2 of 4: its position is (1, nan, 0), expected finite numbers");
    EXPECT_EQ(refusal_of(folder, good + "2 0 1"),
              "a.ply: face 0 of 1: it has 2 corners, expected 3 or more");
    EXPECT_EQ(refusal_of(folder, good + "3 0 1 4"),
              "a.ply: face 0 of 1: it uses vertex 4, but there are 4 vertices");
    EXPECT_EQ(refusal_of(folder, good + "3 0 1 -1"),
              "a.ply: face 0 of 1: it uses vertex -1, but there are 4 vertices");
    EXPECT_EQ(refusal_of(folder, good + "3 0 1 1.5"),
              "a.ply: face 0 of 1: it uses vertex 1.5, but there are 4 vertices");
    EXPECT_EQ(
        refusal_of(folder, good + "3 0 1"),
        "a.ply: face 0 of 1: the list \"vertex_index\" has length 3, but only 4 bytes follow");
}

TEST(ReadPly, RefusesCountsThatExceedTheFile)
{
    const TemporaryFolder folder;
    const std::string vertices = "property double x\nproperty double y\nproperty double z\n";
    const std::string begin = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    const std::string faces = "\nproperty list uint uint vertex_indices\nend_header\n";
    EXPECT_EQ(
        refusal_of(folder, begin + "18446744073709551615\n" + vertices + "element face 0" + faces),
        "a.ply: the header declares 18446744073709551615 entries \"vertex\" of at least 24 bytes, "
        "but only 0 bytes follow");
    EXPECT_EQ(
        refusal_of(folder, begin + "0\n" + vertices + "element face 4000000000" + faces + "...."),
        "a.ply: the header declares 4000000000 entries \"face\" of at least 4 bytes, but only 4 "
        "bytes follow");
    EXPECT_EQ(
        refusal_of(folder,
                   begin + "0\n" + vertices + "element face 1" + faces + "\xff\xff\xff\xff"),
        "a.ply: face 0 of 1: the list \"vertex_indices\" has length 4294967295, but only 0 bytes "
        "follow");
}

TEST(ReadPly, SurvivesTruncatedAndDamagedFiles)
{
    const TemporaryFolder folder;
    std::mt19937 random(3);
    for (const bool ascii : {false, true}) {
        write_ply(folder / "whole.ply", random_mesh(5, 4), {.ascii = ascii, .comments = {}});
        const std::string whole = bytes_of(folder / "whole.ply");
        // A text file without its last byte, a line break, is still complete.
        for (std::size_t size = 0; size + 2 < whole.size(); size += 3) {
            const fs::path path = folder.write("cut.ply", whole.substr(0, size));
            ASSERT_THROW(read_ply(path), InputError) << "cut to " << size << " bytes";
        }
        for (int round = 0; round < 200; ++round) {
            std::string dented = whole;
            dented[random() % dented.size()] = static_cast<char>(random());
            try {
                const TriMesh mesh = read_ply(folder.write("dented.ply", dented));
                for (const Face& face : mesh.faces) {
                    ASSERT_LT(*std::ranges::max_element(face), mesh.positions.size());
                }
            } catch (const InputError&) {
            }
        }
    }
}

} // namespace
} // namespace vcarve::ply_test
