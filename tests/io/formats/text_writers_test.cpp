#include "support/read_back.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

namespace vcarve::text_writers_test {
namespace {

using Eigen::Vector3d;
using ::testing::EndsWith;
using ::testing::StartsWith;

namespace {

TriMesh two_triangles()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.1, 1.0 / 3.0, 0}, {-2.5, 1e-7, 12}};
    mesh.faces = {{0, 1, 2}, {2, 1, 3}};
    return mesh;
}

TriMesh adorned_triangles()
{
    TriMesh mesh = two_triangles();
    mesh.colors = {{255, 0, 128}, {1, 2, 3}, {51, 102, 153}, {254, 127, 126}};
    mesh.normals = {{0, 0, 1}, {0, 1, 0}, {0.6F, 0, 0.8F}, {-1, 0, 0}};
    return mesh;
}

std::string written(const TriMesh& mesh, const std::string& name, const MeshFormat& format = {})
{
    const TemporaryFolder folder;
    write_mesh(folder / name, mesh, format);
    return bytes_of(folder / name);
}

TEST(WriteObj, WritesExpectedText)
{
    EXPECT_EQ(written(adorned_triangles(), "a.obj", {.comments = {"made here", "two\nlines"}}),
              "# made here\n"
              "# two lines\n"
              "v 0 0 0 1.0000 0.0000 0.5020\n"
              "v 1 0 0 0.0040 0.0079 0.0118\n"
              "v 0.1 0.3333333333333333 0 0.2000 0.4000 0.6000\n"
              "v -2.5 1e-07 12 0.9961 0.4981 0.4942\n"
              "vn 0 0 1\n"
              "vn 0 1 0\n"
              "vn 0.6 0 0.8\n"
              "vn -1 0 0\n"
              "f 1//1 2//2 3//3\n"
              "f 3//3 2//2 4//4\n");
    EXPECT_EQ(written(two_triangles(), "a.obj"), "v 0 0 0\n"
                                                 "v 1 0 0\n"
                                                 "v 0.1 0.3333333333333333 0\n"
                                                 "v -2.5 1e-07 12\n"
                                                 "f 1 2 3\n"
                                                 "f 3 2 4\n");
}

TEST(WriteOff, WritesExpectedText)
{
    EXPECT_EQ(written(adorned_triangles(), "a.off", {.comments = {"made here"}}),
              "COFF\n"
              "4 2 0\n"
              "0 0 0 1.0000 0.0000 0.5020 1.0000\n"
              "1 0 0 0.0040 0.0079 0.0118 1.0000\n"
              "0.1 0.3333333333333333 0 0.2000 0.4000 0.6000 1.0000\n"
              "-2.5 1e-07 12 0.9961 0.4981 0.4942 1.0000\n"
              "3 0 1 2\n"
              "3 2 1 3\n"
              "# made here\n");
    EXPECT_EQ(written(two_triangles(), "a.off"), "OFF\n"
                                                 "4 2 0\n"
                                                 "0 0 0\n"
                                                 "1 0 0\n"
                                                 "0.1 0.3333333333333333 0\n"
                                                 "-2.5 1e-07 12\n"
                                                 "3 0 1 2\n"
                                                 "3 2 1 3\n");
}

TEST(TextFormats, RecordTheSubtractedOffset)
{
    TriMesh mesh = two_triangles();
    mesh.offset = {5e5, 4.6e6, 100.25};
    const MeshFormat format = {.comments = {"made here"}, .offset = {5e5, 4.6e6, -0.1}};
    EXPECT_THAT(
        written(mesh, "a.obj", format),
        StartsWith("# offset 500000 4600000 -0.1\n# made here\nv 0 0 100.35\nv 1 0 100.35"));
    EXPECT_THAT(written(mesh, "a.off", format), StartsWith("OFF\n4 2 0\n0 0 100.35\n"));
    EXPECT_THAT(written(mesh, "a.off", format),
                EndsWith("# offset 500000 4600000 -0.1\n# made here\n"));
}

/// Returns the positions in OBJ or OFF text; OFF lines have no leading keyword.
std::vector<Vector3d> positions_in(const std::string& text, std::size_t count, bool is_obj)
{
    std::istringstream lines(text);
    std::string line;
    std::vector<Vector3d> positions;
    if (!is_obj) {
        std::getline(lines, line);
        std::getline(lines, line);
    }
    while (positions.size() < count && std::getline(lines, line)) {
        std::istringstream words(is_obj ? line.substr(2) : line);
        Vector3d& position = positions.emplace_back();
        words >> position.x() >> position.y() >> position.z();
    }
    return positions;
}

