#pragma once

#include "steps/1_points/clusters.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Points, and of how many read ones each was made.
struct MergedPoints {
    Scene scene;
    std::vector<std::uint32_t> counts; ///< empty: of itself each
};

/// One point for every cluster, in their order: at the mean of its points, with the mean of their
/// colours and normals, all views that saw any, and error and id of the leader. Cost: O(points +
/// sights), in parallel.
MergedPoints merge_points(const MergedPoints& points, const Clusters& clusters);

/// Adds points of the same views behind others, or makes them the first.
void append(MergedPoints& points, MergedPoints more);

} // namespace vcarve
