#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

#include <cstddef>

namespace vcarve {

/// How the cells are solved in parallel: blocks of them alone, then so many blocks at a time as
/// one, until few are left, which are merged by one thread. No size changes the labels.
struct FlowBlocks {
    std::size_t cells = 16384; ///< at least 1; about 1 MB
    std::size_t merged = 16;   ///< at least 2
};

/// The labels of the minimum cut of a network on the cells of a triangulation, which is used up.
/// Inside are exactly the cells from which the sink can still be reached once the flow is maximal.
/// That set is the same for every maximum flow, so the labels depend on nothing but the network.
/// Throws std::invalid_argument where the sizes differ, an arc capacity is negative or a size of
/// the blocks is too small. Cost: 36 bytes a cell beside `cells`, the network's own 20 included,
/// and lists of some of them.
Labels minimum_cut(const TetMesh& cells, FlowNetwork network, const FlowBlocks& blocks = {},
                   const Progress& progress = {});

} // namespace vcarve
