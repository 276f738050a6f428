#include "geometry/triangle.h"
#include "mesh/check.h"
#include "mesh/edge_halving.h"
#include "support/tetra_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace vcarve::edge_halving_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using vcarve::testing::volume;

constexpr auto kAlways = [](std::uint32_t, std::uint32_t) { return true; };
constexpr auto kNever = [](std::uint32_t, std::uint32_t) { return false; };

/// Gives vertices distinct colors and points.
void mark_vertices(TriMesh& mesh)
{
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        mesh.colors.push_back({static_cast<std::uint8_t>(3 * v), static_cast<std::uint8_t>(10 * v),
                               static_cast<std::uint8_t>(255 - v)});
        mesh.points.push_back(100 + v);
    }
}

/// A square of two faces that share the edge 0 2.
TriMesh square()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {2, 3, 0}};
    mark_vertices(mesh);
    return mesh;
}

TriMesh octahedron()
{
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 3}, {0, 0, -3}};
    mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    mark_vertices(mesh);
    return mesh;
}

/// Two tetrahedra that share only the edge 0 1, an edge of the first four faces.
TriMesh two_wedges()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, -0.1, 0}, {1, 0.1, 0}, {-1, 0.1, 0}, {-1, -0.1, 0}};
    mesh.faces = {{0, 1, 3}, {1, 0, 2}, {0, 1, 5}, {1, 0, 4},
                  {0, 3, 2}, {1, 2, 3}, {0, 5, 4}, {1, 4, 5}};
    mark_vertices(mesh);
    return mesh;
}

/// The edges of a mesh, the lower vertex first.
std::vector<std::array<std::uint32_t, 2>> edges_of(const TriMesh& mesh)
{
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(face[i], face[(i + 1) % 3]);
            edges.insert({a, b});
        }
    }
    return {edges.begin(), edges.end()};
}

std::vector<std::pair<std::uint32_t, std::uint32_t>>
pairs(const std::vector<EdgeHalving::HalvedFace>& halved)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    for (const auto& [face, other_half] : halved) {
        found.emplace_back(face, other_half);
    }
    return found;
}

/// Bisects `count` randomly chosen edges one after another.
void halve_some(TriMesh& mesh, EdgeHalving& halving, int count, std::mt19937& random)
{
    for (int i = 0; i < count; ++i) {
        const auto edges = edges_of(mesh);
        const auto [a, b] = edges[random() % edges.size()];
        ASSERT_FALSE(halving.halve(a, b).empty());
    }
}

// ---- longest_edge_of ----------------------------------------------------------------------------

TEST(LongestEdge, DoesNotDependOnFirstCorner)
{
    const std::vector<Vector3d> positions = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}};
    for (const Face& face : {Face{0, 1, 2}, Face{1, 2, 0}, Face{2, 0, 1}, Face{2, 1, 0}}) {
        EXPECT_THAT(longest_edge_of(positions, face), ElementsAre(0, 2));
    }
}

TEST(LongestEdge, BreaksTiesByLowestVertices)
{
    // The first two sides are equally long, the third is shorter.
    const std::vector<Vector3d> positions = {{1, 0, 0}, {0, 3, 0}, {-1, 0, 0}};
    EXPECT_THAT(longest_edge_of(positions, {0, 1, 2}), ElementsAre(0, 1));
    EXPECT_THAT(longest_edge_of(positions, {1, 2, 0}), ElementsAre(0, 1));
    EXPECT_THAT(longest_edge_of(positions, {2, 1, 0}), ElementsAre(0, 1));
    const std::vector<Vector3d> even = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_THAT(longest_edge_of(even, {2, 1, 0}), ElementsAre(0, 1));
    EXPECT_THAT(longest_edge_of(even, {1, 2, 0}), ElementsAre(0, 1));
}

TEST(LongestEdge, TreatsRoundingDifferencesAsTies)
{
    std::vector<Vector3d> positions = {{1, 0, 0}, {0, 3, 0}, {-1 - 1e-12, 0, 0}};
    EXPECT_THAT(longest_edge_of(positions, {2, 0, 1}), ElementsAre(0, 1));
    positions[2].x() = -1 - 1e-6;
    EXPECT_THAT(longest_edge_of(positions, {2, 0, 1}), ElementsAre(1, 2));
}

// ---- halve --------------------------------------------------------------------------------------

