#pragma once

#include "model/flow_network.h"
#include "model/tet_mesh.h"
#include "steps/5_labels/labelling.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// The infinite cells into which no sight leaves the hull, ascending. `network` holds what the
/// sights say and nothing else yet. Cost: O(cells), in parallel.
std::vector<Index> uncrossed_hull_cells(const TetMesh& cells, const FlowNetwork& network);

/// Lets the surface go on along the hull. Where points are seen from within the hull only, as on
/// the walls of a room or at the rim of a plain, no cell lies behind them but infinite ones, which
/// the cut takes for outside; so the surface would end there. Of the `uncrossed` cells those are
/// called inside before which an outside cell lies, whose facet of the hull is seen from within (at
/// each corner) and from beyond by none (no view there saw a corner or has it in its image), is at
/// most 20 times as long as the edges around, and goes on with the surface (within 37 degrees) at
/// one corner or more. Then the boundary has such facets of the hull, and borders where they end.
/// Returns how many there are. Cost: O(uncrossed x views) at most, in parallel, and the boundary
/// where it is not at hand.
std::int64_t go_on_along_hull(const Scene& scene, const std::vector<Index>& uncrossed,
                              Labelling& labelling);

} // namespace vcarve
