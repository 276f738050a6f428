#pragma once

#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// What a mesh is made of and what is wrong with it. Counted on the faces as they are, so it works
/// on any triangle soup with shared vertices. Degenerate faces (a vertex twice) are counted apart
/// and take no part in the rest.
struct MeshCheck {
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    std::int64_t degenerate_faces = 0;
    std::int64_t components = 0;           ///< of faces connected through shared edges
    std::int64_t boundary_edges = 0;       ///< edges of one face
    std::int64_t nonmanifold_edges = 0;    ///< edges of three or more faces
    std::int64_t nonmanifold_vertices = 0; ///< vertices whose faces are not one fan or one disk
    std::int64_t orientation_faults = 0; ///< edges of two faces that both run along it the same way
    std::int64_t unreferenced_vertices = 0; ///< vertices of no face
    std::int64_t euler_characteristic = 0;  ///< referenced vertices - edges + faces
    double area = 0.0;                      ///< in squared scene units
    bool is_closed() const { return faces > 0 && boundary_edges == 0 && nonmanifold_edges == 0; }
    bool is_manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
};

/// Cost: O(faces log faces) time, O(faces) memory.
MeshCheck check_mesh(const TriMesh& mesh);

/// The share of a surface's area in faces with an edge longer than so many times the median edge,
/// which is taken of some thousand faces, evenly spread. 0 for a surface without area. Cost:
/// O(faces), in parallel.
double long_area(const TriMesh& mesh, double times);

/// How many pairs of faces have more in common than corners and edges of both. Exact. Corners at
/// one position are one, so copies of a vertex, made where a surface was not manifold, may touch.
/// Faces whose corners are on a line are left out. Cost: O(faces log faces) and what their boxes
/// meet, on many threads.
std::int64_t count_self_intersections(const TriMesh& mesh);

} // namespace vcarve
