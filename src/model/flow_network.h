#pragma once

#include "base/unset_array.h"

#include <array>
#include <cstdint>

namespace vcarve {

/// Of the arc that leaves each cell by each slot, >= 0.
using ArcCapacities = UnsetArray<std::array<std::int32_t, 4>>;

/// What the sights say about the cells, as a network for the minimum cut: a node a cell, an arc
/// through each facet of a cell. Integers, so sums do not depend on the order of adding.
/// A cut puts every cell on the source side (outside) or the sink side (inside). Its value is the
/// sum of arc_capacities[u][slot] over the facets that lead from the source side to the sink side,
/// plus the source capacities of cells on the sink side, plus the sink capacities of cells on the
/// source side.
struct FlowNetwork {
    ArcCapacities arc_capacities;
    /// Per cell, of its arc from the source where positive (flow that still has to find the sink),
    /// and minus that of its arc to the sink where negative (what the sink still takes).
    UnsetArray<std::int32_t> terminal_capacities;
};

} // namespace vcarve
