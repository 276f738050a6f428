#pragma once

#include "geometry/nearest_neighbors.h"
#include "steps/2_planes/added_place.h"
#include "steps/2_planes/border_places.h"
#include "steps/2_planes/flat_parts.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// The places where walls of which no point is known stand on the ground: below borders, as the
/// eaves of a roof (add_crease_points() has the rules). In the order of the borders, some of them
/// closer to each other than their steps. The tree is of the scene's points. Cost: O(log points) a
/// border.
std::vector<AddedPlace> foot_places(const Scene& scene, const NearestNeighbors& tree,
                                    const FlatParts& parts,
                                    const std::vector<BorderPlace>& borders);

} // namespace vcarve
