#include "steps/5_surface/cleanup.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "mesh/half_edge_mesh.h"
#include "steps/5_surface/fill_holes.h"
#include "steps/5_surface/split_nonmanifold.h"

#include <algorithm>

namespace vcarve {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

/// The faces joined through edges to pieces.
UnionFind find_pieces(const HalfEdgeMesh& mesh)
{
    UnionFind pieces(mesh.n_faces());
    parallel_for(mesh.n_edges(), [&](std::size_t i) {
        const auto edge = handle_at<EdgeHandle>(i);
        if (mesh.is_boundary(edge)) return;
        const FaceHandle a = mesh.face_handle(mesh.halfedge_handle(edge, 0));
        const FaceHandle b = mesh.face_handle(mesh.halfedge_handle(edge, 1));
        pieces.join(static_cast<std::uint32_t>(a.idx()), static_cast<std::uint32_t>(b.idx()));
    });
    return pieces;
}

void delete_with_vertices(HalfEdgeMesh& mesh, FaceHandle face)
{
    mesh.status(face).set_deleted(true);
    for (const VertexHandle vertex : mesh.corners(face)) {
        mesh.status(vertex).set_deleted(true);
    }
}

/// Deletes pieces of fewer faces; of the largest ones the first stays in any case. Returns how many
/// pieces went.
std::int64_t delete_small_pieces(HalfEdgeMesh& mesh, int min_faces)
{
    UnionFind pieces = find_pieces(mesh);
    const auto num_faces = static_cast<std::uint32_t>(mesh.n_faces());
    std::vector<std::int64_t> sizes(num_faces, 0); // of a piece at its first face
    for (std::uint32_t face = 0; face < num_faces; ++face) {
        ++sizes[pieces.root(face)];
    }
    const auto largest = std::ranges::max_element(sizes) - sizes.begin();
    const auto is_small = [&](std::uint32_t piece) {
        return piece != largest && sizes[piece] < min_faces;
    };
    std::int64_t num_small = 0;
    for (std::uint32_t face = 0; face < num_faces; ++face) {
        const std::uint32_t piece = pieces.root(face);
        if (!is_small(piece)) continue;
        delete_with_vertices(mesh, handle_at<FaceHandle>(face));
        num_small += piece == face ? 1 : 0;
    }
    return num_small;
}

} // namespace

CleanSurface clean_surface(TriMesh soup, const CleanupOptions& options)
{
    // OpenMesh cannot hold what is not manifold, and CGAL would cut it open along every such edge.
    ManifoldSurface manifold = split_nonmanifold(std::move(soup));
    CleanSurface result;
    result.mesh = std::make_unique<HalfEdgeMesh>(manifold.mesh, manifold.twins);
    result.counts.split_edges = manifold.split_edges;
    result.counts.split_vertices = manifold.split_vertices;

    // Small pieces go before holes are filled: a hole in one of them is none of ours.
    HalfEdgeMesh& mesh = *result.mesh;
    result.counts.removed_components = delete_small_pieces(mesh, options.min_component_faces);
    result.first_filled = mesh.n_faces();
    result.counts.filled_holes = fill_holes(mesh, options.max_hole_edges);
    set_vertex_normals(mesh);
    result.counts.vertices = num_vertices_left(mesh);
    result.counts.faces = num_faces_left(mesh);
    result.counts.removed_vertices =
        static_cast<std::int64_t>(mesh.n_vertices()) - result.counts.vertices;
    return result;
}

} // namespace vcarve
