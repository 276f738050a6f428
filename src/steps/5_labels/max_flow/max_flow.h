#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

#include <cstddef>

namespace vcarve {

/// Sizes for the parallel solution: blocks of `cells` cells are solved separately, then `merged`
/// blocks at a time become one. One thread merges the last ones. Sizes do not change the labels.
struct FlowBlocks {
    std::size_t cells = 16384; ///< at least 1; about 1 MB
    std::size_t merged = 16;   ///< at least 2
};

/// The labels of the minimum cut of a network on the cells of a triangulation. Consumes the
/// network. Exactly the cells from which the sink is reachable in the residual graph of a maximum
/// flow are inside. This set is the same for every maximum flow, so labels depend only on the
/// network. Throws std::invalid_argument if sizes differ, an arc capacity is negative, or a block
/// size is too small. Cost: 36 bytes per cell beside `cells`, including the 20 of the network, and
/// lists of some cells.
Labels minimum_cut(const TetMesh& cells, FlowNetwork network, const FlowBlocks& blocks = {},
                   const Progress& progress = {});

} // namespace vcarve
