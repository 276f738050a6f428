#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "steps/2_planes/added_place.h"
#include "steps/2_planes/flat_parts.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace vcarve {

/// The corners of a rectangle, in turn.
using Strip = std::array<Eigen::Vector3d, 4>;

/// A place for a point on a crease.
struct CreasePlace : AddedPlace {
    std::array<Strip, 2> strips = {}; ///< of surface, if it is one, to the points beside it
};

/// The places along the lines where two of a scene's flat parts may meet, as far as these alone
/// tell (add_crease_points() has the rules), in an order that does not depend on the threads. The
/// tree is of the scene's points. Cost: O(log points) for each point of a region that lies near
/// another, in parallel.
std::vector<CreasePlace> crease_places(const Scene& scene, const NearestNeighbors& tree,
                                       const FlatParts& parts, double reach,
                                       const Progress& progress);

} // namespace vcarve
