#include "mesh/check.h"
#include "support/point_sets.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace vcarve::check_test {
namespace {

using Eigen::Vector3d;

/// A mesh of generic positions, which most checks do not use.
TriMesh mesh_of(std::size_t num_vertices, std::vector<Face> faces)
{
    TriMesh mesh;
    for (std::size_t v = 0; v < num_vertices; ++v) {
        const auto t = static_cast<double>(v);
        mesh.positions.emplace_back(t, t * t, t * t * t);
    }
    mesh.faces = std::move(faces);
    return mesh;
}

const std::vector<Face> kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(CheckMesh, ReturnsZeroCountsForEmptyMesh)
{
    const MeshCheck check = check_mesh({});
    EXPECT_EQ(check.vertices, 0);
    EXPECT_EQ(check.faces, 0);
    EXPECT_EQ(check.components, 0);
    EXPECT_EQ(check.euler_characteristic, 0);
    EXPECT_FALSE(check.is_closed());
    EXPECT_TRUE(check.is_manifold());
}

TEST(CheckMesh, FindsTetrahedronClosedAndManifold)
{
    TriMesh mesh = mesh_of(4, kTetrahedron);
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    const MeshCheck check = check_mesh(mesh);
    EXPECT_EQ(check.vertices, 4);
    EXPECT_EQ(check.faces, 4);
    EXPECT_EQ(check.degenerate_faces, 0);
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.boundary_edges, 0);
    EXPECT_EQ(check.nonmanifold_edges, 0);
    EXPECT_EQ(check.nonmanifold_vertices, 0);
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.unreferenced_vertices, 0);
    EXPECT_EQ(check.euler_characteristic, 2);
    EXPECT_DOUBLE_EQ(check.area, 6.0 + 2.0 * std::sqrt(3.0));
    EXPECT_TRUE(check.is_closed());
    EXPECT_TRUE(check.is_manifold());
}

