#include "mesh/check.h"
#include "steps/6_surface/holes_beside.h"
#include "steps/6_surface/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;

constexpr int kMany = 12; ///< edges that a hole may have

/// A flat grid of squares with edges of length 1, two faces each, all of which are kept at first.
struct Grid {
    explicit Grid(std::uint32_t squares) : side(squares)
    {
        for (std::uint32_t j = 0; j <= side; ++j) {
            for (std::uint32_t i = 0; i <= side; ++i) {
                mesh.positions.emplace_back(i, j, 0.0);
            }
        }
        for (std::uint32_t j = 0; j < side; ++j) {
            for (std::uint32_t i = 0; i < side; ++i) {
                mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
        keep.assign(mesh.faces.size(), 1);
    }

    std::uint32_t at(std::uint32_t i, std::uint32_t j) const { return j * (side + 1) + i; }
    /// The face of a square below its diagonal, at its right edge; that above is the next.
    std::uint32_t below(std::uint32_t i, std::uint32_t j) const { return 2 * (j * side + i); }
    void open(std::uint32_t i, std::uint32_t j)
    {
        keep[below(i, j)] = 0;
        keep[below(i, j) + 1] = 0;
    }
    void fill(const std::vector<std::uint32_t>& some, int max_edges = kMany)
    {
        fill_holes_beside(some, max_edges, mesh, keep);
    }
    TriMesh kept() const { return with_faces(mesh, keep); }

    std::uint32_t side;
    TriMesh mesh;
    FaceFlags keep;
};

/// Fails unless nothing was added.
void expect_same(const Grid& grid, const Grid& before)
{
    EXPECT_EQ(grid.mesh.faces, before.mesh.faces);
    EXPECT_EQ(grid.keep, before.keep);
}

/// A grid with a hole of one square at (3, 3).
Grid with_a_hole()
{
    Grid grid(8);
    grid.open(3, 3);
    return grid;
}

TEST(FillHolesBeside, FillsAHoleAlongAFaceWithFacesThatFitItsRim)
{
    Grid grid = with_a_hole();
    const Grid before = grid;
    grid.fill({grid.below(2, 3)}); // at the left edge of the hole
    ASSERT_EQ(grid.mesh.faces.size(), before.mesh.faces.size() + 2);
    EXPECT_EQ(grid.mesh.positions, before.mesh.positions);
    EXPECT_TRUE(std::ranges::equal(before.mesh.faces,
                                   std::span(grid.mesh.faces).first(before.mesh.faces.size())));
    ASSERT_EQ(grid.keep.size(), grid.mesh.faces.size());
    EXPECT_EQ(grid.keep[grid.keep.size() - 2], 1);
    EXPECT_EQ(grid.keep.back(), 1);
    EXPECT_TRUE(std::ranges::equal(before.keep, std::span(grid.keep).first(before.keep.size())));
    const MeshCheck check = check_mesh(grid.kept());
    EXPECT_EQ(check.boundary_edges, 32) << "those around the grid";
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_NEAR(check.area, 64.0, 1e-12);
}

TEST(FillHolesBeside, FillsWhereOnlyKeptFacesAreGiven)
{
    // As fill_holes() would meet it: what is not kept is not there at all.
    const Grid open = with_a_hole();
    TriMesh mesh = open.kept();
    FaceFlags keep(mesh.faces.size(), 1);
    const auto beside = std::ranges::find(mesh.faces, open.mesh.faces[open.below(2, 3)]);
    fill_holes_beside({static_cast<std::uint32_t>(beside - mesh.faces.begin())}, kMany, mesh, keep);
    EXPECT_EQ(check_mesh(mesh).boundary_edges, 32);
    EXPECT_EQ(keep.size(), mesh.faces.size());
}

TEST(FillHolesBeside, LeavesAHoleAwayFromTheFaces)
{
    Grid grid = with_a_hole();
    const Grid before = grid;
    grid.fill({grid.below(6, 6)});
    expect_same(grid, before);
    grid.fill({});
    expect_same(grid, before);
}

TEST(FillHolesBeside, LeavesAHoleThatAFaceTouchesInAVertexOnly)
{
    Grid grid = with_a_hole();
    const Grid before = grid;
    grid.fill({grid.below(2, 2)}); // its upper right corner is the hole's lower left one
    expect_same(grid, before);
}

TEST(FillHolesBeside, FillsOfTwoHolesTheOneBeside)
{
    Grid grid = with_a_hole();
    grid.open(5, 3);
    const Grid before = grid;
    grid.fill({grid.below(2, 3)});
    EXPECT_EQ(grid.mesh.faces.size(), before.mesh.faces.size() + 2);
    EXPECT_NEAR(check_mesh(grid.kept()).area, 63.0, 1e-12);
    // Between them: beside both.
    grid = before;
    grid.fill({grid.below(4, 3), grid.below(4, 3) + 1});
    EXPECT_EQ(grid.mesh.faces.size(), before.mesh.faces.size() + 4);
    EXPECT_EQ(check_mesh(grid.kept()).boundary_edges, 32);
    EXPECT_EQ(check_mesh(grid.kept()).orientation_faults, 0);
}

TEST(FillHolesBeside, FillsNoHoleOfMoreEdges)
{
    Grid grid = with_a_hole();
    grid.open(4, 3); // two squares: six edges
    const Grid before = grid;
    for (const int max_edges : {0, 3, 5}) {
        grid.fill({grid.below(2, 3)}, max_edges);
        expect_same(grid, before);
    }
    grid.fill({grid.below(2, 3)}, 6);
    EXPECT_EQ(grid.mesh.faces.size(), before.mesh.faces.size() + 4);
    EXPECT_EQ(check_mesh(grid.kept()).boundary_edges, 32);
}

TEST(FillHolesBeside, FillsAHoleWhoseRimGoesFarFromTheFaces)
{
    // The hole is a slit of five squares, and the face at its end.
    Grid grid(10);
    for (std::uint32_t i = 2; i < 7; ++i) {
        grid.open(i, 4);
    }
    grid.fill({grid.below(1, 4)}, 12);
    const MeshCheck check = check_mesh(grid.kept());
    EXPECT_EQ(check.boundary_edges, 40);
    EXPECT_NEAR(check.area, 100.0, 1e-12);
}

TEST(FillHolesBeside, LeavesTheOuterRim)
{
    Grid grid(3); // with twelve edges around
    grid.open(1, 1);
    const Grid before = grid;
    std::vector<std::uint32_t> all;
    for (std::uint32_t face = 0; face < grid.keep.size(); ++face) {
        if (grid.keep[face] != 0) all.push_back(face);
    }
    grid.fill(all);
    EXPECT_EQ(grid.mesh.faces.size(), before.mesh.faces.size() + 2);
    EXPECT_EQ(check_mesh(grid.kept()).boundary_edges, 12);
    EXPECT_NEAR(check_mesh(grid.kept()).area, 9.0, 1e-12);
}

TEST(FillHolesBeside, FillsNothingOnAClosedSurface)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    FaceFlags keep(4, 1);
    fill_holes_beside({0, 1, 2, 3}, kMany, mesh, keep);
    EXPECT_EQ(mesh.faces.size(), 4U);
    EXPECT_EQ(keep.size(), 4U);
}

TEST(FillHolesBeside, ClosesATetrahedronWithoutASide)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    FaceFlags keep = {1, 1, 1, 0};
    fill_holes_beside({0}, kMany, mesh, keep);
    ASSERT_EQ(mesh.faces.size(), 5U);
    EXPECT_TRUE(std::ranges::is_permutation(mesh.faces[4], mesh.faces[3]));
    mesh.faces.erase(mesh.faces.begin() + 3);
    EXPECT_TRUE(check_mesh(mesh).is_closed());
    EXPECT_EQ(check_mesh(mesh).orientation_faults, 0);
}

