#include "mesh/edge_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace vcarve::edge_table_test {
namespace {

using ::testing::ElementsAre;

TEST(EdgeTable, GroupsHalfEdgesBySortedEdges)
{
    const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}, {3, 3, 0}, {1, 2, 4}};
    const EdgeTable edges = gather_edges(faces, 5);
    EXPECT_THAT(edges.begins, ElementsAre(0, 1, 2, 5, 6, 7, 8, 9));
    EXPECT_THAT(edges[0], ElementsAre(0));       // 0 1
    EXPECT_THAT(edges[1], ElementsAre(2));       // 0 2
    EXPECT_THAT(edges[2], ElementsAre(1, 3, 9)); // 1 2, of three faces
    EXPECT_THAT(edges[3], ElementsAre(4));       // 1 3
    EXPECT_THAT(edges[4], ElementsAre(11));      // 1 4
    EXPECT_THAT(edges[5], ElementsAre(5));       // 2 3
    EXPECT_THAT(edges[6], ElementsAre(10));      // 2 4
}

TEST(EdgeTable, IsEmptyWithoutFaces)
{
    EXPECT_EQ(gather_edges({}, 0).size(), 0U);
    EXPECT_EQ(gather_edges({}, 7).size(), 0U);
}

TEST(HalfEdges, FollowEachOtherAroundTheirFace)
{
    const std::vector<Face> faces = {{0, 1, 2}, {5, 6, 7}};
    EXPECT_EQ(next_half_edge(5), 3U);
    EXPECT_EQ(previous_half_edge(3), 5U);
    EXPECT_EQ(tail(faces, 5), 7U);
    EXPECT_EQ(head(faces, 5), 5U);
    EXPECT_TRUE(is_degenerate({1, 2, 1}));
    EXPECT_FALSE(is_degenerate({1, 2, 3}));
}

} // namespace
} // namespace vcarve::edge_table_test
