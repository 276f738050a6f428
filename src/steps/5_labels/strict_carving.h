#pragma once

#include "model/labels.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

namespace vcarve {

/// Strict carving (Akgunduz, Zetu, Banerjee 2000, section 4.3): a cell is outside if it is infinite
/// or one of its facets is crossed by at least `min_crossings` sights; all others are inside. Exact
/// on points without noise; one wrong sight drills a tunnel. Cost: O(cells).
Labels carve(const TetMesh& cells, const Crossings& crossings, int min_crossings);

} // namespace vcarve
