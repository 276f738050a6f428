#include "mesh/vertex_faces.h"

#include <gtest/gtest.h>

#include <vector>

namespace vcarve::vertex_faces_test {
namespace {

TEST(VertexFaces, AreAscendingAndOnlyThoseWithAFlag)
{
    const std::vector<Face> faces = {{2, 0, 1}, {0, 2, 3}, {3, 2, 1}};
    const auto row = [](const VertexFaces& at, std::size_t vertex) {
        return std::vector<std::uint32_t>(at[vertex].begin(), at[vertex].end());
    };
    const VertexFaces all(faces, 5);
    EXPECT_EQ(row(all, 0), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(row(all, 2), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(row(all, 4).empty());
    const VertexFaces some(faces, 5, {1, 0, 1});
    EXPECT_EQ(row(some, 0), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(row(some, 3), (std::vector<std::uint32_t>{2}));
}

} // namespace
} // namespace vcarve::vertex_faces_test
