#include "steps/5_surface/cleanup.h"

#include "mesh/half_edge_mesh.h"
#include "steps/5_surface/fill_holes.h"
#include "steps/5_surface/split_nonmanifold.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <algorithm>

namespace vcarve {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

/// The number of each face's piece; pieces are numbered by their first faces.
std::vector<std::uint32_t> find_pieces(const HalfEdgeMesh& mesh)
{
    std::vector<std::uint32_t> pieces(mesh.n_faces());
    const HalfEdgeMesh::OpenMeshBase& graph = mesh;
    CGAL::Polygon_mesh_processing::connected_components(
        graph, boost::make_iterator_property_map(pieces.begin(), get(CGAL::face_index, graph)));
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
    const std::vector<std::uint32_t> pieces = find_pieces(mesh);
    std::vector<std::int64_t> sizes;
    for (const std::uint32_t piece : pieces) {
        sizes.resize(std::max<std::size_t>(sizes.size(), piece + 1));
        ++sizes[piece];
    }
    const auto largest = std::ranges::max_element(sizes) - sizes.begin();
    const auto is_small = [&](std::uint32_t piece) {
        return piece != largest && sizes[piece] < min_faces;
    };
    for (std::size_t face = 0; face < pieces.size(); ++face) {
        if (is_small(pieces[face])) delete_with_vertices(mesh, handle_at<FaceHandle>(face));
    }
    std::int64_t num_small = 0;
    for (std::uint32_t piece = 0; piece < sizes.size(); ++piece) {
        num_small += is_small(piece) ? 1 : 0;
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
    result.counts.filled_holes = fill_holes(mesh, options.max_hole_edges);
    set_vertex_normals(mesh);
    result.counts.vertices = num_vertices_left(mesh);
    result.counts.faces = num_faces_left(mesh);
    result.counts.removed_vertices =
        static_cast<std::int64_t>(mesh.n_vertices()) - result.counts.vertices;
    return result;
}

} // namespace vcarve
