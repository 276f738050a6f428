#pragma once

#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace vcarve {

struct CleanupCounts {
    std::int64_t vertices = 0; ///< number of vertices of the clean mesh
    std::int64_t faces = 0;
    std::int64_t split_edges = 0;
    std::int64_t split_vertices = 0;
    std::int64_t removed_components = 0;
    std::int64_t removed_vertices = 0; ///< vertices without faces
    std::int64_t filled_holes = 0;
};

class HalfEdgeMesh;

struct CleanSurface {
    std::unique_ptr<HalfEdgeMesh> mesh;
    CleanupCounts counts;
    std::size_t first_filled = 0; ///< index of the first face that fills a hole
};

/// Makes a manifold, consistently oriented mesh from a consistently oriented triangle soup with
/// shared vertices. First it splits non-manifold edges and vertices (split_nonmanifold.h). Then it
/// deletes small connected components, except the largest. Closed components without long faces
/// need only half of `min_component` faces, because even a lone tetrahedron of usual size has
/// measured corners. Then it fills small holes (fill_holes.h), but neither outer boundaries of open
/// components nor loops with coincident vertices. Finally it sets vertex normals to the
/// area-weighted mean of the face normals (zero if all areas are zero). Remaining vertices and
/// faces keep their order, colors and points. Vertices do not move, faces keep their orientation,
/// components are not joined, and self-intersections remain. Cost: O(faces), mostly in parallel.
CleanSurface clean_surface(TriMesh soup, const CleanupOptions& options);

/// Removes the faces of connected components with less than `min_area`, in scene units squared, but
/// never the largest. Vertices stay. Returns the number of components removed. Cost: O(faces).
std::int64_t drop_small_components(TriMesh& mesh, double min_area);

} // namespace vcarve
