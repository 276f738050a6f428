#pragma once

#include "base/progress.h"
#include "steps/2_planes/candidate.h"
#include "steps/2_planes/planar_regions.h"

#include <vector>

namespace vcarve {

/// Places on textureless areas, amid planar regions: a plain floor, or the road between cars, where
/// views look but images show no features. Chauve, Labatut & Pons (2010) complete planes so, by
/// cells of their arrangement; here a plane goes on within the convex hull of its points alone,
/// since the truth ends somewhere, too.
///
/// The plane of a region of 100 points or more is divided into squares with sides of `step`
/// spacings. Those within the hull that have none of its points get a place near their middle,
/// those next to points first, no more than there are points. The surface that there would be is
/// the square. Region by region, in an order that does not depend on the threads. Cost: O(points
/// log points), in parallel over the regions.
std::vector<Candidate> textureless_candidates(const PlanarRegions& planes, double step,
                                              const Progress& progress);

} // namespace vcarve
