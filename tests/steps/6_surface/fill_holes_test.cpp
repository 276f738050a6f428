#include "mesh/check.h"
#include "steps/6_surface/fill_holes.h"
#include "support/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve::fill_holes_test {
namespace {

using Eigen::Vector3d;
using testing::half_edges;

MeshCheck check_of(const HalfEdgeMesh& mesh)
{
    return check_mesh(tri_mesh(mesh));
}

/// An open tube of `n` sides around the z axis. Vertices 0 to n - 1 are its lower end.
TriMesh tube(std::uint32_t n)
{
    TriMesh mesh;
    for (std::uint32_t i = 0; i < 2 * n; ++i) {
        const double angle = 2 * std::numbers::pi * (i % n) / n;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), i < n ? 0.0 : 1.0);
        mesh.colors.push_back({static_cast<std::uint8_t>(i < n ? 10 * i : 200), 0, 3});
        mesh.points.push_back(i);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.faces.push_back({i, j, n + j});
        mesh.faces.push_back({i, n + j, n + i});
    }
    return mesh;
}

TEST(BoundaryLoops, FollowEveryBoundaryOnce)
{
    const HalfEdgeMesh mesh = half_edges(tube(7));
    const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
    ASSERT_EQ(loops.size(), 2U);
    for (const BoundaryLoop& loop : loops) {
        ASSERT_EQ(loop.size(), 7U);
        for (std::size_t i = 0; i < 7; ++i) {
            EXPECT_TRUE(mesh.is_boundary(loop[i]));
            EXPECT_EQ(mesh.to_vertex_handle(loop[i]), mesh.from_vertex_handle(loop[(i + 1) % 7]));
        }
    }
}

TEST(BoundaryLoop, TouchesItselfAtCopiesOfAVertex)
{
    const auto first_loop_touches_itself = [](const TriMesh& mesh) {
        const HalfEdgeMesh surface = half_edges(mesh);
        return touches_itself(surface, boundary_loops(surface)[0]);
    };
    TriMesh mesh = tube(6);
    EXPECT_FALSE(first_loop_touches_itself(mesh));
    mesh.positions[3] = mesh.positions[0];
    EXPECT_TRUE(first_loop_touches_itself(mesh));
}

TEST(IsRim, DistinguishesAPatchFromAHole)
{
    const auto first_loop_is_rim = [](const TriMesh& mesh) {
        const HalfEdgeMesh surface = half_edges(mesh);
        return is_rim(surface, boundary_loops(surface)[0]);
    };
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}};
    EXPECT_TRUE(first_loop_is_rim(mesh)); // a lone triangle
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    EXPECT_FALSE(first_loop_is_rim(mesh)); // a tetrahedron without a face
    EXPECT_FALSE(first_loop_is_rim(tube(6)));
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0.3}};
    mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    EXPECT_TRUE(first_loop_is_rim(mesh)); // a flat pyramid without its base
    mesh.positions[4] = {0, 0, 3};
    EXPECT_FALSE(first_loop_is_rim(mesh)); // a steep one
}

TEST(FillHole, ClosesATriangleWithOneFace)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    HalfEdgeMesh surface = half_edges(mesh);
    fill_hole(surface, boundary_loops(surface)[0]);
    EXPECT_EQ(surface.n_faces(), 4U);
    EXPECT_EQ(surface.n_vertices(), 4U);
    EXPECT_TRUE(check_of(surface).is_closed());
    EXPECT_EQ(check_of(surface).orientation_faults, 0);
}

/// Least total area of all triangulations of a polygon.
double least_area(const std::vector<Vector3d>& polygon)
{
    if (polygon.size() < 3) return 0.0;
    double least = 1e300;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Vector3d& a = polygon.front();
        const double area = (polygon[k] - a).cross(polygon.back() - a).norm() / 2;
        const auto middle = polygon.begin() + static_cast<std::ptrdiff_t>(k);
        least = std::min(least, area + least_area({polygon.begin(), middle + 1}) +
                                    least_area({middle, polygon.end()}));
    }
    return least;
}

