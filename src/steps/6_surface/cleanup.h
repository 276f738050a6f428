#pragma once

#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace vcarve {

struct CleanupCounts {
    std::int64_t vertices = 0; ///< of the clean surface
    std::int64_t faces = 0;
    std::int64_t split_edges = 0;
    std::int64_t split_vertices = 0;
    std::int64_t removed_components = 0;
    std::int64_t removed_vertices = 0; ///< of no face that is left
    std::int64_t filled_holes = 0;
};

class HalfEdgeMesh;

struct CleanSurface {
    std::unique_ptr<HalfEdgeMesh> mesh;
    CleanupCounts counts;
    std::size_t first_filled = 0; ///< faces of the mesh from here on fill holes
};

/// A manifold, consistently oriented surface, as the one mesh that is worked on from then on, from
/// any consistently oriented triangle soup with shared vertices. In this order: edges and vertices
/// that are not manifold are taken apart (split_nonmanifold.h), small pieces deleted, the largest
/// never, and closed ones without faces longer than usual only if they have less than half as many
/// faces as asked for (a lone tetrahedron of common size stands where points are), small holes of
/// the rest filled (fill_holes.h; the outer rim of an open piece is no hole, and one that comes
/// twice to one place stays open). Vertices and faces that stay keep their order, colours and
/// points travel along, and every vertex gets the area-weighted mean of its faces' normals (zero
/// where none of them has an area). What this does not do: move a vertex, turn a face round, join
/// pieces, or remove self-intersections. Cost: O(faces), mostly in parallel.
CleanSurface clean_surface(TriMesh soup, const CleanupOptions& options);

/// Removes the faces of connected components with less than `min_area`, in scene units squared, but
/// never the largest. Vertices stay. Returns the number of components removed. Cost: O(faces).
std::int64_t drop_small_components(TriMesh& mesh, double min_area);

} // namespace vcarve
