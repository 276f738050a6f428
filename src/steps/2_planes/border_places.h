#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "steps/2_planes/added_place.h"
#include "steps/2_planes/flat_parts.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// A place on the border of a flat part.
struct BorderPlace : AddedPlace {
    std::uint32_t region = 0;                          ///< the flat part
    Eigen::Vector3d passage = Eigen::Vector3d::Zero(); ///< where the sight next to it passes by
    std::uint32_t seen = 0;                            ///< the point of that sight
};

/// The places along the borders of a scene's flat parts: between points of a part and the nearest
/// places where sights pass through its plane, no farther from them than `gap` of the part's
/// spacings (add_crease_points() has the rules). In an order that does not depend on the threads,
/// some of them closer to each other than their steps. The tree is of the scene's points. Cost:
/// O(sights log parts + passages log passages), in parallel, and 48 bytes for each passage of a
/// sight through the plane of a part near its points.
std::vector<BorderPlace> border_places(const Scene& scene, const NearestNeighbors& tree,
                                       const FlatParts& parts, double gap,
                                       const Progress& progress);

} // namespace vcarve
