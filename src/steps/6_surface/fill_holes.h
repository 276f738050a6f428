#pragma once

#include "mesh/half_edge_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// A closed chain of half-edges without a face, each from the end of the previous one.
using BoundaryLoop = std::vector<OpenMesh::HalfedgeHandle>;

/// All loops along faces that are not deleted, each from its least half-edge, in the order of
/// these. Cost: O(edges).
std::vector<BoundaryLoop> boundary_loops(const HalfEdgeMesh& mesh);

/// Whether a loop is the outer boundary of a component, as of a flat patch, rather than a hole.
/// Faces that fill it would face the opposite way to the faces along it (by more than 120 degrees
/// in the mean). An open box, a half sphere or a tetrahedron without a face still have holes.
bool is_rim(const HalfEdgeMesh& mesh, const BoundaryLoop& loop);

/// Whether a loop passes twice through one position, at copies of a split vertex. It then surrounds
/// several holes that touch there. Filling it as one hole would make folds or faces without area.
/// Cost: O(n^2) for n edges.
bool touches_itself(const HalfEdgeMesh& mesh, const BoundaryLoop& loop);

/// Fills a loop with the triangles over its vertices whose total area is least (Barequet and
/// Sharir, "Filling gaps in the boundary of a polyhedron", CAGD 1995), without duplicating existing
/// edges. If no such triangulation exists, it adds a fan around a new vertex at the centroid, with
/// the mean color and no point of the scene. Cost: O(n^3) for n edges.
void fill_hole(HalfEdgeMesh& mesh, const BoundaryLoop& loop);

/// Fills the holes of at most `max_edges` edges that are neither outer boundaries nor touch
/// themselves. If the mesh has scene points, holes with a vertex that is no point stay, because
/// faces were trimmed there (trim.h). The hole of a completely trimmed face has no such vertex and
/// is filled. Returns the number of filled holes.
std::int64_t fill_holes(HalfEdgeMesh& mesh, int max_edges);

} // namespace vcarve