TEST(CheckMesh, CountsBoundaryEdges)
{
    const MeshCheck check = check_mesh(mesh_of(4, {{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(check.boundary_edges, 4);
    EXPECT_EQ(check.euler_characteristic, 1);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_FALSE(check.is_closed());
}

TEST(CheckMesh, CountsEdgesOfThreeFacesAndTheirVertices)
{
    const MeshCheck check = check_mesh(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    EXPECT_EQ(check.nonmanifold_edges, 1);
    EXPECT_EQ(check.nonmanifold_vertices, 2);
    EXPECT_EQ(check.boundary_edges, 6);
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_FALSE(check.is_manifold());
}

TEST(CheckMesh, CountsVertexOfTwoFans)
{
    const MeshCheck check = check_mesh(mesh_of(5, {{0, 1, 2}, {0, 3, 4}}));
    EXPECT_EQ(check.nonmanifold_vertices, 1);
    EXPECT_EQ(check.nonmanifold_edges, 0);
    EXPECT_EQ(check.components, 2);
}

TEST(CheckMesh, CountsVertexOfTwoDisks)
{
    std::vector<Face> faces = kTetrahedron;
    for (const Face& face : kTetrahedron) {
        faces.push_back({face[0] + 3, face[1] + 3, face[2] + 3});
    }
    const MeshCheck check = check_mesh(mesh_of(7, faces));
    EXPECT_EQ(check.nonmanifold_vertices, 1);
    EXPECT_EQ(check.components, 2);
    EXPECT_TRUE(check.is_closed());
    EXPECT_FALSE(check.is_manifold());
}

TEST(CheckMesh, CountsEdgesOfInconsistentOrientation)
{
    std::vector<Face> faces = kTetrahedron;
    std::swap(faces[2][0], faces[2][1]);
    EXPECT_EQ(check_mesh(mesh_of(4, faces)).orientation_faults, 3);
}

TEST(CheckMesh, CountsVerticesWithoutFaces)
{
    EXPECT_EQ(check_mesh(mesh_of(9, kTetrahedron)).unreferenced_vertices, 5);
    EXPECT_EQ(check_mesh(mesh_of(9, kTetrahedron)).euler_characteristic, 2);
}

TEST(CheckMesh, CountsDegenerateFacesSeparately)
{
    std::vector<Face> faces = kTetrahedron;
    faces.push_back({0, 0, 1});
    faces.push_back({4, 5, 4});
    const MeshCheck check = check_mesh(mesh_of(6, faces));
    EXPECT_EQ(check.faces, 6);
    EXPECT_EQ(check.degenerate_faces, 2);
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.unreferenced_vertices, 2);
    EXPECT_EQ(check.euler_characteristic, 2);
    EXPECT_TRUE(check.is_closed());
    EXPECT_TRUE(check.is_manifold());
}

/// Implements the definitions of MeshCheck literally, without an edge table.
MeshCheck check_by_definition(const TriMesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::pair<std::size_t, bool>>>
        edges;
    std::set<std::uint32_t> used;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.faces[f][i];
            const std::uint32_t b = mesh.faces[f][(i + 1) % 3];
            edges[std::minmax(a, b)].emplace_back(f, a < b);
            used.insert(a);
        }
    }
    MeshCheck check;
    for (const auto& [edge, faces] : edges) {
        check.boundary_edges += faces.size() == 1;
        check.nonmanifold_edges += faces.size() > 2;
        check.orientation_faults += faces.size() == 2 && faces[0].second == faces[1].second;
    }
    check.unreferenced_vertices = static_cast<std::int64_t>(mesh.positions.size() - used.size());
    check.euler_characteristic = static_cast<std::int64_t>(used.size()) -
                                 static_cast<std::int64_t>(edges.size()) +
                                 static_cast<std::int64_t>(mesh.faces.size());
    // The number of components of `members` when connected by edges that satisfy `crosses`.
    const auto pieces = [&](std::set<std::size_t> members, auto crosses) {
        std::int64_t count = 0;
        while (!members.empty()) {
            std::vector<std::size_t> stack{*members.begin()};
            members.erase(members.begin());
            ++count;
            while (!stack.empty()) {
                const std::size_t here = stack.back();
                stack.pop_back();
                for (const auto& [edge, faces] : edges) {
                    const auto is_here = [&](const auto& entry) { return entry.first == here; };
                    if (!crosses(edge) || std::ranges::none_of(faces, is_here)) continue;
                    for (const auto& [face, forward] : faces) {
                        if (members.erase(face) > 0) stack.push_back(face);
                    }
                }
            }
        }
        return count;
    };
    std::set<std::size_t> all;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        all.insert(f);
    }
    check.components = pieces(all, [](const auto&) { return true; });
    for (const std::uint32_t v : used) {
        std::set<std::size_t> around;
        bool crowded = false;
        const auto touches = [&](const auto& edge) { return edge.first == v || edge.second == v; };
        for (const auto& [edge, faces] : edges) {
            if (!touches(edge)) continue;
            crowded |= faces.size() > 2;
            for (const auto& [face, forward] : faces) {
                around.insert(face);
            }
        }
        check.nonmanifold_vertices += crowded || pieces(around, touches) > 1;
    }
    return check;
}

TEST(CheckMesh, MatchesDefinitionsOnRandomSoups)
{
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        const std::uint32_t num_vertices = 4 + random() % 12;
        TriMesh mesh = mesh_of(num_vertices, {});
        const std::size_t num_faces = 1 + random() % 16;
        while (mesh.faces.size() < num_faces) {
            const Face face{static_cast<std::uint32_t>(random() % num_vertices),
                            static_cast<std::uint32_t>(random() % num_vertices),
                            static_cast<std::uint32_t>(random() % num_vertices)};
            const bool degenerate = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
            if (!degenerate) mesh.faces.push_back(face);
        }
        const MeshCheck check = check_mesh(mesh);
        const MeshCheck expected = check_by_definition(mesh);
        ASSERT_EQ(check.components, expected.components) << "round " << round;
        ASSERT_EQ(check.boundary_edges, expected.boundary_edges) << "round " << round;
        ASSERT_EQ(check.nonmanifold_edges, expected.nonmanifold_edges) << "round " << round;
        ASSERT_EQ(check.nonmanifold_vertices, expected.nonmanifold_vertices) << "round " << round;
        ASSERT_EQ(check.orientation_faults, expected.orientation_faults) << "round " << round;
        ASSERT_EQ(check.unreferenced_vertices, expected.unreferenced_vertices);
        ASSERT_EQ(check.euler_characteristic, expected.euler_characteristic) << "round " << round;
    }
}

/// Three right triangles with legs of 1, and one with legs of `leg`.
TriMesh triangles(double leg)
{
    TriMesh mesh;
    for (const double length : {1.0, 1.0, 1.0, leg}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {length, 0, 0}, {0, length, 0}});
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TEST(LongArea, IsTheFractionOfFacesWithEdgesLongerThanMultipleOfMedian)
{
    // The edges are 1, 1 and 1.41 three times, and 4, 4 and 5.66: their median is 1.41.
    EXPECT_DOUBLE_EQ(long_area(triangles(4.0), 3.9), 8.0 / 9.5);
    EXPECT_DOUBLE_EQ(long_area(triangles(4.0), 4.1), 0.0);
    EXPECT_DOUBLE_EQ(long_area(triangles(4.0), 0.5), 1.0);
}

