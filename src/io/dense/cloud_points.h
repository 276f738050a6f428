#pragma once

#include "io/ply/ply_file.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

/// Moves the attributes of a cloud into a scene that already has its positions. point_ids count the
/// vertices of the file from `first`, and errors are unknown (-1). Missing colors are black.
/// Normals get unit length, or zero if they have no direction. Cost: O(points), in parallel.
void take_attributes(PointCloud cloud, std::uint64_t first, Scene& scene);

/// The file indices of the kept Gaussians, and a note about the dropped ones.
struct KeptSplats {
    std::vector<std::uint64_t> places;
    std::string note; ///< empty if all were kept
};

/// Keeps the Gaussians of a cloud whose centers are likely on a surface. Gaussians of less than
/// half opacity are dropped: their centers show more background than Gaussian, so they are haze or
/// tint others. Solid Gaussians are dropped if their largest half-axis exceeds ten times the median
/// of the solid ones: they are sky or distant scenery without a clear surface. Cost: O(points).
KeptSplats keep_solid_splats(PointCloud& cloud);

} // namespace vcarve
