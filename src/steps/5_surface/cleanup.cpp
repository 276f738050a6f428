#include "steps/5_surface/cleanup.h"

#include "base/median.h"
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

/// The longest edge of every face.
std::vector<double> longest_edges(const HalfEdgeMesh& mesh)
{
    std::vector<double> lengths(mesh.n_faces());
    parallel_for(lengths.size(), [&](std::size_t face) {
        for (const EdgeHandle edge : mesh.fe_range(handle_at<FaceHandle>(face))) {
            lengths[face] = std::max(lengths[face], mesh.calc_edge_length(edge));
        }
    });
    return lengths;
}

/// What is to be known of a piece.
struct Piece {
    std::int64_t faces = 0;
    bool is_compact = true; ///< closed, and none of its faces is long
};

/// Of each piece, at its first face.
std::vector<Piece> measure_pieces(const HalfEdgeMesh& mesh, UnionFind& pieces)
{
    constexpr double kLong = 2.0; // times as long as the median face
    const std::vector<double> lengths = longest_edges(mesh);
    std::vector<double> by_length = lengths;
    const double most = lengths.empty() ? 0.0 : kLong * median_in_place(by_length);
    std::vector<Piece> found(lengths.size());
    for (std::uint32_t i = 0; i < lengths.size(); ++i) {
        Piece& piece = found[pieces.root(i)];
        ++piece.faces;
        if (lengths[i] > most || mesh.is_boundary(handle_at<FaceHandle>(i)))
            piece.is_compact = false;
    }
    return found;
}

/// Deletes pieces of fewer faces, compact ones of fewer than half as many; of the largest ones the
/// first stays in any case. Returns how many pieces went.
std::int64_t delete_small_pieces(HalfEdgeMesh& mesh, int min_faces)
{
    UnionFind pieces = find_pieces(mesh);
    const auto num_faces = static_cast<std::uint32_t>(mesh.n_faces());
    const std::vector<Piece> found = measure_pieces(mesh, pieces);
    const auto largest = std::ranges::max_element(found, {}, &Piece::faces) - found.begin();
    const auto is_small = [&](std::uint32_t piece) {
        const auto [faces, is_compact] = found[piece];
        return piece != largest && (is_compact ? 2 * faces : faces) < min_faces;
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
