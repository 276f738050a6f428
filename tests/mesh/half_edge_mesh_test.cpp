#include "mesh/edge_table.h"
#include "steps/6_surface/split_nonmanifold.h"
#include "support/half_edges.h"
#include "support/tetra_grid.h"

#include <gtest/gtest.h>

#include <random>

namespace vcarve::half_edge_mesh_test {
namespace {

using Eigen::Vector3d;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using testing::half_edges;

/// A square pyramid without a base, whose apex is vertex 0, and a vertex without faces.
TriMesh pyramid()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {7, 7, 7}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
    mesh.offset = {1, 2, 3};
    for (std::uint32_t v = 0; v < 6; ++v) {
        mesh.colors.push_back({static_cast<std::uint8_t>(v), 5, 6});
        mesh.points.push_back(10 * v);
    }
    return mesh;
}

TEST(HalfEdgeMesh, KeepsOrderAndDropsVerticesWithoutFaces)
{
    const TriMesh mesh = pyramid();
    const TriMesh same = tri_mesh(half_edges(mesh));
    EXPECT_EQ(same.faces, mesh.faces);
    EXPECT_EQ(same.offset, mesh.offset);
    EXPECT_EQ(same.positions, std::vector(mesh.positions.begin(), mesh.positions.end() - 1));
    EXPECT_EQ(same.colors, std::vector(mesh.colors.begin(), mesh.colors.end() - 1));
    EXPECT_EQ(same.points, std::vector(mesh.points.begin(), mesh.points.end() - 1));
}

TEST(HalfEdgeMesh, AddsNoColorsOrPoints)
{
    TriMesh mesh = pyramid();
    mesh.colors.clear();
    mesh.points.clear();
    const TriMesh same = tri_mesh(half_edges(mesh));
    EXPECT_TRUE(same.colors.empty());
    EXPECT_TRUE(same.points.empty());
}

TEST(HalfEdgeMesh, OmitsDeletedFacesAndVertices)
{
    HalfEdgeMesh mesh = half_edges(pyramid());
    mesh.delete_face(FaceHandle(1));
    EXPECT_EQ(num_faces_left(mesh), 3);
    EXPECT_EQ(num_vertices_left(mesh), 5);
    EXPECT_EQ(tri_mesh(mesh).faces, (std::vector<Face>{{0, 1, 2}, {0, 3, 4}, {0, 4, 1}}));
    mesh.delete_face(FaceHandle(0));
    EXPECT_EQ(num_vertices_left(mesh), 4);
    EXPECT_EQ(tri_mesh(mesh).faces, (std::vector<Face>{{0, 2, 3}, {0, 3, 1}}));
    EXPECT_EQ(tri_mesh(mesh).points, (std::vector<std::uint32_t>{0, 10, 30, 40}));
}

/// Expects equal handles of two meshes.
void expect_same_connections(const HalfEdgeMesh& mesh, const HalfEdgeMesh::OpenMeshBase& expected)
{
    ASSERT_EQ(mesh.n_vertices(), expected.n_vertices());
    ASSERT_EQ(mesh.n_halfedges(), expected.n_halfedges());
    ASSERT_EQ(mesh.n_faces(), expected.n_faces());
    for (std::size_t h = 0; h < mesh.n_halfedges(); ++h) {
        const auto edge = handle_at<HalfedgeHandle>(h);
        ASSERT_EQ(mesh.to_vertex_handle(edge).idx(), expected.to_vertex_handle(edge).idx());
        ASSERT_EQ(mesh.face_handle(edge).idx(), expected.face_handle(edge).idx());
        ASSERT_EQ(mesh.next_halfedge_handle(edge).idx(), expected.next_halfedge_handle(edge).idx());
        ASSERT_EQ(mesh.prev_halfedge_handle(edge).idx(), expected.prev_halfedge_handle(edge).idx());
    }
    for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
        const auto face = handle_at<FaceHandle>(f);
        ASSERT_EQ(mesh.halfedge_handle(face).idx(), expected.halfedge_handle(face).idx());
    }
    for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
        const auto vertex = handle_at<VertexHandle>(v);
        ASSERT_EQ(mesh.is_isolated(vertex), expected.is_isolated(vertex));
        ASSERT_EQ(mesh.is_boundary(vertex), expected.is_boundary(vertex));
        // For an interior vertex, OpenMesh may choose any half-edge.
        if (!mesh.is_boundary(vertex)) continue;
        ASSERT_EQ(mesh.halfedge_handle(vertex).idx(), expected.halfedge_handle(vertex).idx());
    }
}

TEST(HalfEdgeMesh, EqualsMeshBuiltFaceByFaceWithOpenMesh)
{
    const testing::TetraGrid grid = testing::tetra_grid(4);
    std::mt19937 random(31);
    for (int round = 0; round < 20; ++round) {
        TriMesh mesh = testing::boundary_of(
            grid, testing::random_labels(grid.cells.size(), 0.1 + 0.04 * round, random));
        if (round % 2 == 1) {
            std::erase_if(mesh.faces, [&](const Face&) { return random() % 10 == 0; });
        }
        const ManifoldSurface manifold = split_nonmanifold(mesh);
        const HalfEdgeMesh made(manifold.mesh, manifold.twins);
        ASSERT_NO_FATAL_FAILURE(
            expect_same_connections(made, testing::half_edges_face_by_face(manifold.mesh)))
            << "round " << round;
    }
}

TEST(VertexNormal, IsTheAreaWeightedMeanOfFaceNormals)
{
    // Three faces of areas 1/2, 1 and 1 with normals z, x and y; first a disk, then fans of two.
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    const Vector3d closed = vertex_normal(half_edges(mesh), VertexHandle(0));
    EXPECT_NEAR((closed - Vector3d(2, 2, 1) / 3.0).norm(), 0.0, 1e-15);
    for (std::size_t first = 0; first < 3; ++first) {
        TriMesh open = mesh;
        open.faces = {mesh.faces[first], mesh.faces[(first + 1) % 3]};
        Vector3d sum = Vector3d::Zero();
        for (const Face& face : open.faces) {
            const Vector3d& a = mesh.positions[face[0]];
            sum += (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a);
        }
        const Vector3d normal = vertex_normal(half_edges(open), VertexHandle(0));
        EXPECT_NEAR((normal - sum.normalized()).norm(), 0.0, 1e-15);
    }
}

TEST(VertexNormal, IsZeroIfNoFaceHasAnArea)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 1}};
    mesh.faces = {{0, 1, 2}};
    const HalfEdgeMesh surface = half_edges(mesh);
    EXPECT_EQ(vertex_normal(surface, VertexHandle(0)), Vector3d(0, 0, 0));
    EXPECT_EQ(vertex_normal(surface, VertexHandle(3)), Vector3d(0, 0, 0));
}

} // namespace
} // namespace vcarve::half_edge_mesh_test
