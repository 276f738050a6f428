#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// A point gets so many sights at most.
inline constexpr std::size_t kMostNearestViews = 8;

/// Which views are likely to have seen which point, where no file tells: for each point the nearest
/// views that have it in their image with no other point clearly before it, of the nearest 32 that
/// have it there at all. Every view keeps the least distances it finds in the squares of a grid
/// over its image, which are twice as wide as points stand apart there on average, of sparse points
/// four times in the part of the image that has any; a point is hidden where one in its square is
/// nearer by more than a surface would be that rises two to one across the square, of sparse points
/// one to one. So a surface hides what lies behind it if its points stand close enough; through
/// gaps in it a view is said to have seen what it did not see. A point that is not finite has no
/// sights, nor has a view whose camera has no size. Of the points only the positions are read, and
/// whether they are dense.
///
/// Cost: a view looks only at points no farther off than those it is asked about and in the cone
/// around them, so O(points log points + points log views) where near views show what they are near
/// to, and up to O(points x views) where they look elsewhere; in parallel. Memory: 80 bytes a point
/// and 50 MiB.
Tracks nearest_sights(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
