#pragma once

#include "model/tet_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// What the sights say about the cells, as a network for the minimum cut: a node a cell, an arc
/// through each facet of a cell. Integers, so sums do not depend on the order of adding.
/// A cut puts every cell on the source side (outside) or the sink side (inside). Its value is the
/// sum of arc_capacities[u][slot] over the facets that lead from the source side to the sink side,
/// plus the source capacities of cells on the sink side, plus the sink capacities of cells on the
/// source side.
struct FlowNetwork {
    std::vector<std::array<std::int32_t, 4>>
        arc_capacities; ///< of the arc leaving the cell by a slot, >= 0
    /// Per cell, of its arc from the source where positive (flow that still has to find the sink),
    /// and minus that of its arc to the sink where negative (what the sink still takes).
    std::vector<std::int32_t> terminal_capacities;
};

} // namespace vcarve