/// A tube of six sides and so many rings around the z axis, which are a step apart. Ring k is
/// vertices 6 k to 6 k + 5, and of the faces between it and the next two follow each other on each
/// side: the first has an edge on ring k, the second one on the next.
TriMesh tube(std::uint32_t rings)
{
    constexpr std::uint32_t kSides = 6;
    TriMesh mesh;
    for (std::uint32_t i = 0; i < kSides * rings; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i % kSides) / kSides;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), i / kSides);
    }
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t a = kSides * ring + i;
            const std::uint32_t b = kSides * ring + (i + 1) % kSides;
            mesh.faces.push_back({a, b, b + kSides});
            mesh.faces.push_back({a, b + kSides, a + kSides});
        }
    }
    return mesh;
}

TEST(FillHolesBeside, TakesTheEndOfWhatItLooksAtForNoHole)
{
    // The faces around the lower end of a tube are a tube that ends where the surface goes on.
    TriMesh mesh = tube(4);
    FaceFlags keep(mesh.faces.size(), 1);
    const std::size_t before = mesh.faces.size();
    fill_holes_beside({0, 1}, 6, mesh, keep);
    EXPECT_EQ(mesh.faces.size(), before + 4) << "the lower end";
    for (std::size_t face = before; face < mesh.faces.size(); ++face) {
        for (const std::uint32_t corner : mesh.faces[face]) {
            EXPECT_LT(corner, 6U);
        }
    }
    const MeshCheck check = check_mesh(mesh);
    EXPECT_EQ(check.boundary_edges, 6) << "the upper end";
    EXPECT_EQ(check.nonmanifold_edges, 0);
    EXPECT_EQ(check.orientation_faults, 0);
}

