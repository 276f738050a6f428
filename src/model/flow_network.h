#pragma once

#include "model/tet_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// What the sights say about the cells, as a network for the minimum cut: a node a cell, an arc
/// through each facet of a cell. Integers, so sums do not depend on the order of adding.
/// A cut puts every cell on the source side (outside) or the sink side (inside); its value is the
/// sum of residuals[u][slot] over facets that lead from the source side to the sink side, plus the
/// excesses of the sink side, plus the deficits of the source side.
struct FlowNetwork {
    std::vector<std::array<std::int32_t, 4>>
        residuals; ///< of the arc leaving the cell by a slot, >= 0
    /// Per cell: > 0 flow that still has to find the sink (a source capacity),
    /// < 0 what the sink still takes (a sink capacity).
    std::vector<std::int32_t> excesses;
};

} // namespace vcarve
