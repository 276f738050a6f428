#pragma once

#include "base/progress.h"
#include "steps/2_planes/candidate.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// Places along the creases of the surface, where two planar regions meet: at the foot of a wall,
/// in the corner of a room, along the edge of a box. After Lafarge & Alliez (2013), who put points
/// along the lines where planes meet if points of both are near; here they may be far, since sights
/// tell where one looks through.
///
/// Two regions whose planes stand at 30 degrees or more to each other meet along a line. It gets a
/// place every seven tenths of the larger of their spacings where both have points within `reach`
/// spacings of it, to both sides along it. The surface that there would be are two strips, as wide
/// as the step, to the nearest points of either. In an order that does not depend on the threads.
/// Cost: O(log points) for each point of a region that lies near another, in parallel.
std::vector<Candidate> crease_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double reach, const Progress& progress);

} // namespace vcarve
