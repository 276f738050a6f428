#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/trace.h"
#include "vcarve/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The network of all rays as defined: no flow is pushed, and opposite capacities do not cancel.
struct UnpushedNetwork {
    std::vector<std::int64_t> sources;             ///< capacity from the source, per cell
    std::vector<std::int64_t> sinks;               ///< capacity to the sink, per cell
    std::vector<std::array<std::int64_t, 4>> arcs; ///< capacity through each facet of a cell
};

/// Adds every ray of a scene: from the view's cell through the crossed facets to the point, and
/// behind it to the cell that gets the vote for inside. Facets are found by brute force. A ray that
/// meets edges or vertices is split into segments, each with a terminal at its end.
UnpushedNetwork network_of_rays(const TetMesh& mesh, const Scene& scene,
                                const TraceOptions& options);

/// Binds the infinite cells and `cells_of_views` to the source.
void pin_outside(const TetMesh& mesh, const std::vector<Index>& cells_of_views,
                 UnpushedNetwork& network);

/// The labels of the minimum cut with the fewest cells inside, by Boost's Boykov-Kolmogorov.
Labels boost_minimum_cut(const TetMesh& mesh, const UnpushedNetwork& network);

} // namespace vcarve
