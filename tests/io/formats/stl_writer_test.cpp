#include "support/read_back.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>

#include <cstring>

namespace vcarve::stl_writer_test {
namespace {

using Eigen::Vector3d;

template <typename Number>
std::string bytes_of_numbers(std::initializer_list<Number> numbers)
{
    return {reinterpret_cast<const char*>(std::data(numbers)), numbers.size() * sizeof(Number)};
}

TEST(WriteStl, WritesExactlyTheseBytes)
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

TEST(WriteStl, IsReadByAssimp)
{
    const TemporaryFolder folder;
    TriMesh mesh = sample_sheet();
    mesh.offset = {2.5, -1.0, 8.0};
    write_mesh(folder / "a.stl", mesh, {});
    const std::vector<Corner> expected = corners_of(mesh);
    const std::vector<Corner> back = corners_of(read_by_assimp(folder / "a.stl"));
    ASSERT_EQ(back.size(), expected.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
        ASSERT_LT((back[i].position - expected[i].position).norm(), 2e-6);
    }
}

TEST(WriteStl, SaysTheOffsetThatWasSubtracted)
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

TEST(WriteStl, CutsLongCommentsOff)
{
    const TemporaryFolder folder;
    write_mesh(folder / "a.stl", {}, {.comments = {std::string(100, 'x')}});
    EXPECT_EQ(bytes_of(folder / "a.stl"), "STL, " + std::string(75, 'x') + std::string(4, '\0'));
}

} // namespace
} // namespace vcarve::stl_writer_test
