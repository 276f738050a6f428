#include "mesh/check.h"
#include "mesh/edge_table.h"
#include "tiles/join.h"

#include <gtest/gtest.h>

namespace vcarve::join_test {
namespace {

using Eigen::Vector3d;

VertexName name_of(std::uint64_t point, std::uint64_t copy = 0)
{
    return {{0, 0, point}, copy};
}

/// A row of squares along x, from (first, 0) to (last, 1); each is two faces. The ends are shared.
TileSurface row_of_squares(int first, int last)
{
    TileSurface tile;
    TriMesh& mesh = tile.mesh;
    for (int x = first; x <= last; ++x) {
        mesh.positions.emplace_back(x, 0, 0);
        mesh.positions.emplace_back(x, 1, 0);
    }
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t at = 0; at + 3 < count; at += 2) {
        mesh.faces.push_back({at, at + 2, at + 1});
        mesh.faces.push_back({at + 1, at + 2, at + 3});
    }
    mesh.normals.assign(count, Eigen::Vector3f(0, 0, 1));
    tile.shared = {0, 1, count - 2, count - 1};
    for (const std::uint32_t vertex : tile.shared) {
        const Vector3d& at = mesh.positions[vertex];
        tile.names.push_back(name_of(static_cast<std::uint64_t>(2 * at.x() + at.y())));
    }
    return tile;
}

JoinedSurface joined(std::vector<TileSurface> tiles, int max_hole = 12)
{
    for (TileSurface& tile : tiles) {
        const auto is_inner = [&](std::uint32_t vertex) {
            return std::ranges::count(tile.shared, vertex) == 0;
        };
        tile.boundary_edges = count_boundary_edges(
            tile.mesh.faces, tile.mesh.positions.size(),
            [&](std::uint32_t a, std::uint32_t b) { return is_inner(a) || is_inner(b); });
    }
    JoinedSurface made = join_tiles(
        tiles.size(), 10, [&](std::size_t tile) { return tiles[tile]; }, max_hole);
    EXPECT_EQ(made.boundary_edges, check_mesh(made.mesh).boundary_edges);
    return made;
}

TEST(JoinTiles, MeetsAtVerticesWithEqualNames)
{
    TileSurface left = row_of_squares(0, 3);
    TileSurface right = row_of_squares(3, 5);
    left.seam_edges = {{6, 7}};
    right.seam_edges = {{1, 0}};
    const JoinedSurface made = joined({left, right});
    const MeshCheck check = check_mesh(made.mesh);
    EXPECT_EQ(made.mesh.positions.size(), 12U);
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.boundary_edges, 12);
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(made.seams.edges, 1);
    EXPECT_EQ(made.seams.open, 0);
}

TEST(JoinTiles, FillsTheHoleWhereTilesDisagree)
{
    TileSurface left = row_of_squares(0, 3);
    TileSurface middle = row_of_squares(3, 4);
    TileSurface right = row_of_squares(4, 6);
    // The tile in the middle lacks one of its two faces.
    left.seam_edges = {{6, 7}};
    right.seam_edges = {{1, 0}};
    middle.mesh.faces.pop_back();
    middle.seam_edges = {{1, 0}, {2, 1}};
    const JoinedSurface open = joined({left, middle, right});
    EXPECT_EQ(open.seams.open, 2) << "the edges of the missing face that another face has";
    EXPECT_EQ(open.seams.filled, 0) << "the hole is at the border";
    EXPECT_TRUE(check_mesh(open.mesh).is_manifold());
}

TEST(JoinTiles, SplitsVerticesWhereTilesHaveFacesInTheSamePlace)
{
    const TileSurface left = row_of_squares(0, 3);
    const TileSurface doubled = row_of_squares(3, 4);
    const JoinedSurface made = joined({left, doubled, doubled});
    const MeshCheck check = check_mesh(made.mesh);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.faces, 10);
    EXPECT_GT(made.seams.vertices, 0);
}

TEST(JoinTiles, KeepsCopiesOfSplitVerticesApart)
{
    TileSurface left = row_of_squares(0, 3);
    TileSurface right = row_of_squares(3, 5);
    left.names[2] = name_of(6, 1);
    left.names[3] = name_of(7, 1);
    const JoinedSurface made = joined({left, right});
    EXPECT_EQ(made.mesh.positions.size(), 14U);
    EXPECT_EQ(check_mesh(made.mesh).components, 2);
    EXPECT_EQ(made.boundary_edges, 14);
}

} // namespace
} // namespace vcarve::join_test
