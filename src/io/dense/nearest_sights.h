#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// A point gets so many sights at most.
inline constexpr std::size_t kMostNearestViews = 8;

/// Which views are likely to have seen which point, where no file tells: for each point the nearest
/// views that have it in their image with no other point clearly before it. Every view keeps the
/// least distances it finds in the squares of a grid over its image, which are twice as wide as
/// points stand apart there on average, of sparse points four times in the part of the image that
/// has any; a point is hidden where one in its square is nearer by more than a surface would be
/// that rises two to one across the square. So a surface hides what lies behind it if its points
/// stand close enough; through gaps in it a view is said to have seen what it did not see. A point
/// that is not finite has no sights, nor has a view whose camera has no size. Of the points only
/// the positions are read, and whether they are dense. Cost: O(points x views), in parallel.
Tracks nearest_sights(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
