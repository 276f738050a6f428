#pragma once

#include "steps/5_labels/labelling.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// Takes back needles: thin spikes of inside cells to a stray point, such as a false match makes
/// far before the surface. A vertex is the tip of one if the inside cells there fill less than a
/// twelfth of the full solid angle, if every edge of the boundary there is `needle_edge` times
/// longer than the median edge at its foot, and if few views saw its point: at most 3, or fewer
/// than half of the median point's. The inside cells at a tip are called outside; that is repeated,
/// since a needle may have more than one tip. Returns how many tips were taken back. Does not touch
/// pits, tunnels of outside cells to a stray point behind the surface. Cost: O(points), mostly in
/// parallel, and what is near those taken back a round.
std::int64_t take_back_needles(const Scene& scene, const NeedleOptions& options,
                               Labelling& labelling);

} // namespace vcarve
