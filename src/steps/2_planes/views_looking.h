#pragma once

#include "base/progress.h"
#include "steps/2_planes/accept.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// Leaves of the tracks of textureless points the views that look at them, as far as the model
/// tells: amid a region nothing but its plane says where a point is, so something may stand before
/// it. A view looks at a place if, of the points that it saw, the one that its image shows nearest
/// to the place is of the region; and if no other planar region covers the place before which the
/// view stands, as a roof does the ground: one that a line from the place along its plane's normal
/// meets from behind, within the hull of its points. Points with fewer than two views left are
/// dropped. Cost: O(sights log sights + points x views log points), in parallel, and 100 bytes a
/// sight of a view for each thread.
void keep_views_that_look(std::vector<AcceptedPoint>& points, const Scene& scene,
                          const PlanarRegions& planes, const Progress& progress);

} // namespace vcarve
