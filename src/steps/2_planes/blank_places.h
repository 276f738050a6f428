#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "steps/2_planes/added_place.h"
#include "steps/2_planes/flat_parts.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// The places amid flat parts that are blank: views look at them, but no point was found there, as
/// on a plain floor. They stand near the middles of squares with sides of `step` spacings of the
/// part's points (add_crease_points() has the rules). Part after part, in an order that does not
/// depend on the threads. The tree is of the scene's points. Cost: O(blank squares x views log
/// points + sights log squares), in parallel, but for the hull of each part; about 500 bytes a
/// blank square, of which there are no more than points, and 100 bytes a sight of a view for each
/// thread.
std::vector<AddedPlace> blank_places(const Scene& scene, const NearestNeighbors& tree,
                                     const FlatParts& parts, double step, const Progress& progress);

} // namespace vcarve
