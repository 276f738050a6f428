#pragma once

#include "model/flow_network.h"
#include "model/tet_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// How many sights cross each facet: entry [cell][slot], the same on both sides of a facet.
using Crossings = std::vector<std::array<std::uint32_t, 4>>;

/// What all sights say about the cells, in whole steps: `unit` steps are one sight of full weight.
struct Votes {
    FlowNetwork network;             ///< each sight's flow is already pushed along its walk
    std::vector<Index> cell_of_view; ///< the cell that holds a view's centre; kInfinite if none
    std::int32_t unit = 0;
};

} // namespace vcarve
