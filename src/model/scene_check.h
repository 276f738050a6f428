#pragma once

#include "vcarve/scene.h"

namespace vcarve {

/// Throws UsageError where the arrays of a scene do not fit each other: where one has not an entry
/// a point, a view has no camera, or a track is not a row of ascending numbers of views. What
/// readers make always fits; this is for scenes that somebody filled. Cost: O(sights), in parallel.
void require_consistent(const Scene& scene);

} // namespace vcarve
