#include "mesh/check.h"
#include "steps/5_surface/fill_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve {
namespace {

using Eigen::Vector3d;

std::vector<Face> faces_of(const HalfEdgeMesh& mesh)
{
    std::vector<Face> faces;
    for (const auto face : mesh.faces()) {
        Face corners{};
        std::size_t i = 0;
        for (const auto vertex : mesh.fv_range(face)) {
            corners[i++] = static_cast<std::uint32_t>(vertex.idx());
        }
        faces.push_back(corners);
    }
    return faces;
}

MeshCheck check_of(const HalfEdgeMesh& mesh)
{
    TriMesh soup;
    soup.positions.resize(mesh.n_vertices(), Vector3d::Zero());
    soup.faces = faces_of(mesh);
    return check_mesh(soup);
}

/// A tube of `n` sides around the z axis, open at both ends; its lower end is vertices 0 to n - 1.
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

TEST(HalfEdgeMesh, KeepsNumbersColorsAndPoints)
{
    const TriMesh mesh = tube(5);
    const HalfEdgeMesh half_edges = half_edge_mesh(mesh);
    EXPECT_EQ(faces_of(half_edges), mesh.faces);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const OpenMesh::VertexHandle vertex(static_cast<int>(v));
        const OpenMesh::Vec3d& p = half_edges.point(vertex);
        EXPECT_EQ(Vector3d(p[0], p[1], p[2]), mesh.positions[v]);
        EXPECT_EQ(half_edges.data(vertex).color, mesh.colors[v]);
        EXPECT_EQ(half_edges.data(vertex).point, mesh.points[v]);
    }
}

TEST(VertexNormal, IsTheMeanOfTheFacesByArea)
{
    // Three faces of areas 1/2, 1 and 3/2 with normals z, -y and x, open or not makes no
    // difference.
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    const OpenMesh::Vec3d closed = vertex_normal(half_edge_mesh(mesh), OpenMesh::VertexHandle(0));
    const OpenMesh::Vec3d expected = OpenMesh::Vec3d(2, 2, 1) / 3.0;
    EXPECT_NEAR((closed - expected).norm(), 0.0, 1e-15);
    for (std::size_t first = 0; first < 3; ++first) {
        TriMesh open = mesh;
        open.faces = {mesh.faces[first], mesh.faces[(first + 1) % 3]};
        OpenMesh::Vec3d sum(0, 0, 0);
        for (const std::size_t f : {first, (first + 1) % 3}) {
            const Vector3d& a = mesh.positions[mesh.faces[f][0]];
            const Vector3d area =
                (mesh.positions[mesh.faces[f][1]] - a).cross(mesh.positions[mesh.faces[f][2]] - a);
            sum += OpenMesh::Vec3d(area.x(), area.y(), area.z());
        }
        const OpenMesh::Vec3d normal =
            vertex_normal(half_edge_mesh(open), OpenMesh::VertexHandle(0));
        EXPECT_NEAR((normal - sum.normalized()).norm(), 0.0, 1e-15);
    }
}

TEST(VertexNormal, IsZeroWhereNoFaceHasAnArea)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 1}};
    mesh.faces = {{0, 1, 2}};
    const HalfEdgeMesh half_edges = half_edge_mesh(mesh);
    EXPECT_EQ(vertex_normal(half_edges, OpenMesh::VertexHandle(0)), OpenMesh::Vec3d(0, 0, 0));
    EXPECT_EQ(vertex_normal(half_edges, OpenMesh::VertexHandle(3)), OpenMesh::Vec3d(0, 0, 0));
}

TEST(BoundaryLoops, RunAlongEveryBorderOnce)
{
    const HalfEdgeMesh mesh = half_edge_mesh(tube(7));
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
        const HalfEdgeMesh half_edges = half_edge_mesh(mesh);
        return touches_itself(half_edges, boundary_loops(half_edges)[0]);
    };
    TriMesh mesh = tube(6);
    EXPECT_FALSE(first_loop_touches_itself(mesh));
    mesh.positions[3] = mesh.positions[0];
    EXPECT_TRUE(first_loop_touches_itself(mesh));
}

