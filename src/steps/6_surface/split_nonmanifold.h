#pragma once

#include "mesh/edge_table.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

struct ManifoldSurface {
    TriMesh mesh;
    std::vector<HalfEdge> twins;  ///< per half-edge the one it shares an edge with, or kNoHalfEdge
    std::int64_t split_edges = 0; ///< edges that had three or more faces
    std::int64_t split_vertices = 0; ///< vertices that became several
};

/// Takes a triangle soup apart where it is not manifold, moving nothing. Around an edge of more
/// than two faces, those that bound one solid sector (the side opposite to the normals) stay
/// together, so solids that touch in an edge or in a vertex come apart. Faces that find no partner
/// get a border; on a consistently oriented soup these are the edges that were borders already.
///
/// Every edge of the result has one or two faces, two run along it in opposite directions, and
/// every vertex has one fan or one disk of faces. Where two sheets still share both ends of an edge
/// after the split, all but one of them get a vertex of their own in the middle of it; this is the
/// only case that adds faces. Degenerate faces (a vertex twice) are dropped. Vertices keep their
/// numbers, copies follow; a copy keeps colour and point, a midpoint has the mean colour and no
/// point. Normals are dropped. Cost: O(faces log(faces of a vertex)), mostly in parallel.
ManifoldSurface split_nonmanifold(TriMesh mesh);

} // namespace vcarve
