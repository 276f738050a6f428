#pragma once

#include "model/flow_network.h"
#include "model/labels.h"
#include "model/tet_mesh.h"

namespace vcarve {

/// The minimum cut of a network on the cells of `cells`: inside are exactly the cells from which
/// the sink can still be reached once the flow is maximal. That set is the same for every maximum
/// flow, so the labels depend on nothing but the network. `network` is used up.
Labels minimum_cut(const TetMesh& cells, FlowNetwork network);

} // namespace vcarve
