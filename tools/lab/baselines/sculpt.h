#pragma once

#include "model/tet_mesh.h"

#include <cstddef>
#include <limits>

namespace vcarve {

/// Sculpture of the Delaunay triangulation (Boissonnat, "Geometric structures for three-dimensional
/// shape representation", ACM TOG 3, 1984). Removes boundary cells from the convex hull until every
/// point is on the boundary or no cell may be removed. The first one is the cell whose circumsphere
/// bulges farthest over its boundary facets; cell indices break ties. A cell may be removed if it
/// has one boundary facet and its fourth vertex is not on the boundary, or two and the opposite
/// edge is not. So the boundary stays a manifold of genus 0, and no point leaves it. Removes at
/// most `most` cells. A baseline that uses the points only. Cost: O(cells log cells).
Labels sculpt(const TetMesh& cells, std::size_t most = std::numeric_limits<std::size_t>::max());

} // namespace vcarve