TEST(FillHolesBeside, FillsHolesAlongAllOfTheFacesGiven)
{
    TriMesh mesh = tube(4);
    FaceFlags keep(mesh.faces.size(), 1);
    const auto last = static_cast<std::uint32_t>(mesh.faces.size() - 1);
    fill_holes_beside({0, last}, 6, mesh, keep);
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.is_closed());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.euler_characteristic, 2);
}

TEST(FillHolesBeside, LeavesTheHoleOfAnotherSurfaceThatTouchesTheRim)
{
    // Another tube beside the first: both lower ends have one vertex in common.
    TriMesh mesh = tube(4);
    const TriMesh other = tube(4);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto before = mesh.faces.size() + other.faces.size();
    for (const Vector3d& position : other.positions) {
        mesh.positions.emplace_back(position + Vector3d(2, 0, 0));
    }
    for (Face face : other.faces) {
        for (std::uint32_t& corner : face) {
            corner = corner == 3 ? 0 : corner + first;
        }
        mesh.faces.push_back(face);
    }
    FaceFlags keep(mesh.faces.size(), 1);
    fill_holes_beside({0}, kMany, mesh, keep);
    ASSERT_EQ(mesh.faces.size(), before + 4);
    for (std::size_t face = before; face < mesh.faces.size(); ++face) {
        for (const std::uint32_t corner : mesh.faces[face]) {
            EXPECT_LT(corner, 6U);
        }
    }
    EXPECT_EQ(check_mesh(mesh).boundary_edges, 18);
}

TEST(FillHolesBeside, KeepsSolidsApartThatTouchAtAHole)
{
    // Two tetrahedra without a side each, which share the edge 0 1: as one it has three faces where
    // one of theirs is missing.
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}, {-1, -0.5, 0}};
    mesh.faces = {{0, 1, 3}, {1, 0, 2}, {0, 3, 2}, {1, 2, 3},
                  {0, 1, 5}, {1, 0, 4}, {0, 5, 4}, {1, 4, 5}};
    FaceFlags keep(8, 1);
    keep[3] = 0; // 1 2 3
    fill_holes_beside({0}, kMany, mesh, keep);
    ASSERT_EQ(mesh.faces.size(), 9U);
    EXPECT_TRUE(std::ranges::is_permutation(mesh.faces[8], mesh.faces[3]));
    mesh.faces[3] = mesh.faces[8];
    mesh.faces.pop_back();
    EXPECT_EQ(check_mesh(mesh).boundary_edges, 0);
    EXPECT_EQ(check_mesh(mesh).components, 1);
    EXPECT_EQ(check_mesh(mesh).nonmanifold_edges, 1);
}

} // namespace
} // namespace vcarve