TEST(IsRim, TellsAPatchFromAHole)
{
    const auto first_loop_is_rim = [](const TriMesh& mesh) {
        const HalfEdgeMesh half_edges = half_edge_mesh(mesh);
        return is_rim(half_edges, boundary_loops(half_edges)[0]);
    };
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}};
    EXPECT_TRUE(first_loop_is_rim(mesh)); // a lone triangle
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    EXPECT_FALSE(first_loop_is_rim(mesh)); // a tetrahedron without a side
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
    HalfEdgeMesh half_edges = half_edge_mesh(mesh);
    fill_hole(half_edges, boundary_loops(half_edges)[0]);
    EXPECT_EQ(half_edges.n_faces(), 4U);
    EXPECT_EQ(half_edges.n_vertices(), 4U);
    EXPECT_TRUE(check_of(half_edges).is_closed());
    EXPECT_EQ(check_of(half_edges).orientation_faults, 0);
}

/// Least total area of a triangulated polygon by trying every one.
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
        for (std::uint32_t i = 0; i < n; ++i) { // lift the lower end out of its plane
            mesh.positions[i].z() = std::sin(3.0 * i) / 2;
        }
        HalfEdgeMesh half_edges = half_edge_mesh(mesh);
        for (const BoundaryLoop& loop : boundary_loops(half_edges)) {
            std::vector<Vector3d> polygon;
            for (const auto edge : loop) {
                const OpenMesh::Vec3d& p = half_edges.point(half_edges.from_vertex_handle(edge));
                polygon.emplace_back(p[0], p[1], p[2]);
            }
            const std::size_t num_before = half_edges.n_faces();
            fill_hole(half_edges, loop);
            double area = 0.0;
            for (std::size_t f = num_before; f < half_edges.n_faces(); ++f) {
                const OpenMesh::FaceHandle face(static_cast<int>(f));
                area += half_edges.calc_sector_area(half_edges.halfedge_handle(face));
            }
            EXPECT_NEAR(area, least_area(polygon), 1e-12) << n << " edges";
        }
        EXPECT_EQ(half_edges.n_vertices(), 2 * n);
        EXPECT_TRUE(check_of(half_edges).is_closed());
        EXPECT_EQ(check_of(half_edges).euler_characteristic, 2);
    }
}

TEST(FillHole, NeverUsesAnEdgeThatIsThere)
{
    // A square patch whose rim is filled: the diagonal 0 2 is taken, 1 3 is left.
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    HalfEdgeMesh half_edges = half_edge_mesh(mesh);
    fill_hole(half_edges, boundary_loops(half_edges)[0]);
    EXPECT_TRUE(
        half_edges.find_halfedge(OpenMesh::VertexHandle(1), OpenMesh::VertexHandle(3)).is_valid());
    EXPECT_EQ(half_edges.n_faces(), 4U);
    EXPECT_TRUE(check_of(half_edges).is_closed());
}

TEST(FillHole, TakesAVertexInTheMiddleWhereEveryChordIsTaken)
{
    // The torus of seven vertices has an edge between any two of them. Without vertex 6 it has a
    // hole of six edges, all of whose chords are there.
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
    HalfEdgeMesh half_edges = half_edge_mesh(mesh);
    const std::vector<BoundaryLoop> loops = boundary_loops(half_edges);
    ASSERT_EQ(loops.size(), 1U);
    ASSERT_EQ(loops[0].size(), 6U);
    fill_hole(half_edges, loops[0]);
    const OpenMesh::VertexHandle middle(7);
    EXPECT_EQ(half_edges.n_vertices(), 8U);
    EXPECT_EQ(half_edges.n_faces(), 14U);
    EXPECT_NEAR((half_edges.point(middle) - OpenMesh::Vec3d(15, 55, 225) / 6.0).norm(), 0, 1e-13);
    EXPECT_EQ(half_edges.data(middle).color, (Color{25, 255, 0}));
    EXPECT_EQ(half_edges.data(middle).point, kNoPoint);
    EXPECT_TRUE(check_of(half_edges).is_closed());
    EXPECT_TRUE(check_of(half_edges).is_manifold());
    EXPECT_EQ(check_of(half_edges).orientation_faults, 0);
    EXPECT_EQ(check_of(half_edges).euler_characteristic, 0);
}

} // namespace
} // namespace vcarve
