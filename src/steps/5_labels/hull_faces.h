#pragma once

#include "model/flow_network.h"
#include "model/labels.h"
#include "model/tet_mesh.h"
#include "vcarve/options.h"
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
/// most `hull_edge` times as long as the edges around, and goes on with the surface at one corner
/// or more (goes_on). Then the boundary has such facets of the hull, and borders where they end.
/// Returns how many there are. Cost: O(uncrossed x views) at most, in parallel, and the
/// boundary of the labels.
std::int64_t go_on_along_hull(const TetMesh& cells, const Scene& scene,
                              const std::vector<Index>& uncrossed, const HullOptions& options,
                              Labels& labels);

} // namespace vcarve
