#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/trace.h"
#include "vcarve/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The network of all sights as the definitions have it, nothing pushed, nothing netted.
struct UnpushedNetwork {
    std::vector<std::int64_t> sources;             ///< a cell, the capacity from the source
    std::vector<std::int64_t> sinks;               ///< a cell, the capacity to the sink
    std::vector<std::array<std::int64_t, 4>> arcs; ///< of the arc leaving the cell by a slot
};

/// Every sight of a scene: from the cell of the view through the facets it crosses, found by brute
/// force, towards the point, and behind that to the cell that is called inside. A sight that meets
/// edges or vertices falls into stretches, each with a terminal at its end.
UnpushedNetwork network_of_sights(const TetMesh& mesh, const Scene& scene,
                                  const TraceOptions& options);

/// Binds to the source the infinite cells and `cells_of_views`.
void pin_outside(const TetMesh& mesh, const std::vector<Index>& cells_of_views,
                 UnpushedNetwork& network);

/// The labels of the minimum cut with the fewest cells inside, by Boost's Boykov-Kolmogorov.
Labels boost_minimum_cut(const TetMesh& mesh, const UnpushedNetwork& network);

} // namespace vcarve