TEST(FillHole, FindsTheLeastArea)
{
    for (std::uint32_t n = 4; n < 10; ++n) {
        TriMesh mesh = tube(n);
        for (std::uint32_t i = 0; i < n; ++i) { // make the lower end non-planar
            mesh.positions[i].z() = std::sin(3.0 * i) / 2;
        }
        HalfEdgeMesh surface = half_edges(mesh);
        for (const BoundaryLoop& loop : boundary_loops(surface)) {
            std::vector<Vector3d> polygon;
            for (const auto edge : loop) {
                polygon.push_back(surface.point(surface.from_vertex_handle(edge)));
            }
            const std::size_t num_before = surface.n_faces();
            fill_hole(surface, loop);
            double area = 0.0;
            for (std::size_t f = num_before; f < surface.n_faces(); ++f) {
                const auto face = handle_at<OpenMesh::FaceHandle>(f);
                area += surface.calc_sector_area(surface.halfedge_handle(face));
            }
            EXPECT_NEAR(area, least_area(polygon), 1e-12) << n << " edges";
        }
        EXPECT_EQ(surface.n_vertices(), 2 * n);
        EXPECT_TRUE(check_of(surface).is_closed());
        EXPECT_EQ(check_of(surface).euler_characteristic, 2);
    }
}

TEST(FillHole, NeverDuplicatesAnEdge)
{
    // A square patch whose outer boundary is filled. The diagonal 0 2 exists, so 1 3 is used.
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    HalfEdgeMesh surface = half_edges(mesh);
    fill_hole(surface, boundary_loops(surface)[0]);
    EXPECT_TRUE(
        surface.find_halfedge(OpenMesh::VertexHandle(1), OpenMesh::VertexHandle(3)).is_valid());
    EXPECT_EQ(surface.n_faces(), 4U);
    EXPECT_TRUE(check_of(surface).is_closed());
}

TEST(FillHole, AddsACenterVertexIfAllChordsExist)
{
    // The torus of seven vertices has an edge between any two of them. Without vertex 6, it has a
    // hole of six edges, all of whose chords exist.
    TriMesh mesh;
    for (std::uint32_t i = 0; i < 7; ++i) {
        mesh.positions.emplace_back(i, i * i, i * i * i);
        mesh.colors.push_back({static_cast<std::uint8_t>(10 * i), 255, 0});
        mesh.points.push_back(i);
        for (const Face face :
             {Face{i, (i + 1) % 7, (i + 3) % 7}, Face{i, (i + 3) % 7, (i + 2) % 7}}) {
            if (std::ranges::count(face, 6U) == 0) mesh.faces.push_back(face);
        }
    }
    HalfEdgeMesh surface = half_edges(mesh);
    const std::vector<BoundaryLoop> loops = boundary_loops(surface);
    ASSERT_EQ(loops.size(), 1U);
    ASSERT_EQ(loops[0].size(), 6U);
    fill_hole(surface, loops[0]);
    const OpenMesh::VertexHandle middle(7);
    EXPECT_EQ(surface.n_vertices(), 8U);
    EXPECT_EQ(surface.n_faces(), 14U);
    EXPECT_NEAR((surface.point(middle) - Vector3d(15, 55, 225) / 6.0).norm(), 0, 1e-13);
    EXPECT_EQ(surface.data(middle).color, (Color{25, 255, 0}));
    EXPECT_EQ(surface.data(middle).scene_point, kNoPoint);
    EXPECT_TRUE(check_of(surface).is_closed());
    EXPECT_TRUE(check_of(surface).is_manifold());
    EXPECT_EQ(check_of(surface).orientation_faults, 0);
    EXPECT_EQ(check_of(surface).euler_characteristic, 0);
}

TEST(FillHoles, SkipsDeletedComponentsAndOuterBoundaries)
{
    // Two distant tubes and a lone triangle.
    TriMesh mesh = tube(5);
    for (const Vector3d& position : tube(5).positions) {
        mesh.positions.emplace_back(position + Vector3d(9, 0, 0));
    }
    for (const Face& face : tube(5).faces) {
        mesh.faces.push_back({face[0] + 10, face[1] + 10, face[2] + 10});
    }
    mesh.positions.insert(mesh.positions.end(), {{0, 9, 0}, {1, 9, 0}, {0, 10, 0}});
    mesh.faces.push_back({20, 21, 22});
    mesh.colors.clear();
    mesh.points.clear();
    HalfEdgeMesh surface = half_edges(mesh);
    for (std::size_t f = 10; f < 20; ++f) {
        surface.status(handle_at<OpenMesh::FaceHandle>(f)).set_deleted(true);
    }
    EXPECT_EQ(boundary_loops(surface).size(), 3U);
    EXPECT_EQ(fill_holes(surface, 4), 0);
    EXPECT_EQ(fill_holes(surface, 5), 2);
    EXPECT_EQ(boundary_loops(surface).size(), 1U);
    EXPECT_EQ(num_faces_left(surface), 10 + 1 + 2 * 3);
}

} // namespace
} // namespace vcarve::fill_holes_test
