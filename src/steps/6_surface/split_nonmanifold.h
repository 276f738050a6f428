#pragma once

#include "mesh/edge_table.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

struct ManifoldSurface {
    TriMesh mesh;
    std::vector<HalfEdge> twins;     ///< per half-edge its twin, or kNoHalfEdge at a boundary
    std::int64_t split_edges = 0;    ///< number of edges that had three or more faces
    std::int64_t split_vertices = 0; ///< number of vertices that were split
};

/// Splits a triangle soup where it is non-manifold, without moving vertices. At an edge of more
/// than two faces, the faces that bound one solid sector (the side opposite to the normals) stay
/// connected. So solids that touch in an edge or a vertex are separated. Faces without a partner
/// get a boundary edge; in a consistently oriented soup these edges already were boundary edges.
///
/// Each edge of the result has one face, or two that run along it in opposite directions. Each
/// vertex has one fan or one disk of faces. If several seams still join the same two vertices, all
/// but one are split at a new midpoint; only this adds faces. Degenerate faces (with a repeated
/// vertex) are dropped. Vertices keep their numbers, and copies follow. A copy keeps color and
/// point; a midpoint has the mean color and no point. Normals are dropped. Cost: O(faces log(faces
/// of a vertex)), mostly in parallel.
ManifoldSurface split_nonmanifold(TriMesh mesh);

} // namespace vcarve
