#include "surface/cleanup.h"

#include "surface/fill_holes.h"
#include "surface/half_edge_mesh.h"
#include "surface/split_nonmanifold.h"

#include <algorithm>

namespace vcarve {
namespace {

using OpenMesh::FaceHandle;

/// The pieces of a surface: which one each face belongs to, and how many faces each has.
struct Pieces {
    std::vector<std::uint32_t> of_faces;
    std::vector<std::int64_t> sizes;
};

Pieces find_pieces(const HalfEdgeMesh& mesh)
{
    constexpr std::uint32_t kNone = 0xffffffffU;
    Pieces pieces{.of_faces = std::vector<std::uint32_t>(mesh.n_faces(), kNone), .sizes = {}};
    std::vector<FaceHandle> reached;
    for (const auto first : mesh.faces()) {
        if (pieces.of_faces[index(first)] != kNone) continue;
        const auto piece = static_cast<std::uint32_t>(pieces.sizes.size());
        pieces.sizes.push_back(0);
        pieces.of_faces[index(first)] = piece;
        reached.push_back(first);
        while (!reached.empty()) {
            const FaceHandle face = reached.back();
            reached.pop_back();
            ++pieces.sizes[piece];
            for (const auto neighbor : mesh.ff_range(face)) {
                if (pieces.of_faces[index(neighbor)] != kNone) continue;
                pieces.of_faces[index(neighbor)] = piece;
                reached.push_back(neighbor);
            }
        }
    }
    return pieces;
}

/// Which pieces have at least so many faces; of the largest ones the first is kept in any case.
std::vector<char> pieces_to_keep(const Pieces& pieces, int min_faces)
{
    std::vector<char> keep(pieces.sizes.size());
    std::ranges::transform(pieces.sizes, keep.begin(),
                           [&](std::int64_t size) { return size >= min_faces; });
    const auto largest = std::ranges::max_element(pieces.sizes) - pieces.sizes.begin();
    if (!keep.empty()) keep[static_cast<std::size_t>(largest)] = 1;
    return keep;
}

/// Fills the holes of the kept pieces; new faces are kept. Returns how many holes there were.
std::int64_t fill_small_holes(HalfEdgeMesh& mesh, std::vector<char>& keep_faces, int max_edges)
{
    std::int64_t num_filled = 0;
    for (const BoundaryLoop& loop : boundary_loops(mesh)) {
        if (loop.size() > static_cast<std::size_t>(std::max(max_edges, 0))) continue;
        const FaceHandle beside = mesh.face_handle(mesh.opposite_halfedge_handle(loop[0]));
        if (keep_faces[index(beside)] == 0 || is_rim(mesh, loop) || touches_itself(mesh, loop)) {
            continue;
        }
        fill_hole(mesh, loop);
        keep_faces.resize(mesh.n_faces(), 1);
        ++num_filled;
    }
    return num_filled;
}

} // namespace

CleanSurface clean_surface(const TriMesh& mesh, const CleanupOptions& options)
{
    // Take apart what OpenMesh cannot hold.
    const ManifoldSurface manifold = split_nonmanifold(mesh);
    HalfEdgeMesh half_edges = half_edge_mesh(manifold.mesh);

    // Small pieces go before holes are filled: a hole in one of them is none of ours.
    const Pieces pieces = find_pieces(half_edges);
    const std::vector<char> keep = pieces_to_keep(pieces, options.min_component_faces);
    std::vector<char> keep_faces(half_edges.n_faces());
    std::ranges::transform(pieces.of_faces, keep_faces.begin(),
                           [&](std::uint32_t piece) { return keep[piece]; });

    CleanSurface result;
    result.counts.split_edges = manifold.split_edges;
    result.counts.split_vertices = manifold.split_vertices;
    result.counts.removed_components = std::ranges::count(keep, 0);
    result.counts.filled_holes = fill_small_holes(half_edges, keep_faces, options.max_hole_edges);

    // Back to arrays, without the vertices of no face.
    result.mesh = kept_surface(half_edges, keep_faces, mesh);
    result.counts.removed_vertices =
        static_cast<std::int64_t>(half_edges.n_vertices() - result.mesh.positions.size());
    return result;
}

} // namespace vcarve