TEST(TextFormats, KeepDoublesFarFromTheOrigin)
{
    TriMesh mesh = sample_sheet();
    mesh.offset = {500000.123, 4600000.456, 100.789};
    for (const std::string name : {"a.obj", "a.off"}) {
        const std::vector<Vector3d> back =
            positions_in(written(mesh, name), mesh.positions.size(), name == "a.obj");
        ASSERT_EQ(back.size(), mesh.positions.size());
        for (std::size_t v = 0; v < back.size(); ++v) {
            EXPECT_EQ(back[v], mesh.positions[v] + mesh.offset) << name;
        }
    }
}

TEST(TextFormats, AreReadByAssimp)
{
    const TemporaryFolder folder;
    TriMesh mesh = sample_sheet();
    mesh.offset = {2.5, -1.0, 8.0};
    const std::vector<Corner> expected = corners_of(mesh);
    for (const std::string name : {"a.obj", "a.off"}) {
        write_mesh(folder / name, mesh, {.comments = {"made here"}});
        const std::vector<Corner> back = corners_of(read_by_assimp(folder / name));
        ASSERT_EQ(back.size(), expected.size()) << name;
        for (std::size_t i = 0; i < back.size(); ++i) {
            ASSERT_LT((back[i].position - expected[i].position).norm(), 2e-6) << name;
            ASSERT_EQ(back[i].color, expected[i].color) << name;
            if (name == "a.obj") {
                ASSERT_LT((back[i].normal - expected[i].normal).norm(), 1e-6F);
            }
        }
    }
}

TEST(TextFormats, PreserveColorsWhetherReadersRoundOrTruncate)
{
    TriMesh mesh;
    for (int i = 0; i < 256; ++i) {
        mesh.positions.emplace_back(i, 0, 0);
        mesh.colors.push_back({static_cast<std::uint8_t>(i), 0, 0});
    }
    std::istringstream lines(written(mesh, "a.obj"));
    for (int i = 0; i < 256; ++i) {
        char v = 0;
        double x = 0, y = 0, z = 0, red = 0, green = 0, blue = 0;
        lines >> v >> x >> y >> z >> red >> green >> blue;
        EXPECT_EQ(std::lround(255.0 * red), i);
        EXPECT_EQ(static_cast<int>(255.0 * red), i);
        EXPECT_EQ(static_cast<int>(255.0F * static_cast<float>(red)), i);
    }
}

} // namespace

namespace {

template <typename Number>
std::string bytes_of_numbers(std::initializer_list<Number> numbers)
{
    return {reinterpret_cast<const char*>(std::data(numbers)), numbers.size() * sizeof(Number)};
}

TEST(WriteStl, WritesExpectedBytes)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 0, -3}};
    mesh.faces = {{0, 1, 2}, {1, 1, 2}};
    mesh.offset = {10, 20, 30};
    const TemporaryFolder folder;
    write_mesh(folder / "a.stl", mesh, {.comments = {"made here", "twice"}});
    std::string header = "STL, made here, twice";
    header.resize(80);
    EXPECT_EQ(bytes_of(folder / "a.stl"),
              header + bytes_of_numbers<std::uint32_t>({2}) +
                  bytes_of_numbers<float>({-0.0F, 1, 0, 10, 20, 30, 12, 20, 30, 10, 20, 27}) +
                  std::string(2, '\0') +
                  bytes_of_numbers<float>({-0.0F, 0, 0, 12, 20, 30, 12, 20, 30, 10, 20, 27}) +
                  std::string(2, '\0'));
}

TEST(WriteStl, RecordsTheSubtractedOffset)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 0, -3}};
    mesh.faces = {{0, 1, 2}};
    mesh.offset = {5e5, 4.6e6, 107};
    const TemporaryFolder folder;
    write_mesh(folder / "a.stl", mesh,
               {.comments = {"made here"}, .offset = {499999.5, 4.6e6, 100}});
    const std::string bytes = bytes_of(folder / "a.stl");
    EXPECT_EQ(bytes.substr(0, 40), "STL, offset 499999.5 4600000 100, made h");
    EXPECT_EQ(bytes.substr(96, 12), bytes_of_numbers<float>({0.5F, 0.0F, 7.0F}));
}

TEST(WriteStl, TruncatesLongComments)
{
    const TemporaryFolder folder;
    write_mesh(folder / "a.stl", {}, {.comments = {std::string(100, 'x')}});
    EXPECT_EQ(bytes_of(folder / "a.stl"), "STL, " + std::string(75, 'x') + std::string(4, '\0'));
}

} // namespace

} // namespace
} // namespace vcarve::text_writers_test
