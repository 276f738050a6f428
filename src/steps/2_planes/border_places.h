#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "steps/2_planes/added_place.h"
#include "steps/2_planes/flat_parts.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// The places along the borders of a scene's flat parts: between points of a part and the nearest
/// places where sights pass through its plane, no farther from them than `gap` of the part's
/// spacings (add_crease_points() has the rules). In an order that does not depend on the threads,
/// some of them closer to each other than their steps. The tree is of the scene's points. Cost:
/// O(sights log parts + passages log passages), in parallel, and 48 bytes for each passage of a
/// sight through the plane of a part near its points.
std::vector<AddedPlace> border_places(const Scene& scene, const NearestNeighbors& tree,
                                      const FlatParts& parts, double gap, const Progress& progress);

} // namespace vcarve
