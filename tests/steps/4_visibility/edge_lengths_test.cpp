#include "steps/1_points/spatial_sort.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/edge_lengths.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace vcarve::edge_lengths_test {
namespace {

/// The lengths of all finite edges, ascending.
std::vector<double> edge_lengths(const TetMesh& mesh)
{
    std::set<std::pair<Index, Index>> edges;
    for (const Cell& cell : mesh.cells) {
        for (const Index a : cell.vertices) {
            for (const Index b : cell.vertices) {
                if (a < b && b != kInfinite) {
                    edges.emplace(a, b);
                }
            }
        }
    }
    std::vector<double> lengths;
    for (const auto& [a, b] : edges) {
        lengths.push_back((mesh.positions[a] - mesh.positions[b]).norm());
    }
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

TEST(ShortEdgeLength, IsTheFirstQuartileOfAllFiniteEdges)
{
    const TetMesh mesh = triangulate(spatial_sort(bumpy_sphere(800, 21)));
    const std::vector<double> lengths = edge_lengths(mesh);
    EXPECT_EQ(short_edge_length(mesh), lengths[lengths.size() / 4]);
}

TEST(ShortEdgeLength, IsNearThatQuartileWhereAChoiceOfEdgesStandsForAll)
{
    const TetMesh mesh = triangulate(spatial_sort(bumpy_sphere(20000, 22)));
    ASSERT_GT(mesh.cells.size(), 100'000U);
    const std::vector<double> lengths = edge_lengths(mesh);
    const double found = short_edge_length(mesh);
    EXPECT_GE(found, lengths[lengths.size() * 24 / 100]);
    EXPECT_LE(found, lengths[lengths.size() * 26 / 100]);
}

TEST(ShortEdgeLength, IsTheEdgeOfARegularTetrahedron)
{
    const Scene scene =
        make_scene({{9, 9, 9}},
                   {{{1, 1, 1}, {0}}, {{1, -1, -1}, {0}}, {{-1, 1, -1}, {0}}, {{-1, -1, 1}, {0}}});
    EXPECT_DOUBLE_EQ(short_edge_length(triangulate(scene)), std::sqrt(8.0));
}

} // namespace
} // namespace vcarve::edge_lengths_test
