#pragma once

#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// Counts of elements and defects of a mesh. They are defined for any triangle soup with shared
/// vertices. Degenerate faces (with a repeated vertex) are only counted in `faces` and
/// `degenerate_faces`.
struct MeshCheck {
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    std::int64_t degenerate_faces = 0;
    std::int64_t components = 0;            ///< sets of faces connected by edges
    std::int64_t boundary_edges = 0;        ///< edges of one face
    std::int64_t nonmanifold_edges = 0;     ///< edges of three or more faces
    std::int64_t nonmanifold_vertices = 0;  ///< vertices whose faces are not one fan or one disk
    std::int64_t orientation_faults = 0;    ///< edges that two faces traverse in the same direction
    std::int64_t unreferenced_vertices = 0; ///< vertices of no face
    std::int64_t euler_characteristic = 0;  ///< referenced vertices - edges + faces
    double area = 0.0;                      ///< in squared scene units
    bool is_closed() const { return faces > 0 && boundary_edges == 0 && nonmanifold_edges == 0; }
    bool is_manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
};

/// Checks a mesh. Cost: O(faces log faces) time, O(faces) memory.
MeshCheck check_mesh(const TriMesh& mesh);

/// The fraction of the area in faces with an edge longer than `times` the median edge. The median
/// is estimated from 4096 evenly spaced faces. 0 for a surface without area. Cost: O(faces), in
/// parallel.
double long_area(const TriMesh& mesh, double times);

/// The number of pairs of faces that intersect in more than common corners and edges. Exact. Equal
/// positions are one corner, so copies of a split non-manifold vertex may touch. Faces with
/// collinear corners are ignored. Cost: O(faces log faces + pairs of overlapping boxes), the pairs
/// in parallel.
std::int64_t count_self_intersections(const TriMesh& mesh);

} // namespace vcarve
