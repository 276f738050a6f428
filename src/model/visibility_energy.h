#pragma once

#include "model/flow_network.h"
#include "model/tet_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// How many sights cross each facet: entry [cell][slot], the same on both sides of a facet.
using Crossings = std::vector<std::array<std::uint32_t, 4>>;

/// The visibility terms of the energy that a labelling minimises (Labatut, Pons, Keriven 2009):
/// what all sights say about the cells, in whole steps. `unit` steps are one sight of full weight.
struct VisibilityEnergy {
    /// Each sight's flow is already pushed along its walk; what stays in an infinite cell is left
    /// out, as those are outside anyway.
    FlowNetwork network;
    /// For each origin of measured rays, source after source, the finite cell that holds it, of
    /// several that touch it the first in which a ray ended; kInfinite if it lies out of the hull.
    std::vector<Index> cell_of_view;
    std::int32_t unit = 0;
};

} // namespace vcarve
