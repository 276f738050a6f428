#pragma once

#include "base/options.h"
#include "model/labels.h"
#include "model/scene.h"
#include "model/tet_mesh.h"
#include "steps/4_labels/boundary.h"
#include "steps/4_labels/max_flow/max_flow.h"

#include <cstdint>
#include <vector>

namespace vcarve {

struct WebOptions {
    double web_edge = 3.0;

    void visit(OptionVisitor& options)
    {
        options.number(web_edge,
                       {.name = "web-edge",
                        .unit = "x local edge",
                        .help = "Doubt seen faces with an edge this many times longer than the "
                                "median around them that stand across the surface at their "
                                "corners; 0 doubts none."});
    }
};

/// The cells behind faces that look like webs: sheets the cut leaves between things that stand
/// close to each other, because sights are needles and none happens to pass there. A web is in
/// plain sight, and yet no point was found on it: its longest edge is `web_edge` times the median
/// around. It does not go on with the surface: its normal leaves those of the small faces around
/// two of its corners. And the cell behind it lies before the surface at one of its own corners,
/// where no solid is expected. A cell is listed once for each such face. Cost: O(faces), mostly in
/// parallel.
std::vector<Index> cells_behind_webs(const TetMesh& cells, const Boundary& boundary,
                                     const Scene& scene, const WebOptions& options);

/// Labels of the cut, and how many doubts in webs led to them.
struct DoubtedLabels {
    Labels labels;
    std::int64_t doubts = 0;
    std::int64_t taken_back = 0; ///< cells whose freeing did not pay, summed over the rounds
};

/// Finds the cut again and again, each time with `one_sight` more for the outside in each cell
/// behind a web, and keeps what becomes free where that pays (see FreedPieces). Cost: that of
/// cells_behind_webs and of what changes in the cut, a few times.
DoubtedLabels doubt_webs(const TetMesh& cells, const Scene& scene, MinimumCut& cut,
                         std::int32_t one_sight, const WebOptions& options);

} // namespace vcarve
