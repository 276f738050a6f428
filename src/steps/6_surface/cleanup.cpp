#include "steps/6_surface/cleanup.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "base/union_find.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"
#include "steps/6_surface/fill_holes.h"
#include "steps/6_surface/split_nonmanifold.h"

#include <algorithm>

namespace vcarve {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

/// The connected components of the faces, joined through edges.
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

/// The edge length of a long face: twice the median longest edge.
double long_edge(const HalfEdgeMesh& mesh)
{
    constexpr double kLong = 2.0;
    std::vector<double> lengths(mesh.n_faces());
    parallel_for(lengths.size(), [&](std::size_t face) {
        lengths[face] = longest_edge(mesh.triangle(handle_at<FaceHandle>(face)));
    });
    return kLong * median_in_place(lengths);
}

/// Deletes components of fewer than `min_faces` faces. Compact components (closed, without long
/// faces) are deleted below half of that. The first of the largest components stays. Returns the
/// number of deleted components.
std::int64_t delete_small_pieces(HalfEdgeMesh& mesh, int min_faces)
{
    UnionFind pieces = find_pieces(mesh);
    const auto num_faces = static_cast<std::uint32_t>(mesh.n_faces());
    std::vector<std::int64_t> sizes(num_faces, 0); // of a component, at its first face
    for (std::uint32_t face = 0; face < num_faces; ++face) {
        ++sizes[pieces.root(face)];
    }
    const auto largest = std::ranges::max_element(sizes) - sizes.begin();
    const auto may_go = [&](std::uint32_t piece) {
        return piece != largest && sizes[piece] < min_faces;
    };
    std::vector<std::uint32_t> faces; // of small components
    for (std::uint32_t face = 0; face < num_faces; ++face) {
        if (may_go(pieces.root(face))) faces.push_back(face);
    }
    if (faces.empty()) return 0;
    const double most = long_edge(mesh);
    std::vector<char> is_compact(num_faces, 1); // of a component, at its first face
    for (const std::uint32_t i : faces) {
        const auto face = handle_at<FaceHandle>(i);
        if (mesh.is_boundary(face) || longest_edge(mesh.triangle(face)) > most)
            is_compact[pieces.root(i)] = 0;
    }
    std::int64_t num_small = 0;
    for (const std::uint32_t face : faces) {
        const std::uint32_t piece = pieces.root(face);
        if (is_compact[piece] != 0 && 2 * sizes[piece] >= min_faces) continue;
        delete_with_vertices(mesh, handle_at<FaceHandle>(face));
        num_small += piece == face ? 1 : 0;
    }
    return num_small;
}

} // namespace

std::int64_t drop_small_components(TriMesh& mesh, double min_area)
{
    UnionFind components(mesh.positions.size());
    for (const Face& face : mesh.faces) {
        components.join(face[0], face[1]);
        components.join(face[0], face[2]);
    }
    std::vector<double> areas(mesh.positions.size());
    for (const Face& face : mesh.faces) {
        areas[components.root(face[0])] += face_area(mesh.positions, face);
    }
    const double least = std::min(min_area, areas.empty() ? 0.0 : std::ranges::max(areas));
    const auto dropped =
        std::ranges::count_if(areas, [&](double each) { return each > 0.0 && each < least; });
    std::erase_if(mesh.faces,
                  [&](const Face& face) { return areas[components.root(face[0])] < least; });
    return dropped;
}

CleanSurface clean_surface(TriMesh soup, const CleanupOptions& options)
{
    // OpenMesh requires manifold input, and CGAL would cut the mesh open along each such edge.
    ManifoldSurface manifold = split_nonmanifold(std::move(soup));
    CleanSurface result;
    result.mesh = std::make_unique<HalfEdgeMesh>(manifold.mesh, manifold.twins);
    result.counts.split_edges = manifold.split_edges;
    result.counts.split_vertices = manifold.split_vertices;

    // Delete small components first, so that their holes are not filled and counted.
    HalfEdgeMesh& mesh = *result.mesh;
    result.counts.removed_components = delete_small_pieces(mesh, options.min_component);
    result.first_filled = mesh.n_faces();
    result.counts.filled_holes = fill_holes(mesh, options.max_hole);
    set_vertex_normals(mesh);
    result.counts.vertices = num_vertices_left(mesh);
    result.counts.faces = num_faces_left(mesh);
    result.counts.removed_vertices =
        static_cast<std::int64_t>(mesh.n_vertices()) - result.counts.vertices;
    return result;
}

} // namespace vcarve