TEST(EdgeHalving, BisectsFacesOnBothSides)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {});
    EXPECT_THAT(pairs(halving.halve(0, 2)), ElementsAre(std::pair(0U, 2U), std::pair(1U, 3U)));
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 4}, {4, 3, 0}, {4, 1, 2}, {2, 3, 4}}));
    EXPECT_EQ(mesh.positions[4], Vector3d(0.5, 0.5, 0));
    EXPECT_EQ(mesh.colors[4], (Color{3, 10, 254}));
    EXPECT_EQ(mesh.points, (std::vector<std::uint32_t>{100, 101, 102, 103, kNoPoint}));
}

TEST(EdgeHalving, KeepsTheHalfAtFirstVertexInPlace)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {});
    halving.halve(2, 0);
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{4, 1, 2}, {2, 3, 4}, {0, 1, 4}, {4, 3, 0}}));
}

TEST(EdgeHalving, BisectsTheSingleFaceOfBoundaryEdge)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {});
    EXPECT_THAT(pairs(halving.halve(1, 2)), ElementsAre(std::pair(0U, 2U)));
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 4}, {2, 3, 0}, {0, 4, 2}}));
}

TEST(EdgeHalving, BisectsAllFacesOfNonManifoldEdge)
{
    TriMesh mesh = two_wedges();
    const MeshCheck before = check_mesh(mesh);
    EdgeHalving halving(mesh, {});
    EXPECT_THAT(pairs(halving.halve(0, 1)), ElementsAre(std::pair(0U, 8U), std::pair(1U, 9U),
                                                        std::pair(2U, 10U), std::pair(3U, 11U)));
    const MeshCheck after = check_mesh(mesh);
    EXPECT_EQ(after.faces, 12);
    EXPECT_EQ(after.nonmanifold_edges, 2) << "the halves of the edge";
    EXPECT_EQ(after.boundary_edges, 0);
    EXPECT_NEAR(after.area, before.area, 1e-12);
    EXPECT_NEAR(volume(mesh), volume(two_wedges()), 1e-12);
}

TEST(EdgeHalving, IgnoresUnflaggedFaces)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {0, 1});
    EXPECT_THAT(pairs(halving.halve(0, 2)), ElementsAre(std::pair(1U, 2U)));
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}, {4, 3, 0}, {2, 3, 4}}));
}

TEST(EdgeHalving, LeavesNoVertexInsideAnEdgeAfterManyBisections)
{
    std::mt19937 random(5);
    for (int round = 0; round < 50; ++round) {
        TriMesh mesh = octahedron();
        const MeshCheck before = check_mesh(mesh);
        EdgeHalving halving(mesh, {});
        ASSERT_NO_FATAL_FAILURE(halve_some(mesh, halving, 40, random));
        const MeshCheck after = check_mesh(mesh);
        ASSERT_TRUE(after.is_closed());
        ASSERT_TRUE(after.is_manifold());
        ASSERT_EQ(after.orientation_faults, 0);
        ASSERT_EQ(after.degenerate_faces, 0);
        ASSERT_EQ(after.euler_characteristic, 2);
        ASSERT_EQ(after.faces, before.faces + 80) << "two more per bisection";
        ASSERT_EQ(after.vertices, before.vertices + 40);
        ASSERT_NEAR(after.area, before.area, 1e-9);
        ASSERT_NEAR(volume(mesh), volume(octahedron()), 1e-9);
        for (std::size_t v = 6; v < mesh.points.size(); ++v) {
            ASSERT_EQ(mesh.points[v], kNoPoint);
        }
    }
}

TEST(EdgeHalving, ReturnsHalvesInOrderOfAddition)
{
    std::mt19937 random(6);
    TriMesh mesh = two_wedges();
    EdgeHalving halving(mesh, {});
    for (int i = 0; i < 60; ++i) {
        const auto edges = edges_of(mesh);
        const auto [a, b] = edges[random() % edges.size()];
        const std::vector<Face> before = mesh.faces;
        auto added = static_cast<std::uint32_t>(before.size());
        const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
        for (const auto& [face, other_half] : halving.halve(a, b)) {
            ASSERT_EQ(other_half, added++);
            ASSERT_LT(face, before.size());
            Face joined = mesh.faces[face];
            std::ranges::replace(joined, middle, b);
            ASSERT_EQ(joined, before[face]);
            joined = mesh.faces[other_half];
            std::ranges::replace(joined, middle, a);
            ASSERT_EQ(joined, before[face]);
        }
        ASSERT_EQ(mesh.faces.size(), added);
    }
}

// ---- take_back ----------------------------------------------------------------------------------