TEST(LongArea, HandlesMeshesWithoutArea)
{
    EXPECT_EQ(long_area(TriMesh(), 2.0), 0.0);
    EXPECT_EQ(long_area(triangles(0.0), 0.0), 1.0);
}

TriMesh mesh_of(Positions positions, std::vector<Face> faces)
{
    TriMesh mesh;
    mesh.positions = std::move(positions);
    mesh.faces = std::move(faces);
    return mesh;
}

std::int64_t intersections(Positions positions, std::vector<Face> faces)
{
    return count_self_intersections(mesh_of(std::move(positions), std::move(faces)));
}

const Positions kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(CountSelfIntersections, IgnoresCommonEdgesAndCorners)
{
    EXPECT_EQ(intersections(kSquare, {{0, 1, 2}, {0, 2, 3}}), 0);
    EXPECT_EQ(intersections({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 3}},
                            {{0, 1, 2}, {0, 3, 4}}),
              0);
}

TEST(CountSelfIntersections, MergesCopiesOfVertices)
{
    Positions positions = kSquare;
    positions.insert(positions.end(), {{0, 0, 0}, {-1, 0, 0}, {-1, 1, 3}});
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 0) << "at a corner";
    positions = kSquare;
    positions.insert(positions.end(), {{0, 0, 0}, {1, 1, 0}, {0, 0, 5}});
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 0) << "at an edge";
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}), 0);
    positions[6] = {1, 0, 0};
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 1) << "overlapping";
    positions[6] = {0.5, -1, 0};
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 1) << "folded back";
}

TEST(CountSelfIntersections, CountsFacesThatIntersectOrTouch)
{
    const auto beside = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        return intersections({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, a, b, c}, {{0, 1, 2}, {3, 4, 5}});
    };
    EXPECT_EQ(beside({0.5, 0.5, -1}, {0.5, 0.5, 1}, {5, 5, 1}), 1) << "through the face";
    EXPECT_EQ(beside({0.5, 0.5, 0}, {0.5, 0.5, 1}, {5, 5, 1}), 1) << "with a corner";
    EXPECT_EQ(beside({0.5, 0.5, 1e-300}, {0.5, 0.5, 1}, {5, 5, 1}), 0) << "just above it";
    EXPECT_EQ(beside({0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.2, 0.4, 0}), 1) << "within it";
    EXPECT_EQ(beside({1, 0, 0}, {3, 0, 0}, {2, -1, 0}), 1) << "along a part of an edge";
}

TEST(CountSelfIntersections, CountsOverlappingAndFoldedFaces)
{
    EXPECT_EQ(intersections(kSquare, {{0, 1, 2}, {0, 1, 3}}), 1) << "folded back at an edge";
    EXPECT_EQ(intersections(kSquare, {{0, 1, 2}, {2, 1, 0}}), 1) << "the same face twice";
    EXPECT_EQ(intersections({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}},
                            {{0, 1, 2}, {0, 3, 4}}),
              1)
        << "through the face from a common corner";
}

TEST(CountSelfIntersections, IgnoresDegenerateFaces)
{
    EXPECT_EQ(intersections({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}},
                            {{0, 1, 2}, {0, 1, 3}, {3, 3, 0}}),
              0);
}

TEST(CountSelfIntersections, MatchesCgalForFacesWithoutCommonCorners)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::mt19937_64 random(5);
    TriMesh mesh;
    std::vector<Kernel::Triangle_3> triangles;
    for (std::uint32_t f = 0; f < 300; ++f) {
        const Vector3d middle = even_in_cube(random, 0.0, 1.0);
        std::array<Kernel::Point_3, 3> corners;
        for (auto& corner : corners) {
            const Vector3d at = middle + even_in_cube(random, -0.2, 0.2);
            mesh.positions.push_back(at);
            corner = {at.x(), at.y(), at.z()};
        }
        mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
        triangles.emplace_back(corners[0], corners[1], corners[2]);
    }
    std::int64_t expected = 0;
    for (std::size_t a = 0; a < triangles.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            expected += CGAL::do_intersect(triangles[a], triangles[b]) ? 1 : 0;
        }
    }
    EXPECT_GT(expected, 100);
    EXPECT_EQ(count_self_intersections(mesh), expected);
}

} // namespace
} // namespace vcarve::check_test
