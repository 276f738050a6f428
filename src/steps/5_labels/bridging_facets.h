#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "steps/5_labels/labelling.h"
#include "steps/5_labels/max_flow/max_flow.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// The cells behind bridging facets. The cut leaves such facets between things that stand close to
/// each other, where no sight happens to pass: they bridge the gap. A face is taken for one if it
/// was seen from its front; if its longest edge is at least `bridging_edge` times the median edge
/// around, since points would have been found on a real surface of that size; if its normal differs
/// from the normals of the small faces at two of its corners; and if the cell behind it lies before
/// the surface at a corner of that cell, where no solid is expected. A cell is listed once for each
/// such face. Cost: O(faces), mostly in parallel.
std::vector<Index> cells_behind_bridging_facets(const TetMesh& cells, const Boundary& boundary,
                                                const Scene& scene, const BridgingOptions& options);

struct DoubtOptions {
    BridgingOptions bridging;
    std::int32_t one_sight = 1; ///< what a doubt adds to the source capacity of a cell
};

/// Labels after doubts, and how many bridging facets were doubted on the way.
struct DoubtedLabels {
    Labelling labelling;
    std::int64_t doubts = 0;
    std::int64_t taken_back = 0; ///< cells whose freeing did not pay, summed over the rounds
};

/// Finds the cut again and again, each time with `one_sight` more for the outside in each cell
/// behind a bridging facet, and keeps what becomes free where that pays (see FreedPieces). Cost:
/// that of cells_behind_bridging_facets once, and a few times that of what changes in the cut, with
/// a glance at all cells to find it.
DoubtedLabels doubt_bridging_facets(const TetMesh& cells, const Scene& scene, MinimumCut& cut,
                                    const DoubtOptions& options, const Progress& progress = {});

} // namespace vcarve