TEST(EdgeHalving, RevertsAllBisectionsIfAllMayJoin)
{
    std::mt19937 random(7);
    for (const TriMesh& original : {square(), octahedron(), two_wedges()}) {
        TriMesh mesh = original;
        EdgeHalving halving(mesh, {});
        ASSERT_NO_FATAL_FAILURE(halve_some(mesh, halving, 30, random));
        std::vector<std::uint32_t> gone = halving.take_back(kAlways);
        std::ranges::sort(gone);
        const std::size_t first = original.faces.size();
        ASSERT_EQ(gone.size(), mesh.faces.size() - first);
        for (std::size_t i = 0; i < gone.size(); ++i) {
            ASSERT_EQ(gone[i], first + i);
        }
        mesh.faces.resize(first);
        EXPECT_EQ(mesh.faces, original.faces);
    }
}

TEST(EdgeHalving, RevertsNothingIfNoneMayJoin)
{
    std::mt19937 random(8);
    TriMesh mesh = octahedron();
    EdgeHalving halving(mesh, {});
    ASSERT_NO_FATAL_FAILURE(halve_some(mesh, halving, 10, random));
    const std::vector<Face> halved = mesh.faces;
    EXPECT_THAT(halving.take_back(kNever), IsEmpty());
    EXPECT_EQ(mesh.faces, halved);
}

TEST(EdgeHalving, RevertsABisectionOnlyIfAllItsHalvesMayJoin)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {});
    halving.halve(0, 2);
    const std::vector<Face> halved = mesh.faces;
    const auto gone = halving.take_back([](std::uint32_t face, std::uint32_t other_half) {
        EXPECT_EQ(other_half, face + 2);
        return face == 0;
    });
    EXPECT_THAT(gone, IsEmpty());
    EXPECT_EQ(mesh.faces, halved);
}

TEST(EdgeHalving, KeepsABisectionIfAHalfRemainsBisected)
{
    const TriMesh original = square();
    TriMesh mesh = original;
    EdgeHalving halving(mesh, {});
    halving.halve(0, 2); // face 0 is 0 1 4, face 2 its other half
    halving.halve(0, 1); // face 0 again: face 4 is its other half
    halving.halve(2, 3); // face 3, the other half of face 1: face 5
    const std::vector<Face> halved = mesh.faces;
    const auto gone =
        halving.take_back([](std::uint32_t, std::uint32_t other_half) { return other_half != 4; });
    EXPECT_THAT(gone, ElementsAre(5)) << "the last bisection is independent of it";
    std::vector<Face> expected = halved;
    expected[3] = {2, 3, 4};
    EXPECT_EQ(mesh.faces, expected);
}

TEST(EdgeHalving, KeepsABisectionIfTheOtherHalfRemainsBisected)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {});
    halving.halve(0, 2);
    halving.halve(1, 2); // face 2, the other half of face 0: face 4
    const std::vector<Face> halved = mesh.faces;
    const auto gone =
        halving.take_back([](std::uint32_t, std::uint32_t other_half) { return other_half != 4; });
    EXPECT_THAT(gone, IsEmpty());
    EXPECT_EQ(mesh.faces, halved);
}

TEST(EdgeHalving, RevertsBisectionsAfterOneThatRemains)
{
    TriMesh mesh = square();
    EdgeHalving halving(mesh, {});
    halving.halve(0, 2);
    const std::vector<Face> first = mesh.faces;
    halving.halve(0, 4);
    halving.halve(1, 2);
    const auto gone =
        halving.take_back([](std::uint32_t, std::uint32_t other_half) { return other_half > 3; });
    EXPECT_THAT(gone, UnorderedElementsAre(4, 5, 6));
    mesh.faces.resize(first.size());
    EXPECT_EQ(mesh.faces, first);
}

TEST(EdgeHalving, LeavesNoVertexInsideAnEdgeAfterPartialRevert)
{
    std::mt19937 random(9);
    for (int round = 0; round < 50; ++round) {
        TriMesh mesh = octahedron();
        EdgeHalving halving(mesh, {});
        ASSERT_NO_FATAL_FAILURE(halve_some(mesh, halving, 25, random));
        const std::uint32_t salt = random();
        const auto gone = halving.take_back([&](std::uint32_t face, std::uint32_t other_half) {
            return (face * 7 + other_half * 13 + salt) % 8 != 0;
        });
        TriMesh rest = mesh;
        rest.faces.clear();
        for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
            if (std::ranges::count(gone, face) == 0) rest.faces.push_back(mesh.faces[face]);
        }
        const MeshCheck check = check_mesh(rest);
        ASSERT_TRUE(check.is_closed());
        ASSERT_TRUE(check.is_manifold());
        ASSERT_EQ(check.orientation_faults, 0);
        ASSERT_NEAR(volume(rest), volume(octahedron()), 1e-9);
        ASSERT_NEAR(check.area, check_mesh(octahedron()).area, 1e-9);
    }
}

} // namespace
} // namespace vcarve::edge_halving_test
