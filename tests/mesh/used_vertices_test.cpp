#include "mesh/used_vertices.h"

#include <gtest/gtest.h>

#include <vector>

namespace vcarve::used_vertices_test {
namespace {

TEST(UsedVertices, AreAscendingAndNumberFacesAnew)
{
    std::vector<Face> faces = {{4, 1, 2}, {2, 1, 7}};
    const std::vector<std::uint32_t> used = used_vertices(faces, 9);
    EXPECT_EQ(used, (std::vector<std::uint32_t>{1, 2, 4, 7}));
    renumber(faces, used, 9);
    EXPECT_EQ(faces, (std::vector<Face>{{2, 0, 1}, {1, 0, 3}}));
}

TEST(UsedVertices, AreNoneWithoutFaces)
{
    EXPECT_TRUE(used_vertices({}, 5).empty());
}

} // namespace
} // namespace vcarve::used_vertices_test
