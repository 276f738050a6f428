#pragma once

#include "model/tet_mesh.h"

#include <cstddef>
#include <limits>

namespace vcarve {

/// Sculpture of the Delaunay triangulation (Boissonnat, "Geometric structures for three-dimensional
/// shape representation", ACM TOG 3, 1984): starts from the convex hull and takes away boundary
/// cells, the one first whose circumsphere bulges farthest over its boundary facets, until every
/// point lies on the boundary or no cell may go. A cell may go if it has one boundary facet and its
/// fourth vertex is not on the boundary, or two and the edge opposite to theirs is not; so the
/// boundary stays a manifold of genus 0 and no point ever leaves it. A baseline: it knows the
/// points only and nothing of the views. Ties go by the number of the cell. Stops after `most`
/// cells at the latest. Cost: O(cells log cells).
Labels sculpt(const TetMesh& cells, std::size_t most = std::numeric_limits<std::size_t>::max());

} // namespace vcarve
