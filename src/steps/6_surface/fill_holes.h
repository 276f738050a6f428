#pragma once

#include "mesh/half_edge_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// A closed chain of half-edges without a face, each one's end the next one's start.
using BoundaryLoop = std::vector<OpenMesh::HalfedgeHandle>;

/// All loops along faces that are not deleted, each beginning at its least half-edge, in the order
/// of these. Cost: O(edges).
std::vector<BoundaryLoop> boundary_loops(const HalfEdgeMesh& mesh);

/// Whether a loop is the outer rim of a piece rather than a hole in it: what would fill it would
/// face back onto the faces along it (by more than 120 degrees in the mean), as on a lone flat
/// patch. A box without a lid, a half sphere or a tetrahedron without a side still have holes.
bool is_rim(const HalfEdgeMesh& mesh, const BoundaryLoop& loop);

/// Whether a loop comes twice to one place, at copies of a vertex that was split: it closes several
/// holes that touch there, and what would fill it as one has faces without area, or folds.
/// Cost: O(n^2) for n edges.
bool touches_itself(const HalfEdgeMesh& mesh, const BoundaryLoop& loop);

/// Closes a loop with the triangles over its vertices whose total area is least (Barequet and
/// Sharir, "Filling gaps in the boundary of a polyhedron", CAGD 1995), never along an edge that is
/// there already. Where that rules every triangulation out, with a fan around a new vertex in the
/// middle, which has the mean colour and is no point of the scene. Cost: O(n^3) for n edges.
void fill_hole(HalfEdgeMesh& mesh, const BoundaryLoop& loop);

/// Fills the holes of at most so many edges that are neither rims nor touch themselves, but where
/// the mesh knows its points none with a vertex that is no point: there faces were trimmed
/// (trim.h). The hole of a face that was trimmed away whole has none and is filled again. Returns
/// how many there were.
std::int64_t fill_holes(HalfEdgeMesh& mesh, int max_edges);

} // namespace vcarve
